// Light of lamps as tier `fast` sees it: grid, kernel, rays and probes together.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/projection/camera.h"
#include "airsim360/render/lights/lamp_grid.h"
#include "airsim360/render/renderer.h"
#include "airsim360/render/shading/light_probes.h"
#include "airsim360/render/shading/secondary_rays.h"
#include "airsim360/render/shared/shading_kernels.h"

namespace airsim360::internal {
namespace {

Mesh Quad(Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
  Mesh mesh;
  mesh.positions = {a, b, c, d};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// Faces inwards.
Mesh Room(Vec3f lo, Vec3f hi) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back({i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z});
  for (const Vec3u t : {Vec3u{0, 1, 3}, Vec3u{0, 3, 2}, Vec3u{4, 6, 7}, Vec3u{4, 7, 5}, Vec3u{0, 2, 6}, Vec3u{0, 6, 4}, Vec3u{1, 5, 7},
                        Vec3u{1, 7, 3}, Vec3u{0, 4, 5}, Vec3u{0, 5, 1}, Vec3u{2, 3, 7}, Vec3u{2, 7, 6}})
    mesh.triangles.push_back(t);
  return mesh;
}

// Octahedron subdivided to a ball, facing outwards.
Mesh Ball(Vec3f center, float radius) {
  Mesh mesh;
  constexpr int kRings = 24, kSides = 48;
  for (int i = 0; i <= kRings; ++i) {
    for (int j = 0; j < kSides; ++j) {
      const float a = kPiF * static_cast<float>(i) / kRings, b = 2 * kPiF * static_cast<float>(j) / kSides;
      mesh.positions.push_back(center + Vec3f{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)} * radius);
    }
  }
  for (uint32_t i = 0; i < kRings; ++i) {
    for (uint32_t j = 0; j < kSides; ++j) {
      const uint32_t k = (j + 1) % kSides;
      mesh.triangles.push_back({i * kSides + j, (i + 1) * kSides + j, (i + 1) * kSides + k});
      mesh.triangles.push_back({i * kSides + j, (i + 1) * kSides + k, i * kSides + k});
    }
  }
  return mesh;
}

struct World {
  SceneBuilder builder{"lamps"};
  EntityId entity = builder.AddEntity("all", builder.tree().At("construction/building"));
  std::shared_ptr<const RayTracer> tracer;
  std::unique_ptr<SurfaceTables> tables;
  std::unique_ptr<LightTable> lights;
  std::unique_ptr<LampGrid> grid;
  ShadeView view{};

  void Add(Mesh mesh, float albedo, Vec3f emission = {}) {
    Material material;
    material.base_color = {albedo, albedo, albedo};
    material.emission = emission;
    Add(std::move(mesh), material);
  }
  void Add(Mesh mesh, const Material& material) {
    mesh.parts = {{0, static_cast<uint32_t>(mesh.triangles.size()), builder.AddMaterial(material), kNoEntity}};
    builder.AddInstance({builder.AddMesh(std::move(mesh)), {}, entity});
  }
  void Build() {
    tracer = std::make_shared<const RayTracer>(builder.Build());
    tables = std::make_unique<SurfaceTables>(tracer->scene());
    lights = std::make_unique<LightTable>(tracer->scene(), *tables, tracer->scene().environment);
    grid = std::make_unique<LampGrid>(*tracer, *lights, 0.0f);
    view.lamps = grid->view();
  }
  // Irradiance on level ground at points, with `rays` rays each.
  std::vector<float> Light(const std::vector<Vec3f>& points, int rays = 2, Vec3f normal = {0, 0, 1}) const {
    auto set = std::make_unique<RaySet>();
    auto s = std::make_unique<SurfaceSet>();
    auto wanted = std::make_unique<LampRays>();
    *set = {};
    *s = {};
    set->count = static_cast<int>(points.size());
    for (int i = 0; i < set->count; ++i) {
      s->px[i] = points[i].x, s->py[i] = points[i].y, s->pz[i] = points[i].z;
      s->nx[i] = s->gx[i] = normal.x, s->ny[i] = s->gy[i] = normal.y, s->nz[i] = s->gz[i] = normal.z;
      s->roughness[i] = 1;
      set->dx[i] = -normal.x, set->dy[i] = -normal.y, set->dz[i] = -normal.z;
      set->distance[i] = 5;
    }
    AIRSIM360_SELECT_KERNEL(LightByLamps)(view, *set, rays, nullptr, *s, *wanted);
    TraceLamps(*tracer, *tables, *set, *wanted, rays, *s);
    return {s->lamp_g, s->lamp_g + points.size()};
  }
};

std::vector<Vec3f> Row() {
  std::vector<Vec3f> points;
  for (float x : {0.0f, 0.4f, 1.0f, 2.0f, 3.7f, 6.0f, 10.0f}) points.push_back({x, 0.3f * x, 0});
  return points;
}

// A lens of 0.2 m x 0.1 m at the origin that looks along -Y, 0.7 m above the ground, and a wall at y = -distance.
struct HeadLamp {
  static constexpr float kArea = 0.02f, kRadiance = 50, kSharp = 30, kHeight = 0.7f;
  World world;
  explicit HeadLamp(float distance, Vec3f glow = {1, 1, 1}, float turn = 0) {
    world.Add(Quad({40, -distance, 0}, {-40, -distance, 0}, {-40, -distance, 20}, {40, -distance, 20}), 0.5f);
    Material lens;
    lens.base_color = {};
    lens.emission = {kRadiance, kRadiance, kRadiance};
    lens.beam = kSharp;
    Mesh quad = Quad({-0.1f, 0, -0.05f}, {0.1f, 0, -0.05f}, {0.1f, 0, 0.05f}, {-0.1f, 0, 0.05f});
    quad.parts = {{0, 2, world.builder.AddMaterial(lens), kNoEntity}};
    world.builder.AddInstance({world.builder.AddMesh(quad), PlaceUpright({0, 0, kHeight}, turn), world.entity, {1, 1, 1}, glow});
    world.Build();
  }
};

TEST(LampLight, AHeadLampLightsTheWallBeforeItByTheSquareOfTheDistanceAndItsBeam) {
  const Vec3f axis = Normalized(Vec3f{0, -1, kBeamDrop});
  for (const float distance : {3.0f, 6.0f, 10.0f}) {
    const HeadLamp lamp(distance);
    // Straight ahead, down, up beyond the cut-off, to the side.
    std::vector<Vec3f> points;
    for (const Vec3f way :
         {Vec3f{0, -1, kBeamDrop}, Vec3f{0, -1, -0.05f}, Vec3f{0, -1, 0.2f}, Vec3f{0.2f, -1, -0.02f}, Vec3f{0.7f, -1, 0.01f}})
      points.push_back(Vec3f{0, 0, HeadLamp::kHeight} + way * distance);
    const std::vector<float> light = lamp.world.Light(points, 2, {0, 1, 0});
    for (size_t i = 0; i < points.size(); ++i) {
      const Vec3f to = points[i] - Vec3f{0, 0, HeadLamp::kHeight}, w = Normalized(to);
      const double spread = 1 + HeadLamp::kSharp * (1 - Dot(axis, w)), cut = 0.06 + 0.94 * std::clamp(0.45 - 10 * w.z, 0.0, 1.0);
      const double candela = HeadLamp::kRadiance * HeadLamp::kArea * -w.y * cut / (spread * spread);
      EXPECT_NEAR(light[i] / (candela / Dot(to, to) * -w.y), 1, 0.01) << distance << " m, point " << i;
    }
  }
}

TEST(LampLight, LampsAreColouredAndSwitchedOffByInstanceAndTurnWithIt) {
  const std::vector<Vec3f> ahead = {{0, -4, 0.5f}};
  const float white = HeadLamp(4).world.Light(ahead, 2, {0, 1, 0})[0];
  EXPECT_NEAR(HeadLamp(4, {1, 0.25f, 0}).world.Light(ahead, 2, {0, 1, 0})[0], 0.25f * white, 1e-3f * white);
  const HeadLamp off(4, {});
  EXPECT_EQ(off.world.lights->size(), 0u);
  EXPECT_EQ(off.world.Light(ahead, 2, {0, 1, 0})[0], 0);
  EXPECT_LT(HeadLamp(4, {1, 1, 1}, kPiF / 3).world.Light(ahead, 2, {0, 1, 0})[0], 0.05f * white);
}

TEST(LampLight, ABallOverAPlaneFollowsTheInverseSquareLaw) {
  World world;
  const float radius = 0.1f, height = 3, radiance = 0.2f;
  world.Add(Quad({-30, -30, 0}, {30, -30, 0}, {30, 30, 0}, {-30, 30, 0}), 0.2f);
  world.Add(Ball({0, 0, height}, radius), 0, {radiance, radiance, radiance});
  world.Build();
  const std::vector<Vec3f> points = Row();
  for (int rays : {0, 2}) {
    const std::vector<float> light = world.Light(points, rays);
    for (size_t i = 0; i < points.size(); ++i) {
      const float d2 = Dot(points[i], points[i]) + height * height;
      const float exact = kPiF * radius * radius * radiance * height / (d2 * std::sqrt(d2));
      EXPECT_NEAR(light[i] / exact, 1, 0.02f) << points[i].x << " with rays " << rays;
    }
  }
}

TEST(LampLight, APlateThatFacesDownLightsByTheCosineLawAndNothingAboveIt) {
  World world;
  const float half = 0.1f, height = 4, radiance = 1;
  world.Add(Quad({-30, -30, 0}, {30, -30, 0}, {30, 30, 0}, {-30, 30, 0}), 0.2f);
  world.Add(Quad({-5, -5, 9}, {-5, 5, 9}, {5, 5, 9}, {5, -5, 9}), 0.2f);
  world.Add(Quad({-half, -half, height}, {-half, half, height}, {half, half, height}, {half, -half, height}), 0,
            {radiance, radiance, radiance});
  world.Build();
  const std::vector<Vec3f> points = Row();
  const std::vector<float> light = world.Light(points);
  for (size_t i = 0; i < points.size(); ++i) {
    const float d2 = Dot(points[i], points[i]) + height * height;
    const float exact = 4 * half * half * radiance * height * height / (d2 * d2);
    EXPECT_NEAR(light[i] / exact, 1, 0.02f) << points[i].x;
  }
  for (float x : world.Light({{0, 0, 9}, {1, 1, 9}}, 2, {0, 0, -1})) EXPECT_EQ(x, 0);
}

// What a glossy place on a wall mirrors of a plate under the ceiling, by the kernel and its rays. Half of the corners of its cell are
// behind the wall. Brighter plates to both sides light the place more, but are not where it mirrors the viewer.
float HighlightOnAWall(bool with_others, const float* in_room) {
  World world;
  const auto plate = [&](float x, float radiance) {
    world.Add(Quad({x - 0.3f, 1.8f, 2.4f}, {x + 0.3f, 1.8f, 2.4f}, {x + 0.3f, 1.2f, 2.4f}, {x - 0.3f, 1.2f, 2.4f}), 0,
              {radiance, radiance, radiance});
  };
  plate(2, 4);
  world.Add(Quad({-8, 0, 0}, {-8, 0, 4}, {12, 0, 4}, {12, 0, 0}), 0.5f);
  world.Add(Quad({-8, -0.1f, 0}, {12, -0.1f, 0}, {12, -0.1f, 4}, {-8, -0.1f, 4}), 0.5f);
  if (with_others) {
    for (float x : {-1.5f, -0.5f, 4.5f, 5.5f}) plate(x, 60);
  }
  world.Build();
  auto rays = std::make_unique<RaySet>();
  auto s = std::make_unique<SurfaceSet>();
  auto wanted = std::make_unique<LampRays>();
  *rays = {}, *s = {};
  rays->count = 1;
  s->px[0] = 2, s->pz[0] = 1.6f, s->ny[0] = s->gy[0] = 1;
  s->ar[0] = s->ag[0] = s->ab[0] = 0.7f, s->roughness[0] = 0.1f;
  const Vec3f d = Normalized(Vec3f{0, -1.5f, 0.8f});
  rays->dx[0] = d.x, rays->dy[0] = d.y, rays->dz[0] = d.z, rays->distance[0] = 2;
  AIRSIM360_SELECT_KERNEL(LightByLamps)(world.view, *rays, 2, in_room, *s, *wanted);
  TraceLamps(*world.tracer, *world.tables, *rays, *wanted, 2, *s);
  return s->lamp_shine_g[0];
}

TEST(LampLight, InRoomsRaysGoWhereHighlightsStandOut) {
  const float in_room[kBatch] = {1};
  const float alone = HighlightOnAWall(false, nullptr);
  EXPECT_GT(alone, 0.01f);
  EXPECT_NEAR(HighlightOnAWall(false, in_room), alone, 0.01f * alone);
  EXPECT_NEAR(HighlightOnAWall(true, in_room), alone, 0.03f * alone);
  EXPECT_LT(HighlightOnAWall(true, nullptr), 0.9f * alone);  // by corners of the cell alone
}

// Skins too rough for a highlight give back about as much of the light of lamps as paths find: that they answer every angle alike
// is a fifth of it here. Base black, so that nothing else is seen.
TEST(LampLight, MattSkinsGiveBackWhatPathsFind) {
  World world;
  Material black;
  black.base_color = {0, 0, 0}, black.roughness = 0.9f;
  world.Add(Quad({-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}), black);
  for (const Vec3f p : {Vec3f{3, 0, 2.5f}, {-2, 3, 2}, {-1, -4, 3}, {5, 4, 3}, {0.5f, 1, 3.2f}}) world.Add(Ball(p, 0.2f), 0, {20, 20, 20});
  world.Build();
  const auto renderer = MakeCpuRenderer(world.tracer, {.tier = Tier::kFast, .environment = world.tracer->scene().environment});
  double light[2] = {};
  for (const Vec3d p : {Vec3d{0, 0, 1.5}, {4, -3, 2}, {-5, 1, 1}}) {
    RenderRequest request = MakeRequest(Equirectangular{64, 32}, BodyPose(p, 0, 0, 0) * CameraInBody(), Tier::kFast, {.radiance = true});
    for (const Tier tier : {Tier::kFast, Tier::kReference}) {
      request.tier = tier, request.samples = 64;
      Frame frame;
      renderer->Render(request, frame);
      for (int y = 18; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
          light[tier == Tier::kReference] += static_cast<double>(frame.radiance(x, y).g) * std::cos((y + 0.5) / 32 * kPi - kPi / 2);
    }
  }
  EXPECT_GT(light[1], 0);
  EXPECT_NEAR(light[0] / light[1], 1, 0.25);
}

TEST(LampLight, NoLampLightsThroughAWall) {
  World world;
  world.Add(Quad({-30, -30, 0}, {30, -30, 0}, {30, 30, 0}, {-30, 30, 0}), 0.2f);
  world.Add(Ball({-1, 0, 2}, 0.1f), 0, {1, 1, 1});
  world.Add(Ball({-3, 1, 2}, 0.1f), 0, {1, 1, 1});
  world.Add(Quad({0, -30, 0}, {0, 30, 0}, {0, 30, 20}, {0, -30, 20}), 0.2f);
  world.Build();
  // What the cells guessed is taken back, up to rounding.
  for (float x : world.Light({{0.3f, 0, 0}, {1, 1, 0}, {3, -1, 0}, {8, 0, 0}})) EXPECT_NEAR(x, 0, 1e-8f);
  for (float x : world.Light({{-0.3f, 0, 0}, {-1, 1, 0}, {-3, -1, 0}, {-8, 0, 0}})) EXPECT_GT(x, 0);
}

TEST(LampLight, AClearPaneDimsAndASolidOneHides) {
  for (const bool clear : {true, false}) {
    World world;
    world.Add(Quad({-30, -30, 0}, {30, -30, 0}, {30, 30, 0}, {-30, 30, 0}), 0.2f);
    world.Add(Ball({0, 0, 3}, 0.1f), 0, {1, 1, 1});
    Material glass;
    glass.kind = SurfaceKind::kGlass;
    glass.base_color = {0.5f, 0.5f, 0.5f};
    glass.transmission = clear ? 1.0f : 0.0f;
    world.Add(Quad({-9, -9, 1}, {9, -9, 1}, {9, 9, 1}, {-9, 9, 1}), glass);
    world.Build();
    EXPECT_EQ(world.tracer->has_clear_panes(), clear);
    // Two faces of 4 % each at right angles.
    const float exact = kPiF * 0.01f / 9 * 0.5f * (1 - 0.04f) / (1 + 0.04f);
    EXPECT_NEAR(world.Light({{0, 0, 0}})[0], clear ? exact : 0, 0.02f * exact);
    // Camera rays meet the pane all the same.
    const auto hit = world.tracer->Intersect({0.3f, 0.2f, 2}, {0, 0, -1});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 1, 1e-5);
  }
}

TEST(LampLight, ProbesInAClosedBoxHaveTheSeriesOfAllBounces) {
  for (const float albedo : {0.3f, 0.6f}) {
    World world;
    const float half = 0.12f, side = 5;
    world.Add(Room({-side / 2, -side / 2, 0}, {side / 2, side / 2, side}), albedo);
    // The lamp is a cube: with as few triangles as the room, so that probes stand in all of it.
    Mesh lamp = Room({-half, -half, side / 2 - half}, {half, half, side / 2 + half});
    for (Vec3u& t : lamp.triangles) std::swap(t.y, t.z);
    world.Add(lamp, 0, {1, 1, 1});
    world.Build();
    const LightProbes probes({*world.tracer, *world.tables, nullptr, world.lights.get(), world.grid.get()}, {.max_probes = 6000});
    // All light that walls get: the lamp's own, and what the probes say of bounces.
    double direct = 0, bounced = 0;
    int count = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 2 * 64; ++k) {
        Vec3f p, n;
        n[axis] = k % 2 ? 1.0f : -1.0f;
        p[axis] = -n[axis] * side / 2;
        p[(axis + 1) % 3] = (static_cast<float>(k / 2 % 8) + 0.5f) / 8 * side - side / 2;
        p[(axis + 2) % 3] = (static_cast<float>(k / 16) + 0.5f) / 8 * side - side / 2;
        p.z += side / 2;
        direct += world.grid->Irradiance(p + n * 0.001f, n).y;
        bounced += probes.Irradiance(p + n * 0.1f, n).y;
        ++count;
      }
    }
    const double power = kPiF * 6 * 4 * half * half, area = 6 * side * side;
    EXPECT_NEAR(direct / count / (power / area), 1, 0.03) << albedo;
    EXPECT_NEAR((direct + bounced) / count / (power / area / (1 - albedo)), 1, 0.06) << albedo;
  }
}

TEST(LampLight, IsTheSameOnEveryInstructionSetAndWithAnyNumberOfThreads) {
  World world;
  world.Add(Quad({-30, -30, 0}, {30, -30, 0}, {30, 30, 0}, {-30, 30, 0}), 0.2f);
  for (int k = 0; k < 20; ++k) {
    const float a = static_cast<float>(k);
    world.Add(Ball({5 * std::sin(a), 7 * std::cos(2 * a), 2 + 0.1f * a}, 0.1f), 0, {1, 0.5f + 0.02f * a, 0.3f});
  }
  world.Build();
  auto rays = std::make_unique<RaySet>();
  *rays = {};
  rays->count = kBatch - 5;
  auto start = std::make_unique<SurfaceSet>();
  *start = {};
  for (int i = 0; i < kBatch; ++i) {
    start->px[i] = static_cast<float>(i % 16) - 7.3f, start->py[i] = static_cast<float>(i / 16) * 0.9f - 6.2f;
    start->nx[i] = 0.1f, start->nz[i] = 0.995f, start->gz[i] = 1;
    start->ar[i] = start->ag[i] = start->ab[i] = 0.4f;
    start->roughness[i] = 0.01f * static_cast<float>(i % 100);
    start->kind[i] = i % 7 == 0 ? 1.0f : 0.0f;
    rays->dx[i] = 0.6f, rays->dz[i] = -0.8f, rays->key[i] = static_cast<uint32_t>(i);
  }
  struct Result {
    SurfaceSet s;
    LampRays wanted;
  };
  float in_room[kBatch];
  for (int i = 0; i < kBatch; ++i) in_room[i] = static_cast<float>(i % 2);
  const auto run = [&](auto kernel, const ShadeView& view) {
    auto result = std::make_unique<Result>();
    std::memset(static_cast<void*>(result.get()), 0, sizeof(Result));
    result->s = *start;
    kernel(view, *rays, 4, in_room, result->s, result->wanted);
    return result;
  };
  const auto base = run(isa_sse42::LightByLamps, world.view);
  EXPECT_GT(base->s.lamp_g[3], 0);
  const auto same = [&](const Result& other) { return std::memcmp(base.get(), &other, sizeof(Result)) == 0; };
  if (CurrentKernelIsa() >= KernelIsa::kAvx2) {
    EXPECT_TRUE(same(*run(isa_avx2::LightByLamps, world.view)));
  }
  if (CurrentKernelIsa() >= KernelIsa::kAvx512) {
    EXPECT_TRUE(same(*run(isa_avx512::LightByLamps, world.view)));
  }
  const ThreadLimit one(1);
  const LampGrid single(*world.tracer, *world.lights, 0);
  ShadeView view{};
  view.lamps = single.view();
  EXPECT_TRUE(same(*run(isa_sse42::LightByLamps, view)));
}

}  // namespace
}  // namespace airsim360::internal

#include "airsim360/render/shading/shader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/shading/shade_view.h"
#include "airsim360/render/shared/shading_kernels.h"

namespace airsim360 {
namespace {

// A horizontal plane z = 0, 2 half wide, facing up, with uv in metres.
Mesh Plane(float half, float z = 0) {
  Mesh mesh;
  mesh.positions = {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
  for (Vec3f p : mesh.positions) mesh.uvs.push_back({p.x, -p.y});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

struct World {
  SceneBuilder builder{"test"};
  EntityId entity = builder.AddEntity("all", builder.tree().At("construction/building"));
  std::shared_ptr<const RayTracer> tracer;
  std::unique_ptr<const Shader> shader;

  World() {
    builder.AddSky();
    builder.environment().cloud_cover = 0;
  }
  void Add(Mesh mesh, Material material, Vec3f tint = {1, 1, 1}) {
    const MaterialId id = builder.AddMaterial(std::move(material));
    mesh.parts = {{0, static_cast<uint32_t>(mesh.triangles.size()), id, kNoEntity}};
    builder.AddInstance({builder.AddMesh(std::move(mesh)), AffineTransform(), entity, tint});
  }
  void Build() {
    tracer = std::make_shared<const RayTracer>(builder.Build());
    shader = std::make_unique<const Shader>(tracer, tracer->scene().environment);
  }
  // Radiance along rays from one point.
  std::vector<Vec3f> See(Vec3f origin, const std::vector<Vec3f>& directions, float cone = 1e-3f, uint32_t key = 0) const {
    std::vector<Vec3f> out;
    for (size_t first = 0; first < directions.size(); first += HitBatch::kCapacity) {
      HitBatch batch;
      batch.origin = origin;
      batch.cone_angle = cone;
      batch.count = static_cast<int>(std::min<size_t>(HitBatch::kCapacity, directions.size() - first));
      for (int i = 0; i < batch.count; ++i) {
        const Vec3f d = directions[first + i];
        batch.direction_x[i] = d.x, batch.direction_y[i] = d.y, batch.direction_z[i] = d.z;
        const auto hit = tracer->Intersect(origin, d);
        batch.instance[i] = hit ? hit->surface.instance : kMiss;
        batch.triangle[i] = hit ? hit->surface.triangle : 0;
        batch.distance[i] = hit ? hit->distance : -1;
        batch.u[i] = hit ? hit->u : 0;
        batch.v[i] = hit ? hit->v : 0;
        batch.sample_key[i] = key;
      }
      RadianceBatch light;
      shader->Shade(batch, light);
      for (int i = 0; i < batch.count; ++i) out.push_back({light.r[i], light.g[i], light.b[i]});
    }
    return out;
  }
  Vec3f SeeOne(Vec3f origin, Vec3f target) const { return See(origin, {Normalized(target - origin)})[0]; }
};

Material Matte(float albedo) {
  Material material;
  material.base_color = {albedo, albedo, albedo};
  material.roughness = 1;
  return material;
}

TEST(Shader, SunlitGroundIsBrighterThanGroundInShadowByTheSunsShare) {
  World world;
  world.Add(Plane(40), Matte(0.2f));
  world.Add(Plane(3, 8), Matte(0.2f));
  world.Build();
  const internal::Sky sky(world.tracer->scene().environment);
  const Vec3f s = sky.to_sun();
  const Vec3f shadow = Vec3f{-s.x, -s.y, 0} * (8 / s.z);
  const Vec3f sunlit = world.SeeOne({20, 20, 6}, {20, 22, 0}), shaded = world.SeeOne(shadow + Vec3f{0, -6, 5}, shadow);
  EXPECT_NEAR((sunlit.y - shaded.y) * kPiF / 0.2f, sky.sun_irradiance().y * s.z, 0.12f * sky.sun_irradiance().y);
  EXPECT_GT(shaded.y, 0.2f / kPiF * 0.5f * sky.Irradiance({0, 0, 1}).y);
  // A sunlit grey of 0.18 sits in the middle of the tone curve.
  const Vec3f grey = sunlit * (0.18f / 0.2f);
  Rgb8 shown;
  world.shader->ToneMap(&grey.x, &grey.y, &grey.z, 1, 0, &shown);
  EXPECT_GT(shown.g, 120);
  EXPECT_LT(shown.g, 175);
}

TEST(Shader, AFlatLitPlaneShowsNoSelfShadowing) {
  World world;
  world.Add(Plane(2000), Matte(0.2f));
  world.Build();
  for (Vec3f origin : {Vec3f{3, 4, 2}, Vec3f{900, -700, 60}}) {
    std::vector<Vec3f> rays;
    RngStream random(3, "acne");
    for (int i = 0; i < 2000; ++i) {
      const double a = random.Uniform(0, 6.28), down = random.Uniform(0.05, 1.2);
      rays.push_back({static_cast<float>(std::cos(down) * std::cos(a)), static_cast<float>(std::cos(down) * std::sin(a)),
                      static_cast<float>(-std::sin(down))});
    }
    float least = 1e9f;
    for (Vec3f c : world.See(origin, rays)) least = std::min(least, c.y);
    const float shade = 0.2f / kPiF * 3.5f;  // what ambient light alone gives
    EXPECT_GT(least, 1.5f * shade);
  }
}

TEST(Shader, AFineCheckerFadesToItsMean) {
  World world;
  Image<Rgba8> checker(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const uint8_t v = (x ^ y) & 1 ? 220 : 40;
      checker(x, y) = {v, v, v, 255};
    }
  }
  Material material = Matte(1);
  material.base_color_texture = world.builder.AddTexture(Texture::FromImage("checker", checker, true));
  world.Add(Plane(60), material);
  world.Build();
  // From 30 m a pixel holds dozens of texels: neighbours must look alike.
  std::vector<Vec3f> rays;
  for (int i = 0; i < 256; ++i)
    rays.push_back(Normalized(Vec3f{0.001f * static_cast<float>(i % 16), 0.001f * static_cast<float>(i / 16), -1}));
  float low = 1e9f, high = 0;
  for (Vec3f c : world.See({0.3f, 0.2f, 30}, rays, 3.14159f / 1024)) low = std::min(low, c.y), high = std::max(high, c.y);
  EXPECT_LT(high / low, 1.03f);
  // Close by the squares are there.
  low = 1e9f, high = 0;
  for (Vec3f& d : rays) d = Normalized(Vec3f{d.x * 8, d.y * 8, d.z});
  for (Vec3f c : world.See({0.3f, 0.2f, 0.5f}, rays, 3.14159f / 8192)) low = std::min(low, c.y), high = std::max(high, c.y);
  EXPECT_GT(high / low, 3);
}

TEST(Shader, InstanceTintMultipliesColour) {
  World world;
  world.Add(Plane(10), Matte(0.4f), {1, 0.5f, 0.25f});
  world.Build();
  World plain;
  plain.Add(Plane(10), Matte(0.4f));
  plain.Build();
  const Vec3f tinted = world.SeeOne({0, 0, 5}, {1, 1, 0}), white = plain.SeeOne({0, 0, 5}, {1, 1, 0});
  EXPECT_NEAR(tinted.x / white.x, 1, 0.03f);
  EXPECT_NEAR(tinted.y / white.y, 0.5f, 0.06f);  // the skin's reflection is not tinted
  EXPECT_NEAR(tinted.z / white.z, 0.25f, 0.08f);
}

TEST(Shader, PanesReflectTheSkyMoreTheFlatterTheyAreSeen) {
  World world;
  Material glass = Matte(0.02f);
  glass.kind = SurfaceKind::kGlass;
  world.Add(Plane(40), glass);
  world.Build();
  const Vec3f steep = world.SeeOne({0, 0, 5}, {0, 1, 0}), flat = world.SeeOne({0, 0, 0.5f}, {0, 12, 0});
  EXPECT_GT(flat.y, 2.5f * steep.y);
  const Vec3f mirrored = world.See({0, 0, 5}, {Normalized(Vec3f{0, 12, 0.5f})})[0];
  EXPECT_NEAR(flat.y / mirrored.y, 0.75f, 0.3f);
}

TEST(Shader, LeavesGlowAgainstTheSun) {
  for (float transmission : {0.0f, 0.8f}) {
    World world;
    Material leaf = Matte(0.15f);
    leaf.kind = SurfaceKind::kFoliage;
    leaf.transmission = transmission;
    world.Add(Plane(30, 10), leaf);
    world.Build();
    const float below = world.SeeOne({0, 0, 5}, {1, 1, 10}).y, above = world.SeeOne({0, 0, 15}, {1, 1, 10}).y;
    if (transmission > 0) {
      EXPECT_GT(below, 0.4f * above);
      EXPECT_LT(below, 1.2f * above);
    } else {
      EXPECT_LT(below, 0.2f * above);
    }
  }
}

TEST(Shader, FarSurfacesFadeIntoTheHorizon) {
  World world;
  world.builder.environment().turbidity = 6;
  world.Add(Plane(60000), Matte(0.02f));
  world.Build();
  const Vec3f near = world.SeeOne({0, 0, 50}, {50, 0, 0}), far = world.SeeOne({0, 0, 50}, {40000, 0, 0});
  const Vec3f horizon = world.See({0, 0, 50}, {Normalized(Vec3f{1, 0, 0.02f})})[0];
  EXPECT_LT(std::fabs(far.y - horizon.y), 0.35f * horizon.y);
  EXPECT_GT(far.y, 2 * near.y);
}

TEST(Shader, DoesNotDependOnTheOrderOfHits) {
  World world;
  world.Add(Plane(40), Matte(0.3f));
  Material glass = Matte(0.02f);
  glass.kind = SurfaceKind::kGlass;
  world.Add(Plane(5, 3), glass);
  world.Build();
  std::vector<Vec3f> rays;
  RngStream random(5, "order");
  for (int i = 0; i < 200; ++i)
    rays.push_back(Normalized(Vec3f{static_cast<float>(random.Uniform(-1, 1)), static_cast<float>(random.Uniform(-1, 1)),
                                    static_cast<float>(random.Uniform(-1, 0.3))}));
  const std::vector<Vec3f> forward = world.See({1, 2, 7}, rays);
  std::reverse(rays.begin(), rays.end());
  std::vector<Vec3f> backward = world.See({1, 2, 7}, rays);
  std::reverse(backward.begin(), backward.end());
  EXPECT_EQ(forward, backward);
}

TEST(Shader, SunSamplesSoftenShadowsAroundTheSameMean) {
  World world;
  world.Add(Plane(60), Matte(0.2f));
  world.Add(Plane(6, 20), Matte(0.2f));
  world.Build();
  const internal::Sky sky(world.tracer->scene().environment);
  const Vec3f s = sky.to_sun();
  // Just on the border of the shadow some samples see the sun and some do not.
  const Vec3f edge = Vec3f{6, 0, 0} + Vec3f{-s.x, -s.y, 0} * (20 / s.z);
  int lit = 0;
  for (uint32_t key = 1; key <= 64; ++key) {
    const Vec3f origin = edge + Vec3f{0, 0, 4};
    lit += world.See(origin, {{0, 0, -1}}, 1e-3f, key * 2654435761u)[0].y > 0.6f;
  }
  EXPECT_GT(lit, 8);
  EXPECT_LT(lit, 56);
}

TEST(Shader, SurvivesCoordinatesThatAreNotNumbers) {
  World world;
  Image<Rgba8> grey(16, 16, {120, 120, 120, 255});
  Material material = Matte(0.5f);
  material.base_color_texture = world.builder.AddTexture(Texture::FromImage("grey", grey, true));
  material.normal_texture = material.base_color_texture;
  material.metallic = 1;
  material.roughness = 0.2f;
  Mesh mesh = Plane(10);
  mesh.uvs = {{NAN, 0}, {INFINITY, 1e38f}, {-INFINITY, -1e38f}, {3e38f, NAN}};
  mesh.normals = {{NAN, NAN, NAN}, {0, 0, 0}, {1e30f, 1e30f, 0}, {0, 0, 1}};
  world.Add(mesh, material);
  world.Add(Plane(1e-25f, 2), material);
  world.Add(Plane(1e20f, -5), material);
  world.Build();
  std::vector<Vec3f> rays;
  for (int i = 0; i < 100; ++i) {
    rays.push_back(Normalized(Vec3f{0.05f * static_cast<float>(i % 10 - 5), 0.05f * static_cast<float>(i / 10 - 5), -1}));
  }
  EXPECT_EQ(world.See({0.1f, 0.2f, 4}, rays).size(), rays.size());
}

// The copies for every instruction set of this machine give the same bytes.
TEST(Shader, AllInstructionSetsAgreeToTheBit) {
  World world;
  Image<Rgba8> noise(32, 32);
  RngStream random(7, "isa");
  for (Rgba8& p : noise.pixels())
    p = {static_cast<uint8_t>(random.Index(256)), static_cast<uint8_t>(random.Index(256)), static_cast<uint8_t>(random.Index(256)), 255};
  Material material = Matte(0.7f);
  material.base_color_texture = world.builder.AddTexture(Texture::FromImage("noise", noise, true));
  material.normal_texture = world.builder.AddTexture(Texture::FromImage("bumps", noise, false));
  material.macro_variation = 0.3f;
  world.Add(Plane(20), material);
  Material water = Matte(0.05f);
  water.kind = SurfaceKind::kWater;
  world.Add(Plane(5, 1), water);
  world.Build();
  const Scene& scene = world.tracer->scene();
  const internal::SurfaceTables tables(scene);
  const internal::Sky sky(scene.environment);
  const internal::ShadeView view = internal::MakeShadeView(scene, tables, &sky, nullptr);

  internal::RaySet rays{};
  rays.count = internal::kBatch;
  for (int i = 0; i < internal::kBatch; ++i) {
    const Vec3f d = Normalized(Vec3f{static_cast<float>(random.Uniform(-1, 1)), static_cast<float>(random.Uniform(-1, 1)), -0.5f});
    rays.oz[i] = 6, rays.dx[i] = d.x, rays.dy[i] = d.y, rays.dz[i] = d.z;
    rays.distance[i] = -6 / d.z, rays.width[i] = 0.003f * rays.distance[i];
    rays.u[i] = static_cast<float>(random.Uniform(0, 0.5)), rays.v[i] = static_cast<float>(random.Uniform(0, 0.5));
    rays.instance[i] = static_cast<uint32_t>(i % 2), rays.triangle[i] = static_cast<uint32_t>(i / 2 % 2);
    rays.key[i] = static_cast<uint32_t>(i % 3);
  }
  struct Result {
    internal::SurfaceSet surfaces{};
    internal::LightSet light{}, sky{};
    Rgb8 shown[internal::kBatch]{};
  };
  const auto run = [&](auto prepare, auto shade, auto look_up, auto tone) {
    auto result = std::make_unique<Result>();
    prepare(view, rays, result->surfaces);
    shade(view, rays, result->surfaces, result->light);
    look_up(view, rays, true, result->sky);
    tone(result->light.r, result->light.g, result->light.b, internal::kBatch - 3, 0.4f, 1, result->shown);
    return result;
  };
  using namespace internal;
  const auto base = run(isa_sse42::PrepareSurfaces, isa_sse42::LightSurfaces, isa_sse42::LookUpSky, isa_sse42::ToneMapRow);
  const auto expect_same = [&](const Result& other, const char* name) {
    EXPECT_EQ(std::memcmp(&base->surfaces, &other.surfaces, sizeof(SurfaceSet)), 0) << name;
    EXPECT_EQ(std::memcmp(&base->light, &other.light, sizeof(LightSet)), 0) << name;
    EXPECT_EQ(std::memcmp(&base->sky, &other.sky, sizeof(LightSet)), 0) << name;
    EXPECT_EQ(std::memcmp(base->shown, other.shown, sizeof(base->shown)), 0) << name;
  };
  EXPECT_GT(base->light.g[0], 0);
  if (CurrentKernelIsa() >= KernelIsa::kAvx2)
    expect_same(*run(isa_avx2::PrepareSurfaces, isa_avx2::LightSurfaces, isa_avx2::LookUpSky, isa_avx2::ToneMapRow), "avx2");
  if (CurrentKernelIsa() >= KernelIsa::kAvx512)
    expect_same(*run(isa_avx512::PrepareSurfaces, isa_avx512::LightSurfaces, isa_avx512::LookUpSky, isa_avx512::ToneMapRow), "avx512");
}

}  // namespace
}  // namespace airsim360

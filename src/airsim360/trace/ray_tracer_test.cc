#include "airsim360/trace/ray_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/trace/closest_point.h"

namespace airsim360 {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Box with eight shared vertices, faces outwards.
Mesh BoxMesh(Vec3f min, Vec3f max) {
  Mesh mesh{"box", {}, {}, {}, {}, {}};
  for (int i = 0; i < 8; ++i) mesh.positions.push_back({i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z});
  const uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : quads) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

// Unit sphere of a subdivided octahedron.
Mesh SphereMesh(int levels) {
  Mesh mesh{"sphere", {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, {}, {}, {}, {}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::vector<Vec3u> next;
    for (Vec3u t : mesh.triangles) {
      const auto middle = [&](uint32_t a, uint32_t b) {
        mesh.positions.push_back(Normalized(mesh.positions[a] + mesh.positions[b]));
        return static_cast<uint32_t>(mesh.positions.size() - 1);
      };
      const uint32_t a = middle(t.x, t.y), b = middle(t.y, t.z), c = middle(t.z, t.x);
      next.insert(next.end(), {{t.x, a, c}, {a, t.y, b}, {c, b, t.z}, {a, b, c}});
    }
    mesh.triangles = next;
  }
  return mesh;
}

Vec3f RandomDirection(RngStream& rng) {
  const double z = rng.Uniform(-1, 1), a = rng.Uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
  return {static_cast<float>(r * std::cos(a)), static_cast<float>(r * std::sin(a)), static_cast<float>(z)};
}

AffineTransform RandomAffine(RngStream& rng, float spread) {
  AffineTransform X = PlaceUpright({}, static_cast<float>(rng.Uniform(0, 6)), static_cast<float>(rng.Uniform(0.5, 2)));
  X.A = X.A * Mat3f{{{{1, 0.2f, 0}, {0, 1.5f, 0.1f}, {0.3f, 0, 0.8f}}}};
  for (int i = 0; i < 3; ++i) X.p[i] = static_cast<float>(rng.Uniform(-spread, spread));
  return X;
}

std::shared_ptr<const Scene> SceneOf(const Mesh& mesh, const std::vector<AffineTransform>& places) {
  SceneBuilder builder("test");
  const EntityId entity = builder.AddEntity("thing", builder.tree().At("construction/building"));
  const MeshId id = builder.AddMesh(mesh);
  for (const AffineTransform& X : places) builder.AddInstance({id, X, entity});
  return builder.Build();
}

// Sixteen rays from one point.
RayHit16 Packet(Vec3f origin, RngStream& rng) {
  RayHit16 rays;
  std::memset(&rays, 0, sizeof(rays));
  for (int i = 0; i < 16; ++i) {
    const Vec3f d = RandomDirection(rng);
    rays.origin_x[i] = origin.x;
    rays.origin_y[i] = origin.y;
    rays.origin_z[i] = origin.z;
    rays.direction_x[i] = d.x;
    rays.direction_y[i] = d.y;
    rays.direction_z[i] = d.z;
    rays.t_far[i] = kInfinity;
    rays.mask[i] = ~0u;
  }
  return rays;
}

struct alignas(64) Lanes {
  int active[16];
};

TEST(RayTracer, FromInsideASphereTheDistanceIsItsRadius) {
  const RayTracer tracer(SceneOf(SphereMesh(6), {AffineTransform()}));
  RngStream rng(1, "test");
  for (int i = 0; i < 1000; ++i) {
    const auto hit = tracer.Intersect({}, RandomDirection(rng));
    ASSERT_TRUE(hit);
    // Sagitta of an edge of length 2^-6 * sqrt(2) or less.
    EXPECT_NEAR(hit->distance, 1, 5e-4);
    EXPECT_LE(hit->distance, 1 + 1e-6f);
  }
}

TEST(RayTracer, InABoxEveryRayHitsTheWallOfTheSlabTestAtItsDistance) {
  const Vec3f min{-2, -3, -1}, max{4, 1, 5};
  const RayTracer tracer(SceneOf(BoxMesh(min, max), {AffineTransform()}));
  RngStream rng(2, "test");
  for (int i = 0; i < 2000; ++i) {
    const Vec3f d = RandomDirection(rng), o{0.3f, -0.4f, 0.7f};
    double expected = 1e30;
    int axis = -1;
    for (int k = 0; k < 3; ++k) {
      const double t = (static_cast<double>(d[k] > 0 ? max[k] : min[k]) - o[k]) / d[k];
      if (t < expected) expected = t, axis = k;
    }
    const auto hit = tracer.Intersect(o, d);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance / expected, 1, 1e-6);
    EXPECT_NEAR(std::abs(hit->normal[axis]), 1, 1e-6);
    EXPECT_LT(Dot(hit->normal, d), 0);
    EXPECT_FALSE(tracer.Intersect(o, d, hit->distance * 0.999f));
  }
}

TEST(RayTracer, NoRaySlipsBetweenNeighbouringTriangles) {
  const Mesh mesh = SphereMesh(4);
  const RayTracer tracer(SceneOf(mesh, {AffineTransform()}));
  // Rays aimed at vertices and along edges.
  for (Vec3u t : mesh.triangles) {
    const Vec3f a = mesh.positions[t.x], b = mesh.positions[t.y], o{0.1f, -0.2f, 0.05f};
    for (float w : {0.0f, 0.25f, 0.5f, 0.6180339f}) EXPECT_TRUE(tracer.Intersect(o, a + (b - a) * w - o));
  }
}

TEST(RayTracer, InstancesAndBakedGeometryAgree) {
  RngStream rng(3, "test");
  const Mesh box = BoxMesh({-1, -1, -1}, {1, 1, 1});
  std::vector<AffineTransform> places;
  for (int i = 0; i < 12; ++i) places.push_back(RandomAffine(rng, 8));
  places.push_back(places[0]);  // mirrored
  places.back().p.x += 20;
  places.back().A = places.back().A * Mat3f{{{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  const RayTracer instanced(SceneOf(box, places));

  // The same as one mesh each.
  SceneBuilder builder("baked");
  const EntityId entity = builder.AddEntity("thing", builder.tree().At("construction/building"));
  for (const AffineTransform& X : places) builder.AddInstance({builder.AddMesh(box), X, entity});
  const RayTracer baked(builder.Build());

  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3f d = RandomDirection(rng), o{0, 0, 3};
    const auto a = instanced.Intersect(o, d), b = baked.Intersect(o, d);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    ++hits;
    EXPECT_EQ(a->surface.instance, b->surface.instance);
    EXPECT_EQ(a->surface.triangle, b->surface.triangle);
    EXPECT_NEAR(a->distance, b->distance, 1e-5f * b->distance);
    EXPECT_GT(Dot(a->normal, b->normal), 0.9999f);
  }
  EXPECT_GT(hits, 500);
}

TEST(RayTracer, SixteenRaysAgreeWithSingleOnesAndInactiveLanesStayAsTheyAre) {
  RngStream rng(4, "test");
  std::vector<AffineTransform> places;
  for (int i = 0; i < 20; ++i) places.push_back(RandomAffine(rng, 6));
  const RayTracer tracer(SceneOf(SphereMesh(3), places));
  int hits = 0;
  for (int round = 0; round < 200; ++round) {
    RayHit16 rays = Packet({0, 0, 0.5f}, rng);
    Lanes valid;
    for (int i = 0; i < 16; ++i) valid.active[i] = rng.Chance(0.8) ? -1 : 0;
    for (int i = 0; i < 16; ++i) {
      if (valid.active[i] == 0) rays.geometry[i] = 77, rays.u[i] = 5;
    }
    const RayHit16 before = rays;
    tracer.Intersect16(valid.active, rays, round % 2 == 0);
    for (int i = 0; i < 16; ++i) {
      if (valid.active[i] == 0) {
        EXPECT_EQ(rays.geometry[i], 77u);
        EXPECT_EQ(rays.u[i], 5);
        EXPECT_EQ(rays.t_far[i], before.t_far[i]);
        continue;
      }
      const Vec3f o{rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]};
      const Vec3f d{rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]};
      const auto hit = tracer.Intersect(o, d);
      ASSERT_EQ(hit.has_value(), rays.geometry[i] != kMiss);
      if (!hit) continue;
      ++hits;
      const SurfaceRef surface = tracer.Resolve(rays.geometry[i], rays.instance[i], rays.primitive[i]);
      EXPECT_EQ(surface.instance, hit->surface.instance);
      EXPECT_EQ(surface.triangle, hit->surface.triangle);
      EXPECT_NEAR(rays.t_far[i], hit->distance, 2e-6f * hit->distance);
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(RayTracer, LookingForClearPanesAloneFindsThoseOfTheWholeScene) {
  SceneBuilder builder("panes");
  const EntityId entity = builder.AddEntity("thing", builder.tree().At("construction/building"));
  Material solid, glass;
  glass.kind = SurfaceKind::kGlass;
  glass.transmission = 0.9f;
  const MaterialId materials[2] = {builder.AddMaterial(solid), builder.AddMaterial(glass)};
  RngStream rng(31, "panes");
  const auto box = [&](uint32_t solid_triangles) {
    Mesh mesh = BoxMesh({-1, -1, -1}, {1, 1, 1});
    if (solid_triangles > 0) mesh.parts.push_back({0, solid_triangles, materials[0]});
    if (solid_triangles < 12) mesh.parts.push_back({solid_triangles, 12 - solid_triangles, materials[1]});
    return mesh;
  };
  // Half of glass, all of it and nothing, each once and several times.
  for (const uint32_t solid_triangles : {0u, 6u, 12u}) {
    const MeshId shared = builder.AddMesh(box(solid_triangles));
    for (int i = 0; i < 20; ++i) builder.AddInstance({shared, RandomAffine(rng, 20), entity});
    builder.AddInstance({builder.AddMesh(box(solid_triangles)), RandomAffine(rng, 20), entity});
  }
  const RayTracer tracer(builder.Build());
  ASSERT_TRUE(tracer.has_clear_panes());
  alignas(64) int valid[16];
  std::fill(valid, valid + 16, -1);
  int hits = 0;
  for (int round = 0; round < 200; ++round) {
    RayHit16 all = Packet({}, rng);
    std::fill(all.mask, all.mask + 16, kMaskClearPanes);
    RayHit16 panes = all;
    tracer.Intersect16(valid, all, false);
    tracer.IntersectClearPanes16(valid, panes);
    for (int i = 0; i < 16; ++i) {
      ASSERT_EQ(all.geometry[i], panes.geometry[i]);
      if (all.geometry[i] == kMiss) continue;
      ++hits;
      ASSERT_EQ(all.instance[i], panes.instance[i]);
      ASSERT_EQ(all.primitive[i], panes.primitive[i]);
      ASSERT_EQ(all.t_far[i], panes.t_far[i]);
    }
  }
  EXPECT_GT(hits, 300);
}

TEST(RayTracer, OcclusionAgreesWithTheNearestHit) {
  RngStream rng(5, "test");
  std::vector<AffineTransform> places;
  for (int i = 0; i < 10; ++i) places.push_back(RandomAffine(rng, 6));
  const RayTracer tracer(SceneOf(SphereMesh(3), places));
  int blocked = 0;
  for (int round = 0; round < 100; ++round) {
    RayHit16 rays = Packet({0, 0, 0.5f}, rng);
    for (float& t : rays.t_far) t = static_cast<float>(rng.Uniform(1, 12));
    const RayHit16 before = rays;
    Lanes valid;
    std::fill(std::begin(valid.active), std::end(valid.active), -1);
    valid.active[round % 16] = 0;
    bool occluded[16] = {};
    tracer.Occluded16(valid.active, rays, occluded, false);
    for (int i = 0; i < 16; ++i) {
      const Vec3f o{rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]};
      const Vec3f d{rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]};
      const bool hit = tracer.Intersect(o, d, before.t_far[i]).has_value();
      EXPECT_EQ(occluded[i], hit && valid.active[i] != 0);
      EXPECT_EQ(tracer.Occluded(o, o + d * before.t_far[i]), hit);
      blocked += hit;
    }
  }
  EXPECT_GT(blocked, 100);
}

// A unit square at z = 0 with uv from 0 to 1 and a 2x2 texture: the left half of it is clear.
std::shared_ptr<const Scene> HalfClearSquare(Wrap wrap, float uv_scale, bool with_opaque_half) {
  SceneBuilder builder("alpha");
  Image<Rgba8> image(2, 2, {255, 255, 255, 255});
  image(0, 0).a = image(0, 1).a = 0;
  Texture texture = Texture::FromImage("half", std::move(image), true);
  texture.wrap_u = wrap;
  Material cut;
  cut.alpha_mode = AlphaMode::kMask;
  cut.base_color_texture = builder.AddTexture(std::move(texture));
  cut.uv_scale = {uv_scale, 1};
  const MaterialId cut_id = builder.AddMaterial(cut), solid_id = builder.AddMaterial({});
  Mesh mesh{"square", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}, {}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.parts = {{0, 2, cut_id, kNoEntity}};
  if (with_opaque_half) mesh.parts = {{0, 1, solid_id, kNoEntity}, {1, 1, cut_id, kNoEntity}};
  const MeshId id = builder.AddMesh(mesh);
  const EntityId entity = builder.AddEntity("leaf", builder.tree().At("construction/building"));
  builder.AddInstance({id, AffineTransform(), entity});
  builder.AddInstance({id, {Mat3f(), {10, 0, 0}}, entity});
  return builder.Build();
}

TEST(AlphaTest, RaysPassWhereTheTextureIsClearAndHitWhereItIsSolid) {
  const RayTracer tracer(HalfClearSquare(Wrap::kClamp, 1, false));
  for (float x = 0.01f; x < 1; x += 0.02f) {
    for (float shift : {0.0f, 10.0f}) {
      const Vec3f above{x + shift, 0.3f, 1};
      // Bilinear alpha crosses the cutoff of one half exactly in the middle.
      EXPECT_EQ(tracer.Intersect(above, {0, 0, -1}).has_value(), x >= 0.5f) << x;
      EXPECT_EQ(tracer.Occluded(above, {x + shift, 0.3f, -1}), x >= 0.5f) << x;
    }
  }
}

TEST(AlphaTest, WrapModesContinueTheTexture) {
  const RayTracer repeat(HalfClearSquare(Wrap::kRepeat, 2, false)), mirror(HalfClearSquare(Wrap::kMirror, 2, false)),
      clamp(HalfClearSquare(Wrap::kClamp, 2, false));
  const auto solid = [](const RayTracer& tracer, float x) { return tracer.Intersect({x, 0.3f, 1}, {0, 0, -1}).has_value(); };
  for (float u : {0.3f, 0.7f, 1.3f, 1.7f}) {
    EXPECT_EQ(solid(repeat, u / 2), u - std::floor(u) > 0.5f) << u;
    EXPECT_EQ(solid(mirror, u / 2), (u < 1 ? u : 2 - u) > 0.5f) << u;
    EXPECT_EQ(solid(clamp, u / 2), u > 0.5f) << u;
  }
}

TEST(AlphaTest, OnlyTheTestedPartsHaveHolesAndTrianglesKeepTheirNumbers) {
  const RayTracer tracer(HalfClearSquare(Wrap::kClamp, 1, true));
  // Triangle 0 (below the diagonal) is solid, triangle 1 is cut.
  const auto low = tracer.Intersect({0.3f, 0.1f, 1}, {0, 0, -1});
  ASSERT_TRUE(low);
  EXPECT_EQ(low->surface.triangle, 0u);
  EXPECT_FALSE(tracer.Intersect({0.3f, 0.8f, 1}, {0, 0, -1}));
  const auto high = tracer.Intersect({10.7f, 0.9f, 1}, {0, 0, -1});
  ASSERT_TRUE(high);
  EXPECT_EQ(high->surface.triangle, 1u);
  EXPECT_EQ(high->surface.instance, 1u);
}

TEST(Clearance, EqualsTheSmallestDistanceOverAllTriangles) {
  RngStream rng(6, "test");
  const Mesh box = BoxMesh({-1, -1, -1}, {1, 1, 1});
  std::vector<AffineTransform> places;
  for (int i = 0; i < 6; ++i) places.push_back(RandomAffine(rng, 5));
  for (bool instanced : {false, true}) {
    SceneBuilder builder("test");
    const EntityId entity = builder.AddEntity("thing", builder.tree().At("construction/building"));
    MeshId id = builder.AddMesh(box);
    for (const AffineTransform& X : places) builder.AddInstance({instanced ? id : builder.AddMesh(box), X, entity});
    const RayTracer tracer(builder.Build());
    for (int i = 0; i < 200; ++i) {
      const Vec3f p = RandomDirection(rng) * static_cast<float>(rng.Uniform(0, 9));
      float expected = 3;
      for (const AffineTransform& X : places) {
        for (Vec3u t : box.triangles) {
          const Vec3f q = internal::ClosestPointOnTriangle(p, X * box.positions[t.x], X * box.positions[t.y], X * box.positions[t.z]);
          expected = std::min(expected, Norm(p - q));
        }
      }
      EXPECT_NEAR(tracer.Clearance(p, 3), expected, 1e-5f);
    }
  }
}

TEST(Clearance, ClosestPointIsNoFartherThanAnyPointOfTheTriangle) {
  RngStream rng(7, "test");
  for (int i = 0; i < 200; ++i) {
    const Vec3f a = RandomDirection(rng), b = RandomDirection(rng), c = RandomDirection(rng), p = RandomDirection(rng) * 2.0f;
    const float distance = Norm(p - internal::ClosestPointOnTriangle(p, a, b, c));
    for (int k = 0; k < 50; ++k) {
      float u = static_cast<float>(rng.Uniform()), v = static_cast<float>(rng.Uniform());
      if (u + v > 1) u = 1 - u, v = 1 - v;
      EXPECT_LE(distance, Norm(p - (a + (b - a) * u + (c - a) * v)) + 1e-6f);
    }
  }
}

// Overwrites the stack below with words that are NaN as floats.
__attribute__((noinline)) void DirtyTheStack() {
  volatile uint32_t words[20000];
  for (volatile uint32_t& word : words) word = UINT32_MAX;
}

TEST(RayTracer, CoherentOcclusionEndsInScenesWithInstances) {
  // Embree 3.13.5 itself does not end here; see Occluded16.
  RngStream rng(10, "test");
  std::vector<AffineTransform> places;
  for (int i = 0; i < 30; ++i) places.push_back(RandomAffine(rng, 15));
  const RayTracer tracer(SceneOf(BoxMesh({-1, -1, -1}, {1, 1, 1}), places));
  Lanes valid;
  std::fill(std::begin(valid.active), std::end(valid.active), -1);
  for (int round = 0; round < 500; ++round) {
    const Vec3f d = RandomDirection(rng);
    RayHit16 rays = Packet(RandomDirection(rng) * 10.0f, rng);
    for (int i = 0; i < 16; ++i) {
      rays.direction_x[i] = d.x + 0.01f * static_cast<float>(i & 3);
      rays.direction_y[i] = d.y + 0.01f * static_cast<float>(i >> 2);
      rays.direction_z[i] = d.z;
    }
    RayHit16 nearest = rays;
    bool occluded[16];
    DirtyTheStack();
    tracer.Occluded16(valid.active, rays, occluded, true);
    tracer.Intersect16(valid.active, nearest, true);
    for (int i = 0; i < 16; ++i) EXPECT_EQ(occluded[i], nearest.geometry[i] != kMiss);
  }
}

TEST(RayTracer, RaysThatAreNotFiniteHitNothingAndDoNotDisturbTheOthers) {
  RngStream rng(9, "test");
  const RayTracer tracer(SceneOf(SphereMesh(3), {AffineTransform()}));
  for (bool coherent : {false, true}) {
    RayHit16 rays = Packet({0, 0, 0.5f}, rng);
    rays.direction_y[3] = std::numeric_limits<float>::quiet_NaN();
    rays.origin_x[9] = kInfinity;
    RayHit16 shadow = rays;
    Lanes valid;
    std::fill(std::begin(valid.active), std::end(valid.active), -1);
    bool occluded[16];
    tracer.Intersect16(valid.active, rays, coherent);
    tracer.Occluded16(valid.active, shadow, occluded, coherent);
    for (int i = 0; i < 16; ++i) {
      EXPECT_EQ(rays.geometry[i] != kMiss, i != 3 && i != 9);
      EXPECT_EQ(occluded[i], i != 3 && i != 9);
    }
  }
  EXPECT_FALSE(tracer.Intersect({0, 0, std::nanf("")}, {0, 0, 1}));
}

TEST(RayTracer, AnEmptySceneIsAllMiss) {
  SceneBuilder builder("empty");
  const RayTracer tracer(builder.Build());
  EXPECT_FALSE(tracer.Intersect({0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(tracer.Occluded({0, 0, 0}, {1, 0, 0}));
  EXPECT_EQ(tracer.Clearance({0, 0, 0}, 7), 7);
}

TEST(RayTracer, InstructionSetsAgreeOnDistances) {
  const auto scene = SceneOf(SphereMesh(3), {AffineTransform()});
  RngStream rng(8, "test");
  const RayTracer a(scene, {"sse4.2"}), b(scene);
  for (int i = 0; i < 300; ++i) {
    const Vec3f d = RandomDirection(rng);
    EXPECT_NEAR(a.Intersect({}, d)->distance, b.Intersect({}, d)->distance, 1e-6f);
  }
}

}  // namespace
}  // namespace airsim360

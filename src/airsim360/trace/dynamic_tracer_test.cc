#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {
namespace {

constexpr int kInstances = 60;

// A rough ball: no two rays meet it alike.
Mesh Ball(RngStream& rng) {
  Mesh mesh{"ball", {}, {}, {}, {}, {}};
  constexpr uint32_t kRings = 8, kSides = 12;
  for (uint32_t r = 0; r <= kRings; ++r) {
    for (uint32_t s = 0; s < kSides; ++s) {
      const double a = std::numbers::pi * r / kRings, b = 2 * std::numbers::pi * s / kSides;
      const double radius = rng.Uniform(0.8, 1.2);
      mesh.positions.push_back({static_cast<float>(radius * std::sin(a) * std::cos(b)),
                                static_cast<float>(radius * std::sin(a) * std::sin(b)), static_cast<float>(radius * std::cos(a))});
    }
  }
  for (uint32_t r = 0; r < kRings; ++r) {
    for (uint32_t s = 0; s < kSides; ++s) {
      const uint32_t a = r * kSides + s, b = r * kSides + (s + 1) % kSides;
      mesh.triangles.push_back({a, a + kSides, b});
      mesh.triangles.push_back({b, a + kSides, b + kSides});
    }
  }
  return mesh;
}

AffineTransform RandomPlace(RngStream& rng) {
  AffineTransform X = PlaceUpright({}, static_cast<float>(rng.Uniform(0, 6)), static_cast<float>(rng.Uniform(0.5, 1.5)));
  for (int i = 0; i < 3; ++i) X.p[i] = static_cast<float>(rng.Uniform(-12, 12));
  return X;
}

// Mesh 0 is shared by most instances; meshes 1 … 9 are used once each.
struct World {
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
};

World RandomWorld(uint64_t seed) {
  RngStream rng(seed, "world");
  World world;
  for (int m = 0; m < 10; ++m) world.meshes.push_back(Ball(rng));
  for (int i = 0; i < kInstances; ++i)
    world.instances.push_back({static_cast<MeshId>(i % 6 == 0 ? i / 6 : 0), RandomPlace(rng), kNoEntity});
  return world;
}

std::shared_ptr<const Scene> BuildScene(const World& world) {
  SceneBuilder builder("world");
  const EntityId entity = builder.AddEntity("ball", builder.tree().At("construction/building"));
  for (const Mesh& mesh : world.meshes) builder.AddMesh(mesh);
  for (Instance instance : world.instances) {
    instance.entity = entity;
    builder.AddInstance(instance);
  }
  return builder.Build();
}

std::vector<Vec3f> Bent(const Mesh& mesh, float phase) {
  std::vector<Vec3f> out = mesh.positions;
  for (Vec3f& p : out) p.x += 0.4f * std::sin(3 * p.z + phase);
  return out;
}

// Both tracers give the same nearest hits and occlusion.
void ExpectSame(const RayTracer& moved, const RayTracer& built, uint64_t seed, int rays = 1500) {
  RngStream rng(seed, "rays");
  int hits = 0;
  for (int i = 0; i < rays; ++i) {
    Vec3f origin, direction;
    for (int k = 0; k < 3; ++k) {
      origin[k] = static_cast<float>(rng.Uniform(-14, 14));
      direction[k] = static_cast<float>(rng.Uniform(-1, 1));
    }
    const auto a = moved.Intersect(origin, direction), b = built.Intersect(origin, direction);
    ASSERT_EQ(a.has_value(), b.has_value()) << i;
    if (!a) continue;
    ++hits;
    EXPECT_NEAR(a->distance, b->distance, 2e-5f * (1 + b->distance));
    EXPECT_EQ(a->surface.instance, b->surface.instance);
    EXPECT_EQ(a->surface.triangle, b->surface.triangle);
    EXPECT_LT(Norm(a->normal - b->normal), 1e-4f);
    const Vec3f end = origin + direction * (i % 2 == 0 ? 0.9f * b->distance : 1.1f * b->distance);
    EXPECT_EQ(moved.Occluded(origin, end), i % 2 != 0);
  }
  EXPECT_GT(hits, rays / 10);
}

TEST(DynamicTracer, MovingAnInstanceIsBuildingTheSceneWithItThere) {
  World world = RandomWorld(1);
  DynamicTracer dynamic(std::make_shared<const RayTracer>(BuildScene(world)));
  RngStream rng(1, "moves");
  SceneState state;
  // 12 is an instance of a mesh of its own, 13 one of the shared mesh.
  for (uint32_t i : {0u, 12u, 13u, 30u, 47u}) {
    state.moved.push_back({i, RandomPlace(rng), false});
    world.instances[i].X_WM = state.moved.back().X_WM;
  }
  const RayTracer built(BuildScene(world));
  ExpectSame(*dynamic.At(std::make_shared<const SceneState>(state)), built, 1);
}

TEST(DynamicTracer, ClearanceIsThatOfTheSceneWithThingsWhereTheyAre) {
  World world = RandomWorld(8);
  DynamicTracer dynamic(std::make_shared<const RayTracer>(BuildScene(world)));
  RngStream rng(8, "moves");
  SceneState state;
  for (uint32_t i : {0u, 12u, 13u, 30u}) {
    state.moved.push_back({i, RandomPlace(rng), false});
    world.instances[i].X_WM = state.moved.back().X_WM;
  }
  state.deformed = {{0, std::make_shared<const std::vector<Vec3f>>(Bent(world.meshes[0], 1))}};
  world.meshes[0].positions = *state.deformed[0].positions;
  const auto moved = dynamic.At(std::make_shared<const SceneState>(state));
  const RayTracer built(BuildScene(world));
  for (int i = 0; i < 500; ++i) {
    Vec3f p;
    for (int k = 0; k < 3; ++k) p[k] = static_cast<float>(rng.Uniform(-14, 14));
    EXPECT_NEAR(moved->Clearance(p, 20), built.Clearance(p, 20), 1e-4f);
  }
}

TEST(DynamicTracer, HiddenInstancesAreNotThere) {
  World world = RandomWorld(2);
  DynamicTracer dynamic(std::make_shared<const RayTracer>(BuildScene(world)));
  SceneState state;
  for (uint32_t i : {6u, 7u, 8u}) {
    state.moved.push_back({i, world.instances[i].X_WM, true});
    world.instances[i].X_WM.p = {1e4f, 0, 0};
  }
  const RayTracer built(BuildScene(world));
  ExpectSame(*dynamic.At(std::make_shared<const SceneState>(state)), built, 2);
}

TEST(DynamicTracer, DeformedMeshesAreBuiltWithTheirVerticesAlsoAfterManyRefits) {
  const World world = RandomWorld(3);
  DynamicTracer dynamic(std::make_shared<const RayTracer>(BuildScene(world)));
  for (int tick = 0; tick < 70; ++tick) {
    SceneState state;
    World bent = world;
    for (MeshId mesh : {0u, 4u}) {
      auto positions = std::make_shared<const std::vector<Vec3f>>(Bent(world.meshes[mesh], 0.1f * static_cast<float>(tick)));
      bent.meshes[mesh].positions = *positions;
      state.deformed.push_back({mesh, std::move(positions)});
    }
    const auto moved = dynamic.At(std::make_shared<const SceneState>(state));
    if (tick % 23 != 0) continue;
    const RayTracer built(BuildScene(bent));
    ExpectSame(*moved, built, 3 + static_cast<uint64_t>(tick), 400);
  }
}

// Where two triangles are met at one range, Embree gives the one that it came to first.
TEST(DynamicTracer, WhichOfTwoCoincidentTrianglesIsMetDoesNotDependOnWhatWasDrawnBefore) {
  World world = RandomWorld(9);
  Mesh& mesh = world.meshes[0];
  const std::vector<Vec3u> once = mesh.triangles;
  mesh.triangles.insert(mesh.triangles.end(), once.rbegin(), once.rend());
  const auto base = std::make_shared<const RayTracer>(BuildScene(world));
  const auto at = [&](DynamicTracer& dynamic, float phase) {
    SceneState state;
    state.deformed.push_back({0, std::make_shared<const std::vector<Vec3f>>(Bent(mesh, phase))});
    return dynamic.At(std::make_shared<const SceneState>(state));
  };
  DynamicTracer fresh(base), used(base);
  for (int tick = 0; tick < 70; ++tick) at(used, 0.5f + 0.2f * static_cast<float>(tick));
  const auto a = at(fresh, 0), b = at(used, 0);
  RngStream rng(9, "rays");
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    Vec3f origin, direction;
    for (int k = 0; k < 3; ++k) {
      origin[k] = static_cast<float>(rng.Uniform(-14, 14));
      direction[k] = static_cast<float>(rng.Uniform(-1, 1));
    }
    const auto one = a->Intersect(origin, direction), other = b->Intersect(origin, direction);
    ASSERT_EQ(one.has_value(), other.has_value()) << i;
    if (!one) continue;
    ++hits;
    EXPECT_EQ(one->surface.instance, other->surface.instance);
    EXPECT_EQ(one->surface.triangle, other->surface.triangle) << i;
    EXPECT_EQ(one->distance, other->distance);
  }
  EXPECT_GT(hits, 400);
}

TEST(DynamicTracer, EarlierInstantsAndTheSceneAsBuiltStayWhatTheyAre) {
  World world = RandomWorld(4);
  const auto base = std::make_shared<const RayTracer>(BuildScene(world));
  const RayTracer untouched(BuildScene(world));
  DynamicTracer dynamic(base);
  RngStream rng(4, "moves");
  SceneState first;
  first.moved = {{3, RandomPlace(rng), false}, {18, RandomPlace(rng), false}};
  const auto at_first = dynamic.At(std::make_shared<const SceneState>(first));
  SceneState second;
  second.moved = {{5, RandomPlace(rng), false}, {24, RandomPlace(rng), true}};
  second.deformed = {{0, std::make_shared<const std::vector<Vec3f>>(Bent(world.meshes[0], 1))}};
  const auto at_second = dynamic.At(std::make_shared<const SceneState>(second));

  ExpectSame(*base, untouched, 4);
  EXPECT_EQ(dynamic.At(nullptr), base);
  for (const MovedInstance& m : first.moved) world.instances[m.instance].X_WM = m.X_WM;
  const RayTracer built(BuildScene(world));
  ExpectSame(*at_first, built, 5);
}

TEST(DynamicTracer, AnyNumberOfThingsMayStartToMoveOneAfterAnother) {
  World world = RandomWorld(5);
  DynamicTracer dynamic(std::make_shared<const RayTracer>(BuildScene(world)));
  RngStream rng(5, "moves");
  SceneState state;
  for (uint32_t i = 0; i < 45; ++i) {
    state.moved.push_back({i, RandomPlace(rng), false});
    world.instances[i].X_WM = state.moved.back().X_WM;
    const auto moved = dynamic.At(std::make_shared<const SceneState>(state));
    if (i % 11 == 0) ExpectSame(*moved, RayTracer(BuildScene(world)), i, 300);
  }
}

TEST(DynamicTracer, SixteenRaysAgreeWithSingleOnes) {
  const World world = RandomWorld(6);
  DynamicTracer dynamic(std::make_shared<const RayTracer>(BuildScene(world)));
  RngStream rng(6, "moves");
  SceneState state;
  for (uint32_t i : {1u, 12u, 40u}) state.moved.push_back({i, RandomPlace(rng), false});
  const auto tracer = dynamic.At(std::make_shared<const SceneState>(state));
  for (int round = 0; round < 100; ++round) {
    RayHit16 rays;
    std::memset(&rays, 0, sizeof(rays));
    alignas(64) int valid[16];
    for (int i = 0; i < 16; ++i) {
      valid[i] = -1;
      rays.origin_x[i] = 13;
      rays.mask[i] = kMaskAll;
      rays.direction_x[i] = static_cast<float>(rng.Uniform(-1, -0.2));
      rays.direction_y[i] = static_cast<float>(rng.Uniform(-1, 1));
      rays.direction_z[i] = static_cast<float>(rng.Uniform(-1, 1));
      rays.t_far[i] = std::numeric_limits<float>::infinity();
    }
    RayHit16 shadow = rays;
    const FlushDenormals flush;
    tracer->Intersect16(valid, rays, true);
    bool occluded[16] = {};
    tracer->Occluded16(valid, shadow, occluded, true);
    for (int i = 0; i < 16; ++i) {
      const auto single = tracer->Intersect({13, 0, 0}, {rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]});
      ASSERT_EQ(single.has_value(), rays.geometry[i] != kMiss);
      EXPECT_EQ(single.has_value(), occluded[i]);
      if (!single) continue;
      EXPECT_NEAR(single->distance, rays.t_far[i], 1e-5f * single->distance);
      const SurfaceRef surface = tracer->Resolve(rays.geometry[i], rays.instance[i], rays.primitive[i]);
      EXPECT_EQ(surface.instance, single->surface.instance);
      EXPECT_EQ(surface.triangle, single->surface.triangle);
    }
  }
}

TEST(DynamicTracer, StatesThatDoNotFitTheSceneAreInputErrors) {
  const World world = RandomWorld(7);
  DynamicTracer dynamic(std::make_shared<const RayTracer>(BuildScene(world)));
  const auto refuse = [&](SceneState state) { EXPECT_THROW(dynamic.At(std::make_shared<const SceneState>(std::move(state))), InputError); };
  const auto positions = [](size_t n, float x) { return std::make_shared<const std::vector<Vec3f>>(n, Vec3f{x, 0, 0}); };
  refuse({0, {{kInstances, {}, false}}, {}});
  refuse({0, {{5, {}, false}, {4, {}, false}}, {}});
  refuse({0, {{5, {}, false}, {5, {}, false}}, {}});
  refuse({0, {{5, {Mat3f(), {std::nanf(""), 0, 0}}, false}}, {}});
  refuse({0, {}, {{10, positions(world.meshes[0].positions.size(), 0)}}});
  refuse({0, {}, {{1, positions(3, 0)}}});
  refuse({0, {}, {{1, nullptr}}});
  refuse({0, {}, {{1, positions(world.meshes[1].positions.size(), INFINITY)}}});
}

}  // namespace
}  // namespace airsim360

// Rays that no scene can answer: Embree ends the process on them, so nothing of them may reach it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {
namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
// Of every size that a float can have, with both signs in use.
constexpr float kHostile[] = {1.1e12f, 1e15f,   1e17f,  1.8e18f,  2e18f,    9.3e18f,   1e20f, 1e30f,
                              1e38f,   3.4e38f, -1e38f, -3.4e38f, kEndless, -kEndless, kNan};

AffineTransform Scaled(float factor, Vec3f p) {
  AffineTransform X;
  X.A = Mat3f{{{{factor, 0, 0}, {0, factor, 0}, {0, 0, factor}}}};
  X.p = p;
  return X;
}

std::shared_ptr<const Scene> Pyramids(const std::vector<AffineTransform>& places) {
  Mesh mesh{"pyramid", {{-1, -1, -1}, {1, -1, -1}, {0, 1, -1}, {0, 0, 1}}, {}, {}, {}, {}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  SceneBuilder builder("test");
  const EntityId entity = builder.AddEntity("thing", builder.tree().At("construction/building"));
  const MeshId id = builder.AddMesh(mesh);
  for (const AffineTransform& X : places) builder.AddInstance({id, X, entity});
  return builder.Build();
}

// Sixteen rays down onto the first pyramid.
RayHit16 Down() {
  RayHit16 rays;
  std::memset(&rays, 0, sizeof rays);
  for (int i = 0; i < 16; ++i) {
    rays.origin_x[i] = 0.01f * static_cast<float>(i);
    rays.origin_z[i] = 5;
    rays.direction_z[i] = -1;
    rays.t_far[i] = kEndless;
    rays.mask[i] = kMaskAll;
  }
  return rays;
}

struct alignas(64) HostileLanes {
  int active[16];
};

using Field = float (RayHit16::*)[16];
constexpr Field kFields[] = {&RayHit16::origin_x,    &RayHit16::origin_y,    &RayHit16::origin_z,
                             &RayHit16::direction_x, &RayHit16::direction_y, &RayHit16::direction_z};

// A number of the rays, made hostile in lanes 3 and 9: the others meet the pyramid as ever.
void CheckPackets(const RayTracer& tracer, Field field, float value, bool is_hit) {
  HostileLanes valid;
  std::fill(std::begin(valid.active), std::end(valid.active), -1);
  for (const bool coherent : {false, true}) {
    RayHit16 rays = Down();
    (rays.*field)[3] = (rays.*field)[9] = value;
    RayHit16 shadow = rays, panes = rays;
    bool occluded[16];
    tracer.Intersect16(valid.active, rays, coherent);
    tracer.Occluded16(valid.active, shadow, occluded, coherent);
    tracer.IntersectClearPanes16(valid.active, panes);
    for (int i = 0; i < 16; ++i) {
      const bool expected = is_hit || (i != 3 && i != 9);
      EXPECT_EQ(rays.geometry[i] != kMiss, expected) << i << " " << value;
      EXPECT_EQ(occluded[i], expected) << i << " " << value;
      EXPECT_EQ(panes.geometry[i], kMiss);
    }
  }
}

void CheckAll(const RayTracer& tracer) {
  for (const float value : kHostile) {
    for (const Field field : kFields) CheckPackets(tracer, field, value, false);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3f place{0, 0, 5}, way{0, 0, -1};
      place[axis] = way[axis] = value;
      EXPECT_FALSE(tracer.Intersect(place, {0, 0, -1})) << value;
      EXPECT_FALSE(tracer.Intersect({0, 0, 5}, way)) << value;
      EXPECT_FALSE(tracer.Occluded(place, {0, 0, -5})) << value;
      EXPECT_FALSE(tracer.Occluded({0, 0, 5}, place)) << value;
      EXPECT_EQ(tracer.Clearance(place, 10), 10) << value;
      EXPECT_FALSE(tracer.Nearest(place, kEndless)) << value;
    }
  }
  EXPECT_FALSE(tracer.Intersect({0, 0, 5}, {0, 0, -1}, kNan));
  CheckPackets(tracer, &RayHit16::t_far, kNan, false);
  CheckPackets(tracer, &RayHit16::t_near, kNan, false);
  CheckPackets(tracer, &RayHit16::t_near, -1, false);
  CheckPackets(tracer, &RayHit16::t_near, 0.5f, true);
  CheckPackets(tracer, &RayHit16::t_far, 3e38f, true);
  // The limit itself is no wall: far rays are answered.
  EXPECT_TRUE(tracer.Intersect({0, 0, 2e7f}, {0, 0, -1}));
  EXPECT_TRUE(tracer.Occluded({0, 0, 2e7f}, {0, 0, -2e7f}));
  EXPECT_NEAR(tracer.Clearance({0, 0, 2e7f}, kEndless), 2e7f, 4);
}

TEST(HostileRays, MissASceneOfBakedMeshes) { CheckAll(RayTracer(Pyramids({AffineTransform()}))); }

TEST(HostileRays, MissASceneOfInstances) {
  CheckAll(RayTracer(Pyramids({AffineTransform(), Scaled(2, {50, 0, 0}), Scaled(1e-4f, {0, 40, 0})})));
}

TEST(HostileRays, MissWhatHasMoved) {
  const auto base = std::make_shared<const RayTracer>(Pyramids({AffineTransform(), Scaled(1, {50, 0, 0})}));
  DynamicTracer dynamic(base);
  auto state = std::make_shared<SceneState>();
  state->moved = {{1, Scaled(1e4f, {1e7f, 0, 0}), false}};
  CheckAll(*dynamic.At(state));
}

TEST(HostileRays, InstancesWithoutExtentAreNotMetAndEndNothing) {
  for (const float factor : {0.0f, 1e-38f, 1e-30f, 1e-15f}) {
    const RayTracer tracer(Pyramids({AffineTransform(), Scaled(factor, {3, 0, 0}), Scaled(factor, {0, 0, 3})}));
    CheckAll(tracer);
    for (int i = 0; i < 100; ++i) {
      const float x = 0.05f * static_cast<float>(i);
      tracer.Intersect({x, 0, 8}, {0, 0, -1});
      tracer.Occluded({x, 0, 8}, {3, 0, 0});
    }
  }
}

}  // namespace
}  // namespace airsim360

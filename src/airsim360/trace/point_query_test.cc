// Distances to the nearest triangle, against all triangles one by one.
#include "airsim360/trace/point_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "airsim360/base/random.h"
#include "airsim360/trace/closest_point.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {
namespace {

float Uniform(RngStream& rng, double low, double high) { return static_cast<float>(rng.Uniform(low, high)); }

// A crumpled strip: triangles of very different size and shape.
Mesh Strip(RngStream& rng, int triangles) {
  Mesh mesh{"strip", {}, {}, {}, {}, {}};
  for (int i = 0; i < triangles + 2; ++i)
    mesh.positions.push_back({Uniform(rng, -2, 2), Uniform(rng, -1, 1), 0.1f * static_cast<float>(i)});
  for (uint32_t i = 0; i < static_cast<uint32_t>(triangles); ++i) mesh.triangles.push_back({i, i + 1, i + 2});
  return mesh;
}

Mat3f Turn(RngStream& rng) {
  const Mat3d R = RotationZ(rng.Uniform(0, 6)) * RotationX(rng.Uniform(0, 6)) * RotationZ(rng.Uniform(0, 6));
  return Mat3f::FromColumns(VecCast<float>(R.column(0)), VecCast<float>(R.column(1)), VecCast<float>(R.column(2)));
}

// Turned, then scaled along the axes by `scale`, sign included.
AffineTransform Placed(RngStream& rng, Vec3f scale) {
  AffineTransform X;
  X.A = Turn(rng) * Mat3f::FromColumns({scale.x, 0, 0}, {0, scale.y, 0}, {0, 0, scale.z});
  X.p = {Uniform(rng, -20, 20), Uniform(rng, -20, 20), Uniform(rng, -20, 20)};
  return X;
}

Vec3f ScaleOfKind(RngStream& rng, const std::string& kind) {
  const float s = std::exp(Uniform(rng, -2.5, 2.5));
  if (kind == "uniform") return {s, s, s};
  if (kind == "mirrored") return {-s, s, s};
  if (kind == "flat") return {s, s, 0};
  return {s, s * Uniform(rng, 0.1, 3), s * Uniform(rng, 0.1, 3)};
}

float BruteForce(const Scene& scene, Vec3f p, float farthest) {
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (const Vec3u t : mesh.triangles) {
      const AffineTransform& X = instance.X_WM;
      farthest = std::min(farthest, Norm(p - internal::ClosestPointOnTriangle(p, X * mesh.positions[t.x], X * mesh.positions[t.y],
                                                                              X * mesh.positions[t.z])));
    }
  }
  return farthest;
}

class PointQuery : public testing::TestWithParam<const char*> {};

TEST_P(PointQuery, IsTheLeastDistanceOverAllTrianglesWhateverTheInstancesAreScaledBy) {
  RngStream rng(1, GetParam());
  SceneBuilder builder("test");
  const EntityId entity = builder.AddEntity("thing", builder.tree().At("construction/building"));
  const MeshId shared = builder.AddMesh(Strip(rng, 60));
  for (int i = 0; i < 30; ++i) builder.AddInstance({shared, Placed(rng, ScaleOfKind(rng, GetParam())), entity});
  for (int i = 0; i < 5; ++i)  // used once each: baked
    builder.AddInstance({builder.AddMesh(Strip(rng, 20)), Placed(rng, ScaleOfKind(rng, GetParam())), entity});
  const auto scene = builder.Build();
  const RayTracer tracer(scene);
  for (int i = 0; i < 1500; ++i) {
    const Vec3f p{Uniform(rng, -35, 35), Uniform(rng, -35, 35), Uniform(rng, -35, 35)};
    const float farthest = i % 3 ? 100 : Uniform(rng, 0.5, 5);
    const float distance = tracer.Clearance(p, farthest);
    EXPECT_NEAR(distance, BruteForce(*scene, p, farthest), 2e-5f) << i;

    // The nearest point lies so far away, on the triangle that is named.
    const auto nearest = tracer.Nearest(p, farthest);
    ASSERT_EQ(nearest.has_value(), distance < farthest) << i;
    if (!nearest) continue;
    EXPECT_EQ(nearest->distance, distance);
    EXPECT_NEAR(Norm(nearest->offset), distance, 1e-6f * distance);
    const Instance& instance = scene->instances[nearest->surface.instance];
    const Mesh& mesh = scene->meshes[instance.mesh];
    const Vec3u t = mesh.triangles[nearest->surface.triangle];
    const Vec3f a = instance.X_WM * mesh.positions[t.x], b = instance.X_WM * mesh.positions[t.y], c = instance.X_WM * mesh.positions[t.z];
    EXPECT_LT(Norm(internal::ClosestPointOnTriangle(p, a, b, c) - (p + nearest->offset)), 2e-3f) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, PointQuery, testing::Values("uniform", "mirrored", "uneven", "flat"));

TEST(PointQueryBounds, StayCloseFarFromTheOrigin) {
  // Half a kilometre out coordinates have steps of 3e-5 m; the distance must not be worse than a few of them.
  RngStream rng(2, "far");
  SceneBuilder builder("test");
  const EntityId entity = builder.AddEntity("thing", builder.tree().At("construction/building"));
  const MeshId shared = builder.AddMesh(Strip(rng, 40));
  for (int i = 0; i < 6; ++i) {
    AffineTransform X = Placed(rng, {0.3f, 0.3f, 0.3f});
    X.p += {500, -400, 20};
    builder.AddInstance({shared, X, entity});
  }
  const auto scene = builder.Build();
  const RayTracer tracer(scene);
  for (int i = 0; i < 500; ++i) {
    const Vec3f p{500 + Uniform(rng, -30, 30), -400 + Uniform(rng, -30, 30), 20 + Uniform(rng, -30, 30)};
    EXPECT_NEAR(tracer.Clearance(p, 100), BruteForce(*scene, p, 100), 2e-4f);
  }
}

TEST(PointQueryBounds, NothingNearerThanTheLimitGivesTheLimit) {
  const RayTracer empty(SceneBuilder("empty").Build());
  EXPECT_EQ(empty.Clearance({1, 2, 3}, 7), 7);
  EXPECT_EQ(empty.Clearance({1, 2, 3}, 0), 0);
}

}  // namespace
}  // namespace airsim360

// Distances to the surfaces of a whole town against its triangles one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {
namespace {

// Distance to a triangle by minimising over its two edges' coordinates: bary-centric clamping in double
// precision (Ericson, Real-Time Collision Detection 5.1.5), other than what the ray tracer does.
double DistanceToTriangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = Dot(ab, ap), d2 = Dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return Norm(ap);
  const Vec3d bp = p - b;
  const double d3 = Dot(ab, bp), d4 = Dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return Norm(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return Norm(ap - ab * (d1 / (d1 - d3)));
  const Vec3d cp = p - c;
  const double d5 = Dot(ab, cp), d6 = Dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return Norm(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return Norm(ap - ac * (d2 / (d2 - d6)));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return Norm(bp - (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
  const double scale = 1 / (va + vb + vc);
  return Norm(ap - ab * (vb * scale) - ac * (vc * scale));
}

// Over all triangles of instances whose box is nearer than what was found.
double BruteForce(const Scene& scene, const std::vector<Box3f>& bounds, Vec3d p, double farthest) {
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const Vec3d out = Max(Max(VecCast<double>(bounds[i].min) - p, p - VecCast<double>(bounds[i].max)), Vec3d{});
    if (Norm(out) >= farthest) continue;
    const AffineTransform& X = scene.instances[i].X_WM;
    const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
    for (const Vec3u t : mesh.triangles) {
      farthest = std::min(farthest, DistanceToTriangle(p, VecCast<double>(X * mesh.positions[t.x]),
                                                       VecCast<double>(X * mesh.positions[t.y]), VecCast<double>(X * mesh.positions[t.z])));
    }
  }
  return farthest;
}

TEST(ClearanceOfATown, IsTheLeastDistanceOverAllItsTriangles) {
  const auto scene = LoadWorld({.world = "downtown_west"});
  const RayTracer tracer(scene);
  std::vector<Box3f> bounds(scene->instances.size());
  for (size_t i = 0; i < bounds.size(); ++i) {
    const Box3f box = scene->meshes[scene->instances[i].mesh].Bounds();
    for (int k = 0; k < 8; ++k) {
      bounds[i].Add(scene->instances[i].X_WM *
                    Vec3f{k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y, k & 4 ? box.max.z : box.min.z});
    }
  }
  RngStream rng(1, "clearance");
  for (int i = 0; i < 150; ++i) {
    // Among trees, cars and furniture, and above.
    const Vec3d p =
        VecCast<double>(VecCast<float>(Vec3d{rng.Uniform(-100, 100), rng.Uniform(-100, 100), rng.Uniform(0.3, i % 2 ? 6 : 40)}));
    EXPECT_NEAR(tracer.Clearance(VecCast<float>(p), 30), BruteForce(*scene, bounds, p, 30), 5e-5) << i;
  }
}

}  // namespace
}  // namespace airsim360

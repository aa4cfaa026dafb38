#include "airsim360/planning/routes/area_routes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

double DistanceToLeg(Vec3d p, Vec3d a, Vec3d b) {
  const Vec3d d = b - a;
  const double s = std::clamp(Dot(p - a, d) / std::max(Dot(d, d), 1e-30), 0.0, 1.0);
  return Norm(p - (a + d * s));
}

TEST(Coverage, NoPointOfTheAreaIsFartherFromALaneThanHalfTheSpacing) {
  RngStream rng(1, "coverage");
  for (int k = 0; k < 20; ++k) {
    CoverageArea area;
    area.min = {rng.Uniform(-50, 0), rng.Uniform(-50, 0)};
    area.max = {rng.Uniform(1, 60), rng.Uniform(1, 60)};
    area.height = 12;
    area.spacing = rng.Uniform(1, 12);
    area.heading = k % 4 == 0 ? 0 : rng.Uniform(0, 3);
    const std::vector<Vec3d> route = CoverageRoute(area);
    ASSERT_GE(route.size(), 2u);
    // Corners between slanted lanes are reached by the longer of two neighbours, or nearly.
    const double slack = area.heading == 0 ? 1e-9 : 0.5 * area.spacing;
    for (int i = 0; i < 200; ++i) {
      const Vec3d p{rng.Uniform(area.min.x, area.max.x), rng.Uniform(area.min.y, area.max.y), 12};
      double nearest = 1e9;
      for (size_t leg = 0; leg + 1 < route.size(); ++leg) nearest = std::min(nearest, DistanceToLeg(p, route[leg], route[leg + 1]));
      EXPECT_LE(nearest, area.spacing / 2 + slack);
    }
  }
}

TEST(Coverage, RefusesAreasWithoutSizeAndEndlessWork) {
  EXPECT_THROW(CoverageRoute({.min = {0, 0}, .max = {0, 5}}), InputError);
  EXPECT_THROW(CoverageRoute({.min = {0, 0}, .max = {5, 5}, .spacing = 0}), InputError);
  EXPECT_THROW(CoverageRoute({.min = {0, 0}, .max = {1e6, 1e6}, .spacing = 1}), InputError);
}

TEST(Orbit, StaysAtItsRadiusAndTurnsAsFarAsItShould) {
  const Orbit orbit{.center = {3, -2, 10}, .radius = 7, .turns = -1.5, .climb = 4, .start = 0.3};
  const std::vector<Vec3d> route = OrbitRoute(orbit);
  double turned = 0;
  for (size_t i = 0; i < route.size(); ++i) {
    const Vec3d d = route[i] - orbit.center;
    EXPECT_NEAR(std::hypot(d.x, d.y), 7, 1e-12);
    if (i == 0) continue;
    const Vec3d e = route[i - 1] - orbit.center;
    turned += std::atan2(e.x * d.y - e.y * d.x, e.x * d.x + e.y * d.y);
  }
  EXPECT_NEAR(turned, -3 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(route.back().z - route.front().z, 4, 1e-12);
  EXPECT_THROW(OrbitRoute({.center = {}, .radius = 0}), InputError);
  EXPECT_THROW(OrbitRoute({.center = {}, .turns = 0}), InputError);
}

}  // namespace
}  // namespace airsim360

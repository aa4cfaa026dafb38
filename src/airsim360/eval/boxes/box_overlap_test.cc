#include "airsim360/eval/boxes/box_overlap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "airsim360/base/random.h"
#include "airsim360/math/triangulate.h"

namespace airsim360 {
namespace {

TEST(UprightBoxes, SquaresTurnedByAnEighthShareAnOctagon) {
  const UprightBox a{{1, 2, 3}, 2, 2, 4, 0.3}, b{{1, 2, 3}, 2, 2, 4, 0.3 + std::numbers::pi / 4};
  const double octagon = 8 * (std::sqrt(2.0) - 1);
  EXPECT_NEAR(FootprintOverlap(a, b), octagon / (8 - octagon), 1e-12);
  EXPECT_NEAR(VolumeOverlap(a, b), octagon / (8 - octagon), 1e-12);
  EXPECT_EQ(VolumeOverlap(a, {{1, 2, 9}, 2, 2, 4, 0}), 0);
}

TEST(WrappedBoxes, MeetRoundTheSeam) {
  EXPECT_NEAR(WrappedBoxOverlap({90, 0, 20, 10}, {-10, 0, 20, 10}, false, 100), 1, 1e-12);
  EXPECT_NEAR(WrappedBoxOverlap({95, 0, 20, 10}, {0, 0, 20, 10}, false, 100), 15.0 / 25, 1e-12);
  EXPECT_NEAR(WrappedBoxOverlap({50, 0, 10, 10}, {0, 0, 100, 10}, true, 100), 1, 1e-12);
  // Both ends of a wide box meet a box on the far side.
  EXPECT_NEAR(WrappedBoxOverlap({10, 0, 85, 10}, {90, 0, 25, 10}, false, 100), 10.0 / 100, 1e-12);
}

TEST(Polygons, SharedAreaEqualsCounting) {
  const std::vector<Vec2d> ell = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}}, slanted = {{0.5, -1}, {3, 2}, {0.5, 2.5}};
  RngStream random(4, "polygons");
  int both = 0;
  constexpr int kPoints = 400000;
  for (int i = 0; i < kPoints; ++i) {
    const Vec2d p{random.Uniform(0, 4), random.Uniform(0, 3)};
    both += InPolygon(ell, p) && InPolygon(slanted, p);
  }
  EXPECT_NEAR(SharedPolygonArea(ell, slanted), 12.0 * both / kPoints, 0.02);
  EXPECT_NEAR(SharedPolygonArea(ell, ell), 6, 1e-12);
}

}  // namespace
}  // namespace airsim360

// Overlap of boxes on the sphere against closed forms and counting.
#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/eval/spherical_iou.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/transform.h"

namespace airsim360 {
namespace {

bool Inside(const SphericalBox& box, Vec3d d) {
  // The camera that looks at the box: turn the direction back instead.
  const Mat3d R = RotationZ(box.gamma) * RotationX(-box.lat) * RotationY(-box.lon);
  const Vec3d q = R * d;
  return q.z > 0 && std::abs(q.x) <= q.z * std::tan(box.width / 2) && std::abs(q.y) <= q.z * std::tan(box.height / 2);
}

TEST(SphericalIou, AreasAreThoseOfThePaperAndOfACubeFace) {
  const SphericalBox face{.width = kPi / 2, .height = kPi / 2};
  EXPECT_NEAR(SphericalBoxArea(face), 4 * kPi / 6, 1e-12);
  const SphericalBox box{.lon = 1, .lat = 0.3, .width = 0.7, .height = 0.4};
  EXPECT_NEAR(SphericalBoxArea(box), 4 * std::acos(-std::sin(0.35) * std::sin(0.2)) - 2 * kPi, 1e-12);
  EXPECT_NEAR(SphericalIntersection(box, box), SphericalBoxArea(box), 1e-12);
  EXPECT_NEAR(SphericalIou(box, box), 1, 1e-12);
}

TEST(SphericalIou, NestedBoxesAreTheRatioOfTheirAreasAndFarOnesAreZero) {
  const SphericalBox large{.lon = -2, .lat = -0.9, .width = 1.2, .height = 0.9, .gamma = 0.3};
  SphericalBox small = large;
  small.width = 0.5, small.height = 0.2;
  EXPECT_NEAR(SphericalIou(large, small), SphericalBoxArea(small) / SphericalBoxArea(large), 1e-12);
  EXPECT_EQ(SphericalIou({.lon = 0, .width = 0.5, .height = 0.5}, {.lon = 2, .width = 0.5, .height = 0.5}), 0);
}

TEST(SphericalIou, DoesNotDependOnWhereTheSeamIs) {
  // The same pair, turned about the vertical axis.
  const SphericalBox a{.lat = 0.5, .width = 0.6, .height = 0.3}, b{.lon = 0.2, .lat = 0.45, .width = 0.5, .height = 0.4};
  const double expected = SphericalIou(a, b);
  for (const double turn : {1.0, 3.0, kPi, -2.5}) {
    SphericalBox c = a, d = b;
    c.lon += turn, d.lon += turn;
    EXPECT_NEAR(SphericalIou(c, d), expected, 1e-12);
  }
  EXPECT_NEAR(SphericalIou(b, a), expected, 1e-12);
}

TEST(SphericalIou, AgreesWithCountingDirections) {
  RngStream rng(7, "boxes");
  for (int trial = 0; trial < 6; ++trial) {
    SphericalBox boxes[2];
    for (SphericalBox& box : boxes) {
      box = {.lon = rng.Uniform(-0.4, 0.4),
             .lat = trial % 2 == 0 ? 1.3 : 0.1,
             .width = rng.Uniform(0.5, 1.5),
             .height = rng.Uniform(0.4, 1.5),
             .gamma = rng.Uniform(-1, 1)};
    }
    int both = 0, either = 0;
    for (int i = 0; i < 400000; ++i) {
      const double z = rng.Uniform(-1, 1), angle = rng.Uniform(0, 2 * kPi), r = std::sqrt(1 - z * z);
      const Vec3d d{r * std::cos(angle), r * std::sin(angle), z};
      const bool in_a = Inside(boxes[0], d), in_b = Inside(boxes[1], d);
      both += in_a && in_b;
      either += in_a || in_b;
    }
    ASSERT_GT(either, 1000);
    EXPECT_NEAR(SphericalIou(boxes[0], boxes[1]), static_cast<double>(both) / either, 0.012) << trial;
  }
}

TEST(SphericalIou, BoxesThatAreNoneAreRefused) {
  EXPECT_THROW(SphericalIou({.width = 0, .height = 1}, {.width = 1, .height = 1}), InputError);
  EXPECT_THROW(SphericalIou({.width = 1, .height = 4}, {.width = 1, .height = 1}), InputError);
  EXPECT_THROW(SphericalIou({.lon = NAN, .width = 1, .height = 1}, {.width = 1, .height = 1}), InputError);
}

}  // namespace
}  // namespace airsim360

// A low sun among clouds, against the closed form of a slab; what whole skies then give is in clouds_test.cc.
#include "airsim360/render/sky/field_shade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "airsim360/math/angles.h"
#include "airsim360/render/sky/cloud_geometry.h"
#include "airsim360/render/sky/cloud_shapes.h"

namespace airsim360::internal {
namespace {

Vec3f SunAt(double elevation_deg) {
  return {static_cast<float>(std::cos(elevation_deg * kDegree)), 0, static_cast<float>(std::sin(elevation_deg * kDegree))};
}

// Cloud everywhere between 1 and 2 km, of one density but for its outermost metres.
CloudLayer Slab(float extinction) {
  CloudLayer::Form form;
  form.base = 1000, form.extinction = extinction, form.edge = 0.01f;
  form.erosion = form.least_erosion = form.base_erosion = 0;
  return CloudLayer(form, std::vector<CloudLayer::Column>(CloudLayer::kCells * CloudLayer::kCells, {1000, 0}));
}

TEST(FieldShade, OfASlabIsTheLawOfBeer) {
  constexpr float kExtinction = 1e-4f, kFirst = 1700;
  const CloudLayer slab = Slab(kExtinction);
  for (const double elevation : {2.0, 5.0, 12.0}) {
    const FieldShade shade(slab, SunAt(elevation), kFirst);
    for (const double altitude : {1125.0, 1500.0}) {
      // Where z t + c t^2 is the height that is left.
      const double z = std::sin(elevation * kDegree), c = 0.5 * (1 - z * z) / kEarthRadius;
      const double way = (std::sqrt(z * z + 4 * c * (2000 - altitude)) - z) / (2 * c);
      const double expected = std::exp(-0.5 * kExtinction * std::max(0.0, way - kFirst));
      EXPECT_NEAR(shade.At(static_cast<float>(altitude)), expected, 0.02 * expected) << elevation << " " << altitude;
    }
  }
}

TEST(FieldShade, NothingShadesWhatTheSunReachesWithinTheFirstMetres) {
  const FieldShade shade(Slab(0.05f), SunAt(40), 1700);  // 1,000 m at 40 degrees are 1,556 m
  for (const float altitude : {500.0f, 1000.0f, 1300.0f, 2000.0f, 9000.0f}) EXPECT_EQ(shade.At(altitude), 1) << altitude;
}

TEST(FieldShade, TheHigherTheSunOrThePointTheLessItIsShaded) {
  const CloudLayer field = CumulusLayer({1000, 1500, 1}, 0.4f, {1, 0}, 7);
  float before = 0;
  for (const double elevation : {1.0, 3.0, 8.0, 20.0}) {
    const FieldShade shade(field, SunAt(elevation), 1700);
    const float share = shade.At(1200);
    EXPECT_GT(share, before) << elevation;
    EXPECT_GE(shade.At(field.highest()), share) << elevation;
    before = share;
  }
  EXPECT_LT(FieldShade(field, SunAt(1), 1700).At(1200), 0.2f);
}

}  // namespace
}  // namespace airsim360::internal

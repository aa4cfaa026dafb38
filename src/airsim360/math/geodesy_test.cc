#include "airsim360/math/geodesy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

TEST(Geodesy, AxesOfTheEllipsoidAreWhereTheyAreDefined) {
  const double b = kWgs84Axis * (1 - kWgs84Flattening);
  EXPECT_LT(Norm(EcefFromGeodetic({0, 0, 0}) - Vec3d{kWgs84Axis, 0, 0}), 1e-9);
  EXPECT_LT(Norm(EcefFromGeodetic({0, 90, 10}) - Vec3d{0, kWgs84Axis + 10, 0}), 1e-8);
  EXPECT_LT(Norm(EcefFromGeodetic({90, 0, 0}) - Vec3d{0, 0, b}), 1e-9);
  EXPECT_NEAR(b, 6356752.3142, 5e-5);  // NIMA TR8350.2, table 3.3
}

TEST(Geodesy, InverseGivesBackPlacesFromTheSeaFloorToOrbit) {
  RngStream random(1, "geodesy");
  for (int i = 0; i < 20000; ++i) {
    const GeoPoint in{random.Uniform(-90, 90), random.Uniform(-180, 180), random.Uniform(-1e4, 1e6)};
    const GeoPoint out = GeodeticFromEcef(EcefFromGeodetic(in));
    ASSERT_NEAR(out.latitude_deg, in.latitude_deg, 1e-13 * 180);
    ASSERT_NEAR(out.longitude_deg, in.longitude_deg, 1e-12);
    ASSERT_NEAR(out.altitude, in.altitude, 1e-8);
  }
}

TEST(Geodesy, InverseHoldsOnTheAxisAndTheEquator) {
  for (double latitude : {-90.0, 0.0, 90.0}) {
    const GeoPoint out = GeodeticFromEcef(EcefFromGeodetic({latitude, 0, 123}));
    EXPECT_NEAR(out.latitude_deg, latitude, 1e-12);
    EXPECT_NEAR(out.altitude, 123, 1e-8);
  }
}

TEST(GeoFrame, WorldAxesPointEastNorthAndUp) {
  const GeoFrame frame({47.641468, -122.140165, 122});
  const GeoPoint east = frame.ToGeodetic({100, 0, 0}), north = frame.ToGeodetic({0, 100, 0}), up = frame.ToGeodetic({0, 0, 100});
  EXPECT_GT(east.longitude_deg, frame.origin().longitude_deg);
  EXPECT_NEAR(east.latitude_deg, frame.origin().latitude_deg, 1e-7);
  EXPECT_GT(north.latitude_deg, frame.origin().latitude_deg);
  EXPECT_NEAR(north.longitude_deg, frame.origin().longitude_deg, 1e-12);
  EXPECT_NEAR(up.altitude, 222, 1e-8);
  // The plane leaves the curved Earth: d^2 / 2 R, R between the radii of curvature.
  const double rise = frame.ToGeodetic({1000, 0, 0}).altitude - 122;
  EXPECT_GT(rise, 1e6 / (2 * 6.40e6));
  EXPECT_LT(rise, 1e6 / (2 * 6.33e6));
}

TEST(GeoFrame, ToWorldIsTheInverseOfToGeodetic) {
  const GeoFrame frame({-33.86, 151.2, 10});
  RngStream random(2, "geodesy");
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p{random.Uniform(-1e4, 1e4), random.Uniform(-1e4, 1e4), random.Uniform(-100, 3000)};
    ASSERT_LT(Norm(frame.ToWorld(frame.ToGeodetic(p)) - p), 1e-7);
  }
}

}  // namespace
}  // namespace airsim360

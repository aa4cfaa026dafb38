#include "airsim360/math/standard_atmosphere.h"

#include <gtest/gtest.h>

namespace airsim360 {
namespace {

TEST(StandardAir, AgreesWithTheTablesOfTheStandard) {
  // ISO 2533, table 5: sea level, 1000 m, 5000 m, 11000 m (geopotential).
  EXPECT_NEAR(StandardAir(0).pressure, 101325, 1e-9);
  EXPECT_NEAR(StandardAir(0).density, 1.225, 1e-5);
  EXPECT_NEAR(StandardAir(1000).pressure, 89874.6, 0.5);
  EXPECT_NEAR(StandardAir(5000).pressure, 54019.9, 0.5);
  EXPECT_NEAR(StandardAir(5000).density, 0.736116, 1e-5);
  EXPECT_NEAR(StandardAir(11000).temperature, 216.65, 1e-9);
  EXPECT_NEAR(StandardAir(11000).pressure, 22632.0, 0.5);
}

TEST(StandardAir, PressureAltitudeIsTheInverse) {
  for (double height : {-500.0, 0.0, 122.0, 3000.0, 10000.0}) {
    EXPECT_NEAR(PressureAltitude(StandardAir(height).pressure), height, 1e-8);
    EXPECT_NEAR(PressureAltitude(StandardAir(height, 99000).pressure, 99000), height, 1e-8);
  }
}

TEST(StandardAir, PressureFallsByTheWeightOfTheAir) {
  // Hydrostatics: dp/dh = -rho g, by central differences.
  for (double height : {0.0, 500.0, 4000.0}) {
    const double slope = (StandardAir(height + 1).pressure - StandardAir(height - 1).pressure) / 2;
    EXPECT_NEAR(slope, -StandardAir(height).density * 9.80665, 1e-5);
  }
}

}  // namespace
}  // namespace airsim360

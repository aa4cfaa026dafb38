#include "airsim360/rpc/wire/limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

namespace airsim360 {
namespace {

std::string ErrorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Limits, APlaceThatIsNotOnTheEarthIsToldWithItsRangeAndTheNearestThatIs) {
  EXPECT_EQ(ErrorOf([] { CheckPlaceOnEarth(90, -360); }), "");
  EXPECT_EQ(ErrorOf([] { CheckPlaceOnEarth(-90.5, 0); }), "latitude: -90.5 is not in -90 … 90 degrees; the nearest is -90");
  EXPECT_EQ(ErrorOf([] { CheckPlaceOnEarth(0, 361); }), "longitude: 361 is not in -360 … 360 degrees; the nearest is 360");
  EXPECT_EQ(ErrorOf([] { CheckPlaceOnEarth(NAN, 0); }), "latitude: nan is not in -90 … 90 degrees");
}

TEST(Limits, AVelocityThatIsTooFastIsToldWithTheNearestOfItsDirection) {
  EXPECT_EQ(ErrorOf([] { CheckVelocity("linear_velocity", {0, 0, 1000}, "m/s"); }), "");
  EXPECT_EQ(ErrorOf([] {
              CheckVelocity("linear_velocity", {3000, -4000, 0}, "m/s");
            }),
            "linear_velocity: (3000, -4000, 0) is 5000 m/s, more than 1000; the nearest is (600, -800, 0)");
}

}  // namespace
}  // namespace airsim360

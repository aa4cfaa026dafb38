#include "airsim360/flight/drones/fleet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/flight/control/flight_check.h"
#include "airsim360/flight/prompt/gate.h"

namespace airsim360 {
namespace {

TEST(Fleet, EveryDroneIsPlausibleAndWithinTheRanges) {
  std::set<size_t> counts;
  double least = 1e9, most = 0;
  for (uint64_t id = 0; id < 500; ++id) {
    const DroneModel model = SampleDrone(1, id);
    EXPECT_TRUE(GateProblems(model).empty());
    const double ratio = MaxThrust(model) / (model.mass * kGravity);
    EXPECT_GE(ratio, 1.5 - 1e-9);
    EXPECT_LE(ratio, 6 + 1e-9);
    least = std::min(least, model.mass);
    most = std::max(most, model.mass);
    counts.insert(model.rotors.size());
  }
  EXPECT_EQ(counts, (std::set<size_t>{4, 6, 8}));
  EXPECT_LT(least, 0.06);
  EXPECT_GT(most, 7);
}

TEST(Fleet, ADroneDependsOnItsSeedAndIdAlone) {
  EXPECT_EQ(SampleDrone(5, 7).mass, SampleDrone(5, 7).mass);
  EXPECT_NE(SampleDrone(5, 7).mass, SampleDrone(5, 8).mass);
  EXPECT_NE(SampleDrone(5, 7).mass, SampleDrone(6, 7).mass);
}

TEST(Fleet, RandomDronesFlyUntuned) {
  for (uint64_t id = 0; id < 24; ++id) {
    const DroneModel model = SampleDrone(11, id);
    const FlightCheck check = CheckFlight(model);
    EXPECT_TRUE(check.passed) << model.name << " rms " << check.tracking.rms << " of " << check.lemniscate.amplitude;
  }
}

TEST(Fleet, RangesThatHoldNoDroneAreRefused) {
  FleetRanges ranges;
  ranges.least_mass = 3;
  ranges.most_mass = 2;
  EXPECT_THROW(SampleDrone(1, 1, ranges), InputError);
}

}  // namespace
}  // namespace airsim360

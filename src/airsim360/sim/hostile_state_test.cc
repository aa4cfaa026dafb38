// States that calls or equations have taken beyond all measure: the next steps bring them back.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "airsim360/sim/test_flights.h"

namespace airsim360 {
namespace {

using internal::HummingbirdAt;
using internal::RoomModel;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void ExpectSane(const SimState& state) {
  const Vehicle& vehicle = state.vehicles[0];
  for (const Vec3d v : {vehicle.motion.X_WB.p, vehicle.motion.v_WB, vehicle.motion.w_WB_B, vehicle.a_WB}) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(std::isfinite(v[i]));
      // What AirSim's clients get are floats.
      EXPECT_TRUE(std::isfinite(static_cast<float>(v[i])));
    }
  }
  EXPECT_LT(Norm(vehicle.motion.X_WB.p), 3000);  // the room and the margin around it
  EXPECT_LE(Norm(vehicle.motion.v_WB), 1e4);
  EXPECT_LE(Norm(vehicle.motion.w_WB_B), 1e4);
  EXPECT_NEAR(std::abs(vehicle.motion.X_WB.R.determinant()), 1, 1e-6);
}

class HostileState : public testing::TestWithParam<double> {};

TEST_P(HostileState, EndsWithTheNextStep) {
  const double value = GetParam();
  const auto model = RoomModel({HummingbirdAt({0, 0, 2})});
  const std::vector<Vec3d DroneState::*> fields = {&DroneState::v_WB, &DroneState::w_WB_B};
  for (const auto field : fields) {
    for (int axis = 0; axis < 3; ++axis) {
      SimState state = StartState(*model);
      (state.vehicles[0].drone.*field)[axis] = value;
      Step(*model, {}, state);
      ExpectSane(state);
      internal::Wait(*model, state, 0.5);
      ExpectSane(state);
    }
  }
  // Winds and places too.
  for (int axis = 0; axis < 3; ++axis) {
    SimState state = StartState(*model);
    state.wind_W[axis] = value;
    internal::Wait(*model, state, 0.2);
    ExpectSane(state);
    state = StartState(*model);
    state.vehicles[0].drone.p_WB[axis] = std::isfinite(value) ? value : 1e7;
    internal::Wait(*model, state, 0.2);
    ExpectSane(state);
  }
}

INSTANTIATE_TEST_SUITE_P(Decades, HostileState,
                         testing::Values(1e3, -1e5, 1e7, 1e12, 1e17, 2e18, -1e20, 1e30, 1e38, 1e100, -1e308, kInfinity, std::nan("")));

}  // namespace
}  // namespace airsim360

// What the autopilot knows of its drone.
#pragma once

#include <cstdint>

#include "airsim360/flight/drone_state.h"

namespace airsim360 {

struct StateEstimate {
  int64_t t_ns = 0;
  Vec3d p_WB;
  Quaternion q_WB;
  Vec3d v_WB;
  Vec3d w_WB_B;
  std::array<double, kMaxRotors> rotor_speeds{};  ///< from the speed controllers' telemetry, rad/s
  double charge = 1;                              ///< of the battery
};

/// The truth as an estimate.
inline StateEstimate EstimateOf(const DroneState& state, int64_t t_ns) {
  return {t_ns, state.p_WB, state.q_WB, state.v_WB, state.w_WB_B, state.rotor_speeds, state.charge};
}

}  // namespace airsim360

// DroneState and DroneSurroundings as the equations take them, in double precision.
#pragma once

#include "airsim360/flight/drone_state.h"
#include "airsim360/flight/dynamics/body_equations.h"

namespace airsim360::internal {

AIRSIM360_LANES void LoadState(const DroneState& s, int rotors, BodyState<double>& b) {
  b.p = s.p_WB;
  b.p_low = {};
  b.v = s.v_WB;
  b.w = s.w_WB_B;
  b.q[0] = s.q_WB.w, b.q[1] = s.q_WB.x, b.q[2] = s.q_WB.y, b.q[3] = s.q_WB.z;
  for (int i = 0; i < rotors; ++i) b.speed[i] = s.rotor_speeds[i];
  b.charge = s.charge;
}

AIRSIM360_LANES void StoreState(const BodyState<double>& b, int rotors, DroneState& s) {
  s.p_WB = b.p;
  s.v_WB = b.v;
  s.w_WB_B = b.w;
  s.q_WB = {b.q[0], b.q[1], b.q[2], b.q[3]};
  for (int i = 0; i < rotors; ++i) s.rotor_speeds[i] = b.speed[i];
  s.charge = b.charge;
}

// A product where a division would be waited for; sea level must still be exactly 1.
inline constexpr double kInverseSeaLevelDensity = 1 / kSeaLevelAirDensity;
static_assert(kSeaLevelAirDensity * kInverseSeaLevelDensity == 1);

AIRSIM360_LANES LaneSurroundings<double> LoadSurroundings(const DroneSurroundings& s) {
  return {s.wind_W, s.wind_rate_B, s.force_W, s.torque_B, s.air_density * kInverseSeaLevelDensity, s.ground_distance};
}

/// Commands of failed rotors count as 0, of damaged ones in proportion.
AIRSIM360_LANES void LoadCommands(const RotorSpeeds& commands, const RotorHealth& health, int rotors, double* out) {
  for (int i = 0; i < rotors; ++i) out[i] = commands[i] * health[i];
}

}  // namespace airsim360::internal

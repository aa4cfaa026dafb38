// The continuous state of one multirotor. Plain data: a copy is a snapshot.
#pragma once

#include <array>
#include <cstdint>

#include "airsim360/flight/drone_model.h"

namespace airsim360 {

struct DroneState {
  Vec3d p_WB;                                     ///< centre of mass, metres
  Quaternion q_WB;                                ///< unit
  Vec3d v_WB;                                     ///< m/s, in W
  Vec3d w_WB_B;                                   ///< rad/s, in B
  std::array<double, kMaxRotors> rotor_speeds{};  ///< rad/s, >= 0
  double charge = 1;                              ///< of the battery, 1 = full, 0 = empty
};

/// What acts on a drone besides its rotors and its own drag; constant over a step.
struct DroneSurroundings {
  Vec3d wind_W;       ///< velocity of the air, m/s
  Vec3d wind_rate_B;  ///< rad/s, turning of the air (Dryden p, q, r)
  double air_density = kSeaLevelAirDensity;
  double ground_distance = 1e9;  ///< metres from the rotor plane down to the surface below (ground effect)
  Vec3d force_W, torque_B;       ///< contacts, downwash of others, pushes
};

/// Per-rotor health: 1 works, 0 has failed (its commanded speed counts as 0).
using RotorHealth = std::array<double, kMaxRotors>;

inline constexpr RotorHealth kAllRotorsWork = {1, 1, 1, 1, 1, 1, 1, 1};

/// Speeds in rad/s, in the order of DroneModel::rotors; places beyond the last rotor are ignored.
using RotorSpeeds = std::array<double, kMaxRotors>;

}  // namespace airsim360

// Random drones that could exist, for training and testing controllers on all of them.
#pragma once

#include <cstdint>

#include "airsim360/flight/drone_model.h"

namespace airsim360 {

/// Ranges of the sampling recipe of RAPTOR (Eschmann, Albani, Loianno 2025, as in l2f): thrust to weight and
/// size (the cube root of the mass) are uniform, everything else scatters about the size's own laws.
struct FleetRanges {
  double least_mass = 0.03, most_mass = 8;  ///< kg
  double least_thrust_to_weight = 1.5, most_thrust_to_weight = 6;
  bool only_quads = false;
};

/// Drone `id` of the fleet `seed`: the same one on every machine, whatever other drones are asked for. It
/// passes the gate (GateProblems). InputError for ranges that hold no drone.
DroneModel SampleDrone(uint64_t seed, uint64_t id, const FleetRanges& ranges = {});

}  // namespace airsim360

// Memory of a batch of drones: blocks of 16, one row of 16 floats for each component, whatever the width of
// the machine's vectors.
#pragma once

#include <cstdint>

#include "airsim360/base/kernel_isa.h"
#include "airsim360/flight/drone_constants.h"

namespace airsim360::internal {

inline constexpr int kBlockDrones = 16;
using LaneRow = float[kBlockDrones];

struct alignas(64) DroneBlock {
  LaneRow p[3], p_low[3], v[3], q[4], w[3], charge;
  LaneRow speed[kMaxRotors];
  LaneRow command[kMaxRotors];  ///< times the rotor's health
};

struct alignas(64) SurroundingsBlock {
  LaneRow wind[3], wind_rate[3], force[3], torque[3], density, ground_distance;
};

/// What one call of the kernel does: `steps` steps of each of `count` blocks.
struct BatchWork {
  const DroneConstants<float>* constants;
  DroneBlock* blocks;
  const SurroundingsBlock* surroundings;  ///< one for each block, or a single one when `shared`
  bool shared;
  bool near_ground;  ///< some drone feels the ground
  int steps;
  int64_t count;
};

}  // namespace airsim360::internal

AIRSIM360_DECLARE_KERNEL(void StepBlocks(const BatchWork& work))

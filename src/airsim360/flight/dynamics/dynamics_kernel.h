// One step of one drone, compiled for each instruction set: three-operand code and more registers are worth a
// tenth of the time even without SIMD.
#pragma once

#include "airsim360/base/kernel_isa.h"
#include "airsim360/flight/drone_constants.h"
#include "airsim360/flight/drone_state.h"

namespace airsim360::internal {
using StepOneKernel = void(const DroneConstants<double>& constants, const DroneSurroundings& surroundings, const RotorSpeeds& commands,
                           const RotorHealth& health, DroneState& state);
}

AIRSIM360_DECLARE_KERNEL(StepOneKernel StepOne)

// Whether a drone flies, or is about the ground.
#pragma once

#include "airsim360/sim/step.h"

namespace airsim360 {

/// Whether a drone is in the air to fly: neither standing nor taking off nor setting down.
bool IsEnRoute(const Vehicle& vehicle);

}  // namespace airsim360

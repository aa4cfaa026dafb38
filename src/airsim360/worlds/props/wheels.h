// Wheels of vehicles.
#pragma once

#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {

/// Tyre and five-spoke rim around `hub`, the axle along X, the visible face towards the side of `outside` (+1
/// or -1).
void AddWheel(PropBuilder& b, Vec3f hub, float radius, float width, float outside);

}  // namespace airsim360::internal

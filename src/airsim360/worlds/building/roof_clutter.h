// What stands on flat roofs.
#pragma once

#include "airsim360/worlds/building/roofs.h"

namespace airsim360::internal {

inline constexpr float kParapetThickness = 0.3f;  ///< metres

/// Puts what plan.seed asks for on the deck at plan.height(): on wide ones the bulkhead of the stairs, machines, vents,
/// tanks, antennas, a duct and skylights; on the narrow ones of row houses a hatch, chimneys, a skylight and vents. What the
/// plan keeps free and the next tier stay clear.
void AddRoofClutter(MeshBuilder& mesh, const Surfaces& surfaces, PropShelf& shelf, const BuildingPlan& plan, EntityId building,
                    EntityId roof);

}  // namespace airsim360::internal

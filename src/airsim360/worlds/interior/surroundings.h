// What is seen through the windows.
#pragma once

#include "airsim360/worlds/interior/furnisher.h"
#include "airsim360/worlds/interior/interior.h"

namespace airsim360::internal {

inline constexpr float kOutsideZ = -0.15f;  ///< of the ground around the building

/// Paths, lawn, a street with cars and trees, houses across it and to the horizon.
void BuildSurroundings(const InteriorPlan& plan, InteriorPen& pen, Furnisher& furnisher);

}  // namespace airsim360::internal

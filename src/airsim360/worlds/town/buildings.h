// All buildings of a plan: walls, roofs and what stands on them.
#pragma once

#include <vector>

#include "airsim360/worlds/town/district.h"

namespace airsim360::internal {

/// What hangs on walls beyond the styles' own.
struct BuildingExtras {
  bool fire_escapes = false;
  float escape_wall = 8;  ///< FacadeContext::escape_wall
  bool coolers = true;    ///< air conditioners in windows; else boxes of flowers
};

/// Buildings block by block, one merged mesh each; a plan with a `base` belongs to the entity of the one
/// before it. Every roof is an entity of its own.
void BuildBuildings(District& district, const std::vector<BuildingPlan>& buildings, const BuildingExtras& extras = {});

}  // namespace airsim360::internal

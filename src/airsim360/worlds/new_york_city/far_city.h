// The grid around the detailed blocks of new_york_city, shared by its far blocks and far streets.
#pragma once

#include "airsim360/worlds/new_york_city/city.h"

namespace airsim360::internal {

/// Metres: the grid's pitch, where its far blocks end, heights of carriageways and pavements there.
inline constexpr float kFarPitchX = 132, kFarPitchY = 84, kFarCityEdge = 660, kFarGroundZ = -0.14f, kFarPavementZ = -0.02f;

/// Asphalt, paint, cars and trees of the streets of the plan from the edge of `ring` to the end of the far blocks.
void LayFarStreets(District& district, const GroundRect& ring, const Density& density);

}  // namespace airsim360::internal

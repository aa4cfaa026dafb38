// Surfaces and walls that only some towns have: azulejos, logs, calçada, sampietrini, tracks, dry land.
#pragma once

#include "airsim360/worlds/osm/map_dress.h"
#include "airsim360/worlds/town_spec.h"

namespace airsim360::internal {

/// Changes the surfaces for a town and adds its walls.
void PaintTown(const TownSpec& spec, SceneBuilder& builder, Surfaces& surfaces, MapDress& dress);

}  // namespace airsim360::internal

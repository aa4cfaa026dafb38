// The ground of a town as a grid of heights.
#pragma once

#include "airsim360/worlds/town_maker/town_map.h"

namespace airsim360::internal {

/// Heights over the town and 1.2 km around it, level at its waters; empty where it is flat.
HeightGrid ReliefOf(const TownSpec& spec, uint64_t seed, const TownMap& map);

}  // namespace airsim360::internal

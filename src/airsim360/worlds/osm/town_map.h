// A town drawn as a map by rule, for the builders of real maps: streets, lots, houses, trees, lamps whose sizes and
// distances are distributed as in real towns (data/osm/distributions.csv).
#pragma once

#include "airsim360/worlds/osm/data/osm_data.h"

namespace airsim360::internal {

/// About 560 x 420 m of streets and wall-to-wall houses, as an OsmData without places on the Earth. A function of
/// the seed.
OsmData DrawTownMap(uint64_t seed);

}  // namespace airsim360::internal

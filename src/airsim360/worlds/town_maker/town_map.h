// A town drawn as a map by rule, from its measures: streets, waters, squares, lots and houses, for the builders of real
// maps, and the places where what maps do not know stands.
#pragma once

#include <string>
#include <vector>

#include "airsim360/worlds/osm/data/osm_data.h"
#include "airsim360/worlds/osm/data/patches.h"
#include "airsim360/worlds/osm/osm_world.h"
#include "airsim360/worlds/town_spec.h"

namespace airsim360::internal {

/// A street between two junctions or ends.
struct TownStreet {
  std::vector<Vec2d> line;
  int rank = 1;                     ///< 0 main street, 1 street, 2 lane without cars, 3 promenade
  double half = 4, pavement = 1.5;  ///< metres: centre to kerb; of each pavement
  bool bridge = false;
};

/// A place for something that maps do not know.
struct TownSpot {
  std::string kind;  ///< "ruin", "arch", "jetty", "windmill", "stall", "terrace", "fountain" …
  Vec2d p, front;    ///< front: unit, where it looks
  double size = 0;   ///< metres, what is meant depends on the kind
};

struct TownMap {
  OsmData data;
  HeightGrid heights;  ///< empty where the town is flat
  std::vector<TownStreet> streets;
  std::vector<TownSpot> spots;
  Patches wet;               ///< sea, river, lake
  Patches squares;           ///< in order of their distance from the middle
  std::vector<Vec2d> river;  ///< the middle of a river or canal, from horizon to horizon; empty where there is none
  double river_half = 0;     ///< metres from there to the banks
  uint64_t houses = 0;       ///< the landmarks are none
};

/// The map of a town that Check accepts; a function of the measures and the seed.
TownMap DrawTown(const TownSpec& spec, uint64_t seed);

}  // namespace airsim360::internal

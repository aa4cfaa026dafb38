// Buildings of an extract as volumes: outlines and parts with heights, roofs, colours; no geometry yet.
#pragma once

#include <string>
#include <vector>

#include "airsim360/worlds/osm/buildings/osm_areas.h"

namespace airsim360::internal {

enum class OsmRoof {
  kFlat,
  kGabled,
  kHipped,
  kHalfHipped,
  kGambrel,
  kMansard,
  kPyramidal,
  kCone,
  kDome,
  kOnion,
  kRound,
  kSkillion,
  kSaltbox,
  kSawtooth
};

/// One extruded volume: a building, or a part of one. Heights in metres over the ground at its foot.
struct OsmVolume {
  std::string id;  ///< of the OSM object it comes from
  const OsmTags* tags = nullptr;
  Patches footprint;
  double bottom = 0, top = 0;  ///< min_height and height, roof included
  double roof_height = 0;      ///< of what is not flat; within top - bottom
  OsmRoof roof = OsmRoof::kFlat;
  bool canopy = false;  ///< a roof on posts, no walls
};

/// Where a height comes from.
enum class HeightSource { kTag, kLevels, kGuess };

struct OsmBuilding {
  std::string id;
  std::string name;  ///< as people call it, "" if the map does not say
  const OsmTags* tags = nullptr;
  bool orphan = false;             ///< a building:part outside all buildings
  Patches outline;                 ///< empty: nothing of it can be drawn
  std::vector<OsmVolume> volumes;  ///< its parts, and what of the outline they leave
  double height = 0;               ///< of its highest volume
  HeightSource source = HeightSource::kGuess;
};

/// All objects with building=* (nodes, ways, multipolygons; each exactly once), then the parts that belong to
/// none. After the rules of "Simple 3D buildings": where parts say what stands there, the outline does not.
std::vector<OsmBuilding> PlanOsmBuildings(const OsmData& data, const std::vector<OsmArea>& areas);

}  // namespace airsim360::internal

// Areas of an extract: closed ways, and multipolygon relations put together from their member ways.
#pragma once

#include <string>
#include <vector>

#include "airsim360/worlds/osm/data/osm_data.h"
#include "airsim360/worlds/osm/data/patches.h"

namespace airsim360::internal {

/// A closed way or a multipolygon. `tags` point into the OsmData.
struct OsmArea {
  std::string id;  ///< "way/123" or "relation/45"
  int64_t number = 0;
  bool relation = false;
  const OsmTags* tags = nullptr;
  Patches patches;  ///< empty where the file lacks its ways or they do not close
  double area = 0;  ///< m^2
  Bounds2d bounds;
  bool broken = false;  ///< a multipolygon whose ways are all there and do not close
};

/// All areas with tags, ways by id, then relations by id. Inner rings of multipolygons whose tags are on their
/// outer way are cut out of that way.
std::vector<OsmArea> FindAreas(const OsmData& data);

/// "way/123"
std::string OsmId(const char* kind, int64_t id);

}  // namespace airsim360::internal

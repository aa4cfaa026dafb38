// Coastlines of an extract, joined end to end.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "airsim360/worlds/osm/buildings/osm_areas.h"

namespace airsim360::internal {

struct CoastLine {
  Ring points;  ///< land on the left; of a closed line the first is not repeated
  bool closed = false;
};

/// The ways with natural=coastline, those that one begins where another ends as one line. A way that runs against
/// those it touches is turned round; `faults` tells.
std::vector<CoastLine> JoinCoast(const OsmData& data, std::vector<std::string>& faults);

/// Does p lie to the right of the line nearest to it? nullopt without lines.
std::optional<bool> OnTheRight(const std::vector<CoastLine>& lines, Vec2d p);

}  // namespace airsim360::internal

// The sea of an extract, from its coastlines.
#pragma once

#include <string>
#include <vector>

#include "airsim360/worlds/osm/buildings/osm_areas.h"

namespace airsim360::internal {

struct Sea {
  Patches water;                    ///< within the box
  std::vector<std::string> faults;  ///< what was wrong with the coastlines, and what was made of it
};

/// What lies to the right of the ways with natural=coastline, within `box`. Ways are joined end to end; a line that
/// ends within the box goes on in its direction to the border (extracts cut it there), or to the next end where that
/// is much nearer. Closed lines are islands, or where they run clockwise, water. A box that no coastline enters is wet
/// or dry as the nearest one says; without coastlines there is no sea.
Sea FindSea(const OsmData& data, const OsmBox& box);

}  // namespace airsim360::internal

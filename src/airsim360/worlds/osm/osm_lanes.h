// The lanes of a map's streets, as they are painted.
#pragma once

#include "airsim360/scene/road_network.h"
#include "airsim360/worlds/osm/osm_streets.h"

namespace airsim360::internal {

/// Lanes of all carriageways of the graph that are wide enough to meet in, service ways left out. Nodes with traffic signals
/// have the cycle of worlds/town/street_lanes.h; elsewhere the road of the higher class goes first.
RoadNetwork OsmLanes(const OsmScene& scene, const RoadGraph& graph);

}  // namespace airsim360::internal

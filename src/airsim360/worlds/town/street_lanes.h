// The lanes of a plan of streets, as they are painted.
#pragma once

#include "airsim360/scene/road_network.h"
#include "airsim360/worlds/kit/street_plan.h"

namespace airsim360 {

/// Lanes of all streets of the plan, out to the ring of backdrop. Where four streets meet, signals have a cycle of 44 s, as walkers
/// have them (people/crowd); north-south streets drive while those who walk north or south do. Elsewhere right of way
/// decides: avenues before streets.
RoadNetwork RoadsOf(const StreetPlan& plan);

}  // namespace airsim360

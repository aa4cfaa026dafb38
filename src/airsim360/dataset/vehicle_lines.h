// vehicles.jsonl: the traffic of every frame.
#pragma once

#include <string>

#include "airsim360/sim/fly_route.h"
#include "airsim360/sim/people/people.h"
#include "airsim360/sim/traffic/traffic.h"

namespace airsim360 {

/// Vehicles farther than this from the body are left out, metres.
inline constexpr double kVehicleLabelReach = 200;

/// A line a shot of the flight: {"frame", "t_ns", "vehicles": [{"entity", "name", "category", "X_WB", "size", "velocity", "lane",
/// "lane_position", "indicator", "braking", "stopped"}], "near_misses": [{"t_ns", "first", "second", "time_to_collision", "braking",
/// "p"}]}, vehicles in the order of their names. `people` name those of near misses; null: nobody is there. Docs:
/// docs/guide/traffic.md.
std::string VehiclesJsonl(const SimTraffic& traffic, const Flight& flight, const SimPeople* people = nullptr);

}  // namespace airsim360

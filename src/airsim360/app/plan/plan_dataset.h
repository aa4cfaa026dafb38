// airsim360 plan --dataset: the waypoint set.
#pragma once

#include <cstdint>
#include <string>

#include "airsim360/app/flags/commands.h"

namespace airsim360 {

struct WaypointSetArguments {
  std::string dataset;  ///< "waypoint"
  std::string out, worlds, shard = "0/1";
  int64_t routes = 0;  ///< of each world; 0 = all
  double clearance = 0.5;
};

/// Writes the set and reports it. InputError naming the flag that is wrong.
void RunWaypointSet(const WaypointSetArguments& arguments, const GlobalOptions& globals);

}  // namespace airsim360

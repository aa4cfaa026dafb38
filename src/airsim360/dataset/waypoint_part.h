// Parts of the waypoint set on disk, and what is made from all of them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/dataset/waypoint_set.h"

namespace airsim360::internal {

/// Columns of the index.
inline constexpr char kIndexHeader[] =
    "id,world,set,route,part,row,length_m,duration_s,segments,samples,max_speed,max_acceleration,"
    "least_clearance,time_lower_bound_s,start_x,start_y,start_z,end_x,end_y,end_z\n";

/// Which part.
struct PartName {
  const WaypointWorld& world;
  size_t set;
  int64_t number, first_route;
};

/// Arrays of the flights of one set, as NPZ: waypoints, waypoint_offset, durations, segment_offset,
/// coefficients (segment, axis, power), samples (t, p, v, a), sample_offset.
std::string EncodePart(std::span<const WaypointRoute> routes, const PartName& part);
/// Their rows of the index.
std::string PartRows(std::span<const WaypointRoute> routes, const PartName& part);
/// Counts, ranges and histograms of an index (with its header), as JSON.
std::string Statistics(std::string_view index);
/// Card of the set.
std::string WaypointReadme(const WaypointSetOptions& options, std::string_view statistics);

}  // namespace airsim360::internal

// Where the waypoints of `airsim360 plan` come from: a file, two places, or a kind of route.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "airsim360/routes/route.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

struct WaypointArguments {
  std::string file, from, to, route;
  std::string area, center, entity, length = "50,150";
  double height = 20, spacing = 10, radius = 10, turns = 1, heading_deg = 0;
};

/// Waypoints with where each is from, for messages.
struct PlanWaypoints {
  std::vector<Waypoint> points;
  std::vector<std::string> sources;  ///< "file:line", "--from", …

  std::vector<Vec3d> Positions() const;
  bool timed() const { return !points.empty() && points.front().has_time; }
};

/// InputError unless the flags name one source of waypoints, whole.
void CheckSources(const WaypointArguments& arguments);

/// True if a world is needed to find the waypoints.
bool NeedsWorld(const WaypointArguments& arguments);

/// InputError naming flag or file:line for what is wrong. `tracer` may be null where NeedsWorld says no.
PlanWaypoints FindWaypoints(const WaypointArguments& arguments, std::shared_ptr<const RayTracer> tracer, uint64_t seed, double clearance);

/// InputError unless there are two or more, neighbours differ, and all or none have times that grow.
void CheckWaypoints(const PlanWaypoints& waypoints);

}  // namespace airsim360

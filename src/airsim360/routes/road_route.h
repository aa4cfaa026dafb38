// A flight along the roads of a world.
#pragma once

#include <vector>

#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

struct RoadRouteOptions {
  double height = 8;  ///< metres above the road
  double corner = 2;  ///< metres that the legs may leave the middle of the road by
};

/// Waypoints above the middle of the roads, along the longest way among shortest ways that was found: in the
/// largest network, from a place farthest from some other to the place farthest from that. A pure function of
/// the scene and the options. InputError if the world has no road.
std::vector<Vec3d> RoadRoute(const RayTracer& tracer, const RoadRouteOptions& options);

}  // namespace airsim360

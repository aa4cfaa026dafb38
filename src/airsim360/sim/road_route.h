// A flight along the roads of a world.
#pragma once

#include <vector>

#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

struct RoadRouteOptions {
  double height = 8;    ///< metres above the road
  double corner = 1.5;  ///< metres that the legs may leave the middle of the road by
};

/// Waypoints above the middle of the roads, along the longest way among shortest ways that was found: from
/// the part of the road network that is farthest from its densest place to the part farthest from that. A
/// pure function of the scene and the options. InputError if the world has no road.
std::vector<Vec3d> RoadRoute(const RayTracer& tracer, const RoadRouteOptions& options);

}  // namespace airsim360

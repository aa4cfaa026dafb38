// Distance from a point to the surfaces of a scene.
#pragma once

#include <embree3/rtcore.h>

#include "airsim360/math/vector.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// The point of triangle (a, b, c) nearest to p; also right for triangles without area.
Vec3f ClosestPointOnTriangle(Vec3f p, Vec3f a, Vec3f b, Vec3f c);

/// Distance from p_W to the nearest triangle of `top`, an Embree scene of `tracer`; at most max_distance.
/// `skip_moved`: leave out the instances that the tracer has elsewhere.
float ClosestSurfaceDistance(const RayTracer& tracer, RTCScene top, bool skip_moved, Vec3f p_W,
                             float max_distance);

}  // namespace airsim360::internal

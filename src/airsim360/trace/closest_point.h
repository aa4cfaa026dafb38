// Distance from a point to the surfaces of a scene.
#pragma once

#include <embree3/rtcore.h>

#include "airsim360/math/vector.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// The point of triangle (a, b, c) nearest to p; also right for triangles without area.
Vec3f ClosestPointOnTriangle(Vec3f p, Vec3f a, Vec3f b, Vec3f c);

/// Distance from p_W to the nearest triangle of `top`, the Embree scene of `tracer`; at most max_distance.
float ClosestSurfaceDistance(const RayTracer& tracer, RTCScene top, Vec3f p_W, float max_distance);

}  // namespace airsim360::internal

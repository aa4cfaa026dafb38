// The point of a triangle nearest to a given one.
#pragma once

#include "airsim360/math/vector.h"

namespace airsim360::internal {

/// The point of triangle (a, b, c) nearest to p; also right for triangles without area.
Vec3f ClosestPointOnTriangle(Vec3f p, Vec3f a, Vec3f b, Vec3f c);

}  // namespace airsim360::internal

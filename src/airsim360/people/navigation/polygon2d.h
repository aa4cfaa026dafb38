// Plane polygons, corners in order.
#pragma once

#include <span>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/math/triangulate.h"
#include "airsim360/math/vector.h"

namespace airsim360::internal {

/// Area that a simple polygon shares with a convex counter-clockwise one.
double ClippedArea(std::span<const Vec2d> polygon, std::span<const Vec2d> convex);
/// Uniform in a convex polygon.
Vec2d PointInFan(std::span<const Vec2d> convex, RngStream& rng);
/// Counter-clockwise.
std::vector<Vec2d> ConvexHull(std::vector<Vec2d> points);

}  // namespace airsim360::internal

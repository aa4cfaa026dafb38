// Triangles of a polygon in space.
#pragma once

#include <span>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360::internal {

/// corners.size() - 2 triangles (indices into `corners`, same turning sense) that tile the polygon: ear
/// clipping in the plane of its Newell normal. Polygons that are not simple, or have more than 512 corners,
/// become a fan.
std::vector<Vec3u> TriangulateFace(std::span<const Vec3f> corners);

}  // namespace airsim360::internal

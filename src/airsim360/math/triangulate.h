// Areas, insides and triangles of plane polygons.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// Half the cross products along the ring: positive if counter-clockwise; 0 for fewer than three corners.
double SignedArea(std::span<const Vec2d> ring);

/// Even-odd rule.
bool InPolygon(std::span<const Vec2d> ring, Vec2d p);

/// Corner indices, three a counter-clockwise triangle, of an area whose outline is the first `sizes[0]` points,
/// counter-clockwise, followed by holes of `sizes[1]`, … points, clockwise. Ear clipping over bridges to the
/// holes (D. Eberly, Triangulation by Ear Clipping, 2002). Never fails; what crosses itself is covered as well as
/// it can be. Quadratic in the number of corners at worst.
std::vector<uint32_t> TriangulateRings(std::span<const Vec2d> points, std::span<const uint32_t> sizes);

}  // namespace airsim360

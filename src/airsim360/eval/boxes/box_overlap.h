// Overlap of boxes in space and of boxes that go round a panorama. Pure functions.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// A box on its base: centre, length along its heading, width across, height; yaw counter-clockwise about +Z from +X.
struct UprightBox {
  Vec3d centre;
  double length = 0, width = 0, height = 0;  ///< above 0
  double yaw = 0;                            ///< radians
};
/// Intersection over union of the volumes.
double VolumeOverlap(const UprightBox& a, const UprightBox& b);
/// Intersection over union of the outlines seen from above.
double FootprintOverlap(const UprightBox& a, const UprightBox& b);

/// Intersection over union of boxes [x, y, width, height] in a panorama whose columns go round: x + width may exceed `columns`; a crowd's
/// is over the detection's area. No box is wider than the panorama.
double WrappedBoxOverlap(std::array<double, 4> detection, std::array<double, 4> truth, bool crowd, double columns);

/// The part of a polygon inside a convex counter-clockwise one (Sutherland and Hodgman, CACM 17(1), 1974).
std::vector<Vec2d> ClipConvex(std::span<const Vec2d> polygon, std::span<const Vec2d> convex);
/// Area shared by any two polygons that do not cross themselves.
double SharedPolygonArea(std::span<const Vec2d> a, std::span<const Vec2d> b);

}  // namespace airsim360

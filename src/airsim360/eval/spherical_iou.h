// Overlap of boxes on the sphere, exact: no longitude-latitude approximation.
#pragma once

#include "airsim360/math/transform.h"

namespace airsim360 {

/// A rectangle of the tangent plane (BFoV, RBFoV): what a pinhole camera that looks along (lon, lat) and is
/// turned by `gamma` counter-clockwise sees within the angles `width` and `height`. Radians; width and height
/// in (0, pi); lon 0 is ahead, positive to the right; lat positive up.
struct SphericalBox {
  double lon = 0, lat = 0, width = 0, height = 0, gamma = 0;
};

/// Axes (right, down, ahead) of a camera that looks along (lon, lat) and is turned by gamma, as a box's is, in the panorama's frame: +X right,
/// +Y down, +Z ahead. Radians.
Mat3d SphericalAxes(double lon, double lat, double gamma);

/// Steradians: 4 acos(-sin(width / 2) sin(height / 2)) - 2 pi, as 4 asin(...), which keeps small boxes exact.
double SphericalBoxArea(const SphericalBox& box);

/// Steradians that both contain: the convex spherical polygon cut out by the eight great circles.
/// InputError for angles outside (0, pi) or numbers that are not finite.
double SphericalIntersection(const SphericalBox& a, const SphericalBox& b);

/// Intersection over union (Unbiased IoU: F. Dai et al., Unbiased IoU for Spherical Image Object Detection,
/// AAAI 2022, here with rotated boxes too).
double SphericalIou(const SphericalBox& a, const SphericalBox& b);

}  // namespace airsim360

// Boxes of directions on the sphere: fields of view that contain a thing, without seams or poles.
// Directions are unit vectors of C (+X right, +Y down, +Z forward).
#pragma once

#include <span>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// A rectangle on the tangent plane: what a pinhole camera turned to (lon, lat) sees within the angles
/// `width` and `height` (radians, below pi); up in it is towards the zenith, then turned by `gamma`
/// counter-clockwise as the viewer sees it. lon in [-pi, pi), 0 ahead, positive to the right; lat positive up.
struct FieldOfView {
  double lon = 0, lat = 0, width = 0, height = 0, gamma = 0;
};

/// Longitude and latitude of a direction of any length > 0.
Vec2d LonLat(Vec3d direction);
/// Unit direction of a longitude and latitude.
Vec3d DirectionOf(double lon, double lat);

/// Axes of a field of view in C: right, down and forward in the picture it stands for.
struct ViewAxes {
  Vec3d right, down, forward;
};
ViewAxes AxesOf(const FieldOfView& view);

/// The field of view with gamma = 0 whose four sides all touch the directions: the centre is moved until the
/// extremes are symmetric. Around the zenith and the nadir, where north turns with the centre, there may be no
/// such one; what is given contains them all. Things that span more than a hemisphere get 175 degrees. Zero angles without
/// directions.
FieldOfView FitFieldOfView(std::span<const Vec3d> directions);
/// The one of least solid angle over all gamma, in [-pi/2, pi/2): one of its sides lies along an edge of the
/// convex hull in the tangent plane. Never larger than FitFieldOfView's.
FieldOfView FitRotatedFieldOfView(std::span<const Vec3d> directions);

/// Solid angle, steradians: 4 asin(sin(width / 2) sin(height / 2)).
double SolidAngleOf(const FieldOfView& view);

}  // namespace airsim360

// Where a panorama shows a direction, and how its camera turns. Directions are in the camera's frame: +X right, +Y down, +Z ahead. Pure
// functions.
#pragma once

#include "airsim360/math/transform.h"
#include "airsim360/math/vector.h"

namespace airsim360 {

/// The unit direction of a place in a picture of `width` by `height` pixels whose left top corner is (0, 0); places beyond the upper or lower
/// border lie behind the pole.
Vec3d PanoramaRay(double x, double y, int width, int height);
/// The place of a direction (of any length but 0): x in 0 … width, y in 0 … height.
Vec2d PanoramaPlace(Vec3d direction, int width, int height);

/// R_C_turned: the axes of a camera that was turned by yaw to the right, pitch upwards and roll clockwise (radians, in this order from
/// outside) in the frame of the one that was not.
Mat3d TurnedCamera(double yaw, double pitch, double roll);

}  // namespace airsim360

// The projection of a calibrated lens and its inverse. Not for other modules.
#pragma once

#include <optional>

#include "airsim360/projection/camera.h"

namespace airsim360::internal {

/// How far from its axis a lens goes on growing.
struct LensLimit {
  double theta = 0;    ///< radians; the largest that max_theta may be
  bool folds = false;  ///< it is the distortion that ends there: beyond it the picture folds over itself
  double azimuth = 0;  ///< radians from +x towards +y; a direction in which it ends first
};
/// The cone around the axis within which the picture of a direction moves outwards with its angle and never turns over:
/// radius of the law and determinant of the distortion's Jacobian grow and stay positive, along 72 azimuths (one for a
/// lens without tangential and prism terms), in 4096 steps, the last one halved to the precision of doubles.
LensLimit FindLensLimit(const CalibratedLens& lens);

/// Where a lens sees a direction at most max_theta from its axis, also beyond the borders of the picture.
std::optional<Vec2d> ProjectLens(const CalibratedLens& lens, Vec3d ray);

/// Unit ray through a pixel position: ProjectLens of it is `pixel` to 1e-9 pixels. nullopt where no direction within
/// max_theta is seen there.
std::optional<Vec3d> LensRay(const CalibratedLens& lens, Vec2d pixel);

/// Whether every position on the border of the picture has a ray.
bool FillsPicture(const CalibratedLens& lens);

/// InputError unless the numbers are finite and in the range of their law, and max_theta is within FindLensLimit.
void CheckLens(const CalibratedLens& lens);

}  // namespace airsim360::internal

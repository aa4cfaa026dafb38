// The part of a panorama that a network for photographs can make sense of.
#pragma once

#include "airsim360/image/image.h"
#include "airsim360/math/transform.h"

namespace airsim360::internal {

/// The panorama turned upright and with east of W in the middle by its pose, between the latitudes -60 and 60 degrees,
/// squeezed to width x height. So a camera that is turned at its place gives the same picture, but for resampling; near the
/// poles a panorama has many pixels for little, which would weigh as much as all else.
Image<Rgb8> UprightBand(const Image<Rgb8>& panorama, const Mat3d& R_WC, int width, int height);

}  // namespace airsim360::internal

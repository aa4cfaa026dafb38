// Exposure from the picture itself.
#pragma once

#include "airsim360/image/image.h"
#include "airsim360/projection/camera.h"

namespace airsim360::internal {

/// Stops to add so that radiance * `exposure` * 2^stops is a middle grey of kAutoGrey in the mean: the mean
/// of log luminance over the picture's solid angle (rows of a panorama weighted by cos(latitude), else pixels
/// alike), without the darkest and the brightest tenth. 0 for a picture without light. Within +-8 stops, and
/// exposure * 2^stops not above `most`. Rolling a panorama or the number of threads does not change it.
double AutoExposureEv(const Image<Rgb32f>& radiance, const Camera& camera, float exposure, double most);

/// What the input of the tone curve is in the mean. By day downtown_west comes out within a quarter of a stop
/// of its fixed exposure.
inline constexpr double kAutoGrey = 0.20;

}  // namespace airsim360::internal

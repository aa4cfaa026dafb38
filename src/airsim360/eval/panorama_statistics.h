// Low-order statistics of panoramas: a floor under realism (a blank picture fails it), no measure of it.
#pragma once

#include "airsim360/image/image.h"

namespace airsim360 {

/// Means over eight square views of 80 degrees (four directions at pitch 0 and -35 degrees) cut from an equirectangular
/// picture that is first brought to 512 x 256 (views of 96 pixels, the nearest pixel each), on the luminance of sRGB values in [0, 1].
struct PanoramaStatistics {
  double slope = 0;     ///< exponent s of the radial power spectrum 1 / f^s; real outdoor panoramas: 1.95 … 2.95
  double flat = 0;      ///< share of blocks of 8 x 8 pixels whose standard deviation is below 0.004; real: up to 0.094
  double gradient = 0;  ///< mean length of the gradient (central differences, a pixel); real: 0.029 … 0.089
  double entropy = 0;   ///< bits of a histogram of 64 bins; real: 4.6 … 5.5
};

/// InputError unless the picture is twice as wide as high and at least 64 pixels high.
PanoramaStatistics MeasurePanorama(const Image<Rgb8>& panorama);

}  // namespace airsim360

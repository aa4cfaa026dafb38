// Display colours of a whole picture.
#pragma once

#include "airsim360/image/image.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {

/// light * exposure through the tone curve to 8-bit sRGB. `out` is resized where its size differs.
void ToneMapImage(const Image<Rgb32f>& light, float exposure, ToneCurve tone, Image<Rgb8>& out);

}  // namespace airsim360

// Planes that keep their memory from frame to frame.
#pragma once

#include "airsim360/image/image.h"

namespace airsim360::internal {

/// As large as asked for; its content stays where it was that large.
template <class Pixel>
void Fit(Image<Pixel>& image, int width, int height) {
  if (image.width() != width || image.height() != height) image = Image<Pixel>(width, height);
}

}  // namespace airsim360::internal

// Shared check of the metrics' arguments. Not for other modules.
#pragma once

#include <algorithm>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/image/image.h"

namespace airsim360::internal {

/// InputError unless both have the same size, of at least `least` x `least` pixels.
inline void CheckComparable(const Image<Rgb8>& a, const Image<Rgb8>& b, int least = 1) {
  const auto size = [](const Image<Rgb8>& image) { return std::to_string(image.width()) + "x" + std::to_string(image.height()); };
  if (a.width() != b.width() || a.height() != b.height()) {
    throw InputError("pictures of different size: " + size(a) + " and " + size(b));
  }
  if (std::min(a.width(), a.height()) < least) {
    throw InputError("pictures of " + size(a) + " pixels: at least " + std::to_string(least) + "x" + std::to_string(least) + " are needed");
  }
}

}  // namespace airsim360::internal

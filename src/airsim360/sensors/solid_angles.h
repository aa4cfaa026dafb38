// Solid angle of every pixel of a camera, computed once.
#pragma once

#include <vector>

#include "airsim360/projection/camera.h"

namespace airsim360 {

class PixelSolidAngles {
 public:
  explicit PixelSolidAngles(const Camera& camera);
  /// Steradians of the pixel in column x, row y; 0 where the camera sees nothing.
  double operator()(int x, int y) const {
    return rows_only_ ? values_[static_cast<size_t>(y)] : values_[static_cast<size_t>(y) * width_ + x];
  }

 private:
  bool rows_only_;  // equirectangular: the same along a row
  size_t width_;
  std::vector<double> values_;
};

}  // namespace airsim360

#include "airsim360/sensors/solid_angles.h"

#include "airsim360/base/parallel.h"

namespace airsim360 {

PixelSolidAngles::PixelSolidAngles(const Camera& camera)
    : rows_only_(std::holds_alternative<Equirectangular>(camera)), width_(static_cast<size_t>(Width(camera))) {
  const size_t columns = rows_only_ ? 1 : width_;
  values_.resize(columns * static_cast<size_t>(Height(camera)));
  ParallelFor(Height(camera), [&](int64_t y) {
    for (size_t x = 0; x < columns; ++x) {
      values_[static_cast<size_t>(y) * columns + x] = SolidAngle(camera, static_cast<int>(x), static_cast<int>(y));
    }
  });
}

}  // namespace airsim360

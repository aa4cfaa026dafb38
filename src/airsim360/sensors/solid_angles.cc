#include "airsim360/sensors/solid_angles.h"

#include <algorithm>
#include <span>

#include "airsim360/base/parallel.h"
#include "airsim360/projection/solid_angle_rows.h"

namespace airsim360 {

PixelSolidAngles::PixelSolidAngles(const Camera& camera)
    : rows_only_(std::holds_alternative<Equirectangular>(camera)), width_(static_cast<size_t>(Width(camera))) {
  const size_t columns = rows_only_ ? 1 : width_;
  values_.resize(columns * static_cast<size_t>(Height(camera)));
  if (rows_only_) {
    for (int y = 0; y < Height(camera); ++y) values_[static_cast<size_t>(y)] = SolidAngle(camera, 0, y);
    return;
  }
  constexpr int kRows = 16;
  ParallelFor((Height(camera) + kRows - 1) / kRows, [&](int64_t k) {
    const int first = static_cast<int>(k) * kRows, last = std::min(first + kRows, Height(camera));
    const std::span<double> values(values_);
    internal::SolidAnglesOfRows(camera, first, last, values.subspan(first * columns, (last - first) * columns));
  });
}

}  // namespace airsim360

#include "airsim360/projection/resample.h"

#include <limits>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/projection/bilinear.h"

namespace airsim360 {
namespace {

using internal::Bilinear;
using internal::ClampReader;
using internal::SphereReader;

template <class Reader>
Image<Rgb32f> ResampleWith(const Reader& read, const Image<Vec2d>& map) {
  Image<Rgb32f> result(map.width(), map.height());
  ParallelFor(map.height(), [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < map.width(); ++x) {
      if (!std::isnan(map(x, y).x)) result(x, y) = Bilinear(read, map(x, y));
    }
  });
  return result;
}

}  // namespace

Image<Vec2d> ResamplingMap(const Camera& target, const Camera& source, const Mat3d& R_source_target) {
  CheckCamera(target);
  CheckCamera(source);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Image<Vec2d> map(Width(target), Height(target), {kNone, kNone});
  ParallelFor(map.height(), [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < map.width(); ++x) {
      const auto ray = PixelToRay(target, {x + 0.5, y + 0.5});
      if (!ray) continue;
      if (const auto pixel = RayToPixel(source, R_source_target * *ray)) map(x, y) = *pixel;
    }
  });
  return map;
}

Image<Rgb32f> ResampleBilinear(const Image<Rgb32f>& source, const Camera& source_camera, const Image<Vec2d>& map) {
  if (source.width() != Width(source_camera) || source.height() != Height(source_camera)) {
    throw InputError("resampling: the picture has " + std::to_string(source.width()) + "x" + std::to_string(source.height()) +
                     " pixels, its camera " + std::to_string(Width(source_camera)) + "x" + std::to_string(Height(source_camera)));
  }
  const bool sphere = std::holds_alternative<Equirectangular>(source_camera);
  return sphere ? ResampleWith(SphereReader{source}, map) : ResampleWith(ClampReader{source}, map);
}

}  // namespace airsim360

#include "airsim360/dataset/export/range_points.h"

#include <cmath>
#include <numbers>

namespace airsim360::internal {

std::vector<RangePoint> PointsOf(const ExportJob& job, const NativeFrame& frame, const View& view, int64_t count) {
  std::vector<RangePoint> points;
  if (count <= 0) return points;
  const Image<float> range = job.data.Range(frame, view);
  const Image<Rgb8> rgb = job.data.Rgb(frame, view);
  const RigidTransform X_WC = frame.X_WC(view);
  // Roberts' R2 sequence: multiples of the inverse powers of the plastic number.
  constexpr double kPlastic = 1.32471795724474602596;
  const double step_u = 1 / kPlastic, step_v = 1 / (kPlastic * kPlastic);
  const bool sphere = view.projection == Projection::kErp;
  for (int64_t i = 0; i < count; ++i) {
    const double n = static_cast<double>(static_cast<int64_t>(frame.position) * count + i + 1);
    const double u = n * step_u - std::floor(n * step_u), v = n * step_v - std::floor(n * step_v);
    const double row = sphere ? std::acos(1 - 2 * v) / std::numbers::pi : v;
    const int x = std::min(static_cast<int>(u * range.width()), range.width() - 1);
    const int y = std::min(static_cast<int>(row * range.height()), range.height() - 1);
    const float r = range(x, y);
    if (r <= 0) continue;
    const Vec2d pixel{x + 0.5, y + 0.5};
    const auto ray = PixelToRay(view.camera, pixel);
    if (ray) points.push_back({X_WC * (static_cast<double>(r) * *ray), rgb(x, y), pixel});
  }
  return points;
}

int64_t PointsAPicture(const ExportJob& job) {
  const auto pictures = static_cast<int64_t>(job.data.size() * job.data.views().size());
  return job.options.points == 0 ? 0 : std::max<int64_t>(1, job.options.points / pictures);
}

}  // namespace airsim360::internal

#include "airsim360/eval/flow/flow_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/eval/sphere/panorama_ray.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/vector.h"

namespace airsim360 {
namespace {

// Well conditioned for small and large angles alike.
double Angle(Vec3d a, Vec3d b) { return std::atan2(Norm(Cross(a, b)), Dot(a, b)); }

}  // namespace

std::array<double, kFlowFigures.size()> Figures(const FlowErrors& e) {
  return {e.epe, e.fl_all, e.within1, e.within3, e.within5, e.angle_deg};
}

FlowErrors MeasureFlow(std::span<const double> prediction, std::span<const double> truth, int width, int height, bool panorama,
                       std::span<const uint32_t> source, std::span<const double> weights) {
  const size_t pixels = truth.size() / 2;
  if (prediction.size() != truth.size() || truth.size() % 2 != 0 || (!source.empty() && source.size() != pixels) ||
      (!weights.empty() && weights.size() != pixels))
    throw InputError("arrays of different length: " + std::to_string(prediction.size()) + " predictions, " + std::to_string(truth.size()) +
                     " truths");
  FlowErrors sum;
  double all = 0;
  for (size_t i = 0; i < pixels; ++i) {
    const double gx = truth[2 * i], gy = truth[2 * i + 1], px = prediction[2 * i], py = prediction[2 * i + 1];
    if (!std::isfinite(gx) || !std::isfinite(gy)) continue;
    if (!std::isfinite(px) || !std::isfinite(py))
      throw InputError("the predicted flow of pixel " + std::to_string(i) + " is no number, but it has a truth");
    const double dx = panorama ? std::remainder(px - gx, static_cast<double>(width)) : px - gx, error = std::hypot(dx, py - gy);
    const double w = weights.empty() ? 1 : weights[i];
    all += w;
    ++sum.valid;
    sum.epe += w * error;
    sum.fl_all += error > 3 && error > 0.05 * std::hypot(gx, gy) ? w : 0;
    sum.within1 += error < 1 ? w : 0;
    sum.within3 += error < 3 ? w : 0;
    sum.within5 += error < 5 ? w : 0;
    if (!panorama) continue;
    const auto at = static_cast<int64_t>(source.empty() ? i : source[i]);
    const double x = static_cast<double>(at % width) + 0.5, y = static_cast<double>(at / width) + 0.5;
    sum.angle_deg += w * Angle(PanoramaRay(x + gx, y + gy, width, height), PanoramaRay(x + px, y + py, width, height));
  }
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const double n = all > 0 ? all : kNan;
  return {sum.epe / n, sum.fl_all / n, sum.within1 / n, sum.within3 / n, sum.within5 / n, panorama ? sum.angle_deg / n * 180 / kPi : kNan,
          sum.valid};
}

std::vector<double> TurnFlowBack(std::span<const double> flow, int width, int height, const Mat3d& R_C_turned) {
  const Mat3d turned_from_first = R_C_turned.transpose();
  std::vector<double> back;
  back.reserve(flow.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Vec2d seen = PanoramaPlace(turned_from_first * PanoramaRay(x + 0.5, y + 0.5, width, height), width, height);
      const int column = std::clamp(static_cast<int>(seen.x), 0, width - 1), row = std::clamp(static_cast<int>(seen.y), 0, height - 1);
      const double* d = &flow[2 * (static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(column))];
      // From the middle of the pixel that was predicted, which is not quite this one's.
      const auto turned_back = [&](double u, double v) {
        return PanoramaPlace(R_C_turned * PanoramaRay(u, v, width, height), width, height);
      };
      const Vec2d from = turned_back(column + 0.5, row + 0.5), to = turned_back(column + 0.5 + d[0], row + 0.5 + d[1]);
      back.insert(back.end(), {std::remainder(to.x - from.x, static_cast<double>(width)), to.y - from.y});
    }
  }
  return back;
}

}  // namespace airsim360

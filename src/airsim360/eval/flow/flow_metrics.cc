#include "airsim360/eval/flow/flow_metrics.h"

#include <cmath>
#include <limits>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/vector.h"

namespace airsim360 {
namespace {

Vec3d Direction(double x, double y, int width, int height) {
  const double theta = 2 * kPi * (x / width - 0.5), phi = kPi * (0.5 - y / height);
  return {std::cos(phi) * std::sin(theta), -std::sin(phi), std::cos(phi) * std::cos(theta)};
}

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
    sum.angle_deg += w * Angle(Direction(x + gx, y + gy, width, height), Direction(x + px, y + py, width, height));
  }
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const double n = all > 0 ? all : kNan;
  return {sum.epe / n, sum.fl_all / n, sum.within1 / n, sum.within3 / n, sum.within5 / n, panorama ? sum.angle_deg / n * 180 / kPi : kNan,
          sum.valid};
}

}  // namespace airsim360

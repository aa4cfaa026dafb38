#include "airsim360/eval/flow/flow_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

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

struct FlowPlace {
  int x, y;
};
struct FlowSize {
  int width, height;
};

// How to get back what was meant: from which pixel, exchanged or not, times what.
struct Remedy {
  const char* words;
  FlowPlace (*from)(FlowPlace p, FlowSize s);
  bool exchange;
  Vec2d (*factors)(FlowSize s);
  bool panorama_only = false;
};
constexpr auto kHere = [](FlowPlace p, FlowSize) { return p; };
constexpr auto kMirrored = [](FlowPlace p, FlowSize s) { return FlowPlace{s.width - 1 - p.x, p.y}; };
constexpr auto kUpsideDown = [](FlowPlace p, FlowSize s) { return FlowPlace{p.x, s.height - 1 - p.y}; };
constexpr auto kHalfTurn = [](FlowPlace p, FlowSize s) { return FlowPlace{(p.x + s.width / 2) % s.width, p.y}; };
constexpr auto kAsTheyAre = [](FlowSize) { return Vec2d{1, 1}; };
constexpr auto kOtherX = [](FlowSize) { return Vec2d{-1, 1}; };
constexpr auto kOtherY = [](FlowSize) { return Vec2d{1, -1}; };
constexpr Remedy kRemedies[] = {
    {"predictions point the other way: are they the flow back from the next picture, or of the other sign?", kHere, false,
     [](FlowSize) {
       return Vec2d{-1, -1};
     }},
    {"predictions fit far better with the other sign of dx: dx grows to the right", kHere, false, kOtherX},
    {"predictions fit far better with the other sign of dy: dy grows downwards", kHere, false, kOtherY},
    {"predictions fit far better when their channels are exchanged: dx comes first, then dy", kHere, true, kAsTheyAre},
    {"predictions are shares of the picture's size: multiply dx by its width and dy by its height", kHere, false,
     [](FlowSize s) {
       return Vec2d{1.0 * s.width, 1.0 * s.height};
     }},
    {"predictions are normalised to -1 ... 1: multiply dx by half the width and dy by half the height", kHere, false,
     [](FlowSize s) {
       return Vec2d{s.width / 2.0, s.height / 2.0};
     }},
    {"predictions are radians: multiply dx by width / 2 pi and dy by height / pi", kHere, false,
     [](FlowSize s) {
       return Vec2d{s.width / (2 * kPi), s.height / kPi};
     },
     true},
    {"predictions are of mirrored pictures: mirror them, and the sign of dx", kMirrored, false, kOtherX},
    {"predictions fit far better when they are mirrored: are they?", kMirrored, false, kAsTheyAre},
    {"predictions are of pictures that were upside down: turn them over, and the sign of dy", kUpsideDown, false, kOtherY},
    {"predictions fit far better when they are turned over: are they upside down?", kUpsideDown, false, kAsTheyAre},
    {"predictions fit far better when they are turned by 180 degrees: is the seam elsewhere?", kHalfTurn, false, kAsTheyAre, true},
};

double FlowMedian(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

FlowMistake LikelyFlowMistake(std::span<const double> prediction, std::span<const double> truth, int width, int height) {
  constexpr size_t kSamples = 20000, kLeastSamples = 64;
  constexpr double kChange = 0.2, kSure = 0.3, kLikely = 0.5,
                   kLeastError = 0.1;  // shares of the truth's length, of the error (twice), of the length
  const FlowSize size{width, height};
  const bool panorama = width == 2 * height;
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height), step = std::max<size_t>(1, pixels / kSamples) | 1;
  const auto apart = [&](Vec2d a, Vec2d b) {
    return std::hypot(panorama ? std::remainder(a.x - b.x, static_cast<double>(width)) : a.x - b.x, a.y - b.y);
  };
  const auto at = [width](std::span<const double> flow, FlowPlace p) {
    const size_t i = 2 * (static_cast<size_t>(p.y) * static_cast<size_t>(width) + static_cast<size_t>(p.x));
    return Vec2d{flow[i], flow[i + 1]};
  };
  double least = kLikely;
  const char* words = "";
  for (const Remedy& remedy : kRemedies) {
    if (remedy.panorama_only && !panorama) continue;
    const Vec2d factors = remedy.factors(size);
    std::vector<double> straight, mended, lengths;
    size_t all = 0;
    for (size_t i = 0; i < pixels; i += step) {
      const FlowPlace here{static_cast<int>(i % static_cast<size_t>(width)), static_cast<int>(i / static_cast<size_t>(width))};
      const Vec2d g = at(truth, here), p = at(prediction, here);
      Vec2d q = at(prediction, remedy.from(here, size));
      if (remedy.exchange) std::swap(q.x, q.y);
      q = {q.x * factors.x, q.y * factors.y};
      const double length = std::hypot(g.x, g.y);
      if (!std::isfinite(length + p.x + p.y + q.x + q.y) || length == 0) continue;
      ++all;
      if (apart(p, q) < kChange * length) continue;
      straight.push_back(apart(p, g));
      mended.push_back(apart(q, g));
      lengths.push_back(length);
    }
    if (straight.size() < kLeastSamples || 10 * straight.size() < all) continue;
    const double before = FlowMedian(straight), explained = FlowMedian(mended) / before;
    if (before < kLeastError * FlowMedian(lengths) || explained >= least) continue;
    least = explained;
    words = remedy.words;
  }
  return {words, least < kSure};
}

std::array<double, kFlowFigures.size()> Figures(const FlowErrors& e) {
  return {e.epe, e.fl_all, e.within1, e.within3, e.within5, e.angle_deg};
}

FlowErrors MeasureFlow(std::span<const double> prediction, std::span<const double> truth, int width, int height,
                       std::span<const uint32_t> source, std::span<const double> weights) {
  const size_t pixels = truth.size() / 2;
  if (prediction.size() != truth.size() || truth.size() % 2 != 0 || (!source.empty() && source.size() != pixels) ||
      (!weights.empty() && weights.size() != pixels))
    throw InputError("arrays of different length: " + std::to_string(prediction.size()) + " predictions, " + std::to_string(truth.size()) +
                     " truths");
  const bool panorama = width == 2 * height;
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

#include "airsim360/eval/depth/depth_metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/text.h"
#include "airsim360/math/median.h"

namespace airsim360 {
namespace {

struct Pixel {
  double p, g, weight;
};

std::vector<Pixel> ValidPixels(std::span<const double> prediction, std::span<const double> truth, std::span<const double> weights,
                               const DepthOptions& options) {
  if (prediction.size() != truth.size() || (!weights.empty() && weights.size() != truth.size()))
    throw InputError("arrays of different length: " + std::to_string(prediction.size()) + " predictions, " + std::to_string(truth.size()) +
                     " truths");
  std::vector<Pixel> pixels;
  pixels.reserve(truth.size());
  for (size_t i = 0; i < truth.size(); ++i) {
    const double g = truth[i];
    if (!(g > options.min_depth && g > 0 && g <= options.max_depth && std::isfinite(g))) continue;
    if (!std::isfinite(prediction[i]))
      throw InputError("the prediction of pixel " + std::to_string(i) + " is no finite number, but its truth is " + std::to_string(g) +
                       " m");
    pixels.push_back({prediction[i], g, weights.empty() ? 1 : weights[i]});
  }
  return pixels;
}

// As torch.median takes it: the lower one.
void ScaleByMedian(std::vector<Pixel>& pixels) {
  std::vector<double> p, g;
  for (const Pixel& pixel : pixels) p.push_back(pixel.p), g.push_back(pixel.g);
  const double truth = LowerMedian(g), prediction = LowerMedian(p);
  for (Pixel& pixel : pixels) pixel.p = pixel.p * truth / prediction;
}

struct Sums {
  double weight = 0, abs_rel = 0, sq_rel = 0, square = 0, log_square = 0, log = 0, abs = 0, within[3] = {0, 0, 0}, tau = 0;
  double shifted = 0, shifted_square = 0;  // of ln p - ln g - shift
  int64_t not_positive = 0;
};

Sums SumUp(const std::vector<Pixel>& pixels, bool square_by_square) {
  constexpr double kBounds[3] = {1.25, 1.25 * 1.25, 1.25 * 1.25 * 1.25}, kTau = 1.03;
  Sums s;
  // Differences of logarithms from the first one: their variance then does not cancel.
  const double shift = pixels[0].p > 0 ? std::log(pixels[0].p) - std::log(pixels[0].g) : 0;
  for (const auto& [p, g, w] : pixels) {
    const double error = g - p;
    s.weight += w;
    s.abs += w * std::abs(error);
    s.abs_rel += w * std::abs(error) / g;
    s.square += w * error * error;
    s.sq_rel += w * error * error / (square_by_square ? g * g : g);
    if (!(p > 0)) {
      ++s.not_positive;
      continue;
    }
    const double ratio = std::max(g / p, p / g), difference = std::log(p) - std::log(g);
    for (int k = 0; k < 3; ++k) s.within[k] += ratio < kBounds[k] ? w : 0;
    s.tau += ratio < kTau ? w : 0;
    s.log += w * std::abs(difference);
    s.log_square += w * difference * difference;
    s.shifted += w * (difference - shift);
    s.shifted_square += w * (difference - shift) * (difference - shift);
  }
  return s;
}

}  // namespace

void CheckDepthOptions(const DepthOptions& options) {
  if (!(options.min_depth >= 0 && options.max_depth > options.min_depth))
    throw InputError("min-depth " + ShortestText(options.min_depth) + " and max-depth " + ShortestText(options.max_depth) +
                     ": must be 0 <= min < max");
}

std::string NoDepthText(const DepthOptions& options) {
  return "no pixel has a truth above " + ShortestText(options.min_depth) + " m" +
         (std::isfinite(options.max_depth) ? " and up to " + ShortestText(options.max_depth) + " m" : "");
}

std::array<double, kDepthFigures.size()> Figures(const DepthErrors& e) {
  return {e.absrel, e.sqrel, e.rmse, e.rmselog, e.log10, e.mae, e.d1, e.d2, e.d3, e.silog, e.tau};
}

DepthErrors MeasureDepth(std::span<const double> prediction, std::span<const double> truth, std::span<const double> weights,
                         const DepthOptions& options) {
  std::vector<Pixel> pixels = ValidPixels(prediction, truth, weights, options);
  DepthErrors e;
  e.valid = static_cast<int64_t>(pixels.size());
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (pixels.empty()) return {kNan, kNan, kNan, kNan, kNan, kNan, kNan, kNan, kNan, kNan, kNan, 0, 0};
  if (options.median_scale) ScaleByMedian(pixels);
  const Sums s = SumUp(pixels, options.square_by_square);
  const auto n = static_cast<double>(e.valid);
  const double mean_shifted = s.shifted / s.weight, variance = s.shifted_square / s.weight - mean_shifted * mean_shifted;
  e.absrel = s.abs_rel / s.weight;
  e.sqrel = s.sq_rel / s.weight;
  e.rmse = std::sqrt(s.square / s.weight);
  e.mae = s.abs / s.weight;
  e.d1 = s.within[0] / s.weight;
  e.d2 = s.within[1] / s.weight;
  e.d3 = s.within[2] / s.weight;
  e.tau = s.tau / s.weight;
  e.rmselog = std::sqrt(s.log_square / s.weight);
  e.log10 = s.log / s.weight / std::numbers::ln10;
  e.silog = n > 1 ? 100 * std::sqrt(std::max(0.0, variance) * n / (n - 1)) : kNan;
  e.not_positive = s.not_positive;
  if (s.not_positive > 0) e.rmselog = e.log10 = e.silog = std::numeric_limits<double>::infinity();
  return e;
}

}  // namespace airsim360

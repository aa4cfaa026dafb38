#include "airsim360/render/filter/exposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360::internal {
namespace {

// Log luminance from -20 to 20 stops in steps of an eighth; darker pixels count as the darkest.
constexpr int kBins = 320, kPerStop = 8, kLowest = -20;
constexpr double kTrimmed = 0.1, kMost = 8;

using Counts = std::array<uint32_t, kBins>;
using Histogram = std::array<double, kBins>;

Counts CountRow(std::span<const Rgb32f> row) {
  Counts counts{};
  for (const Rgb32f& c : row) {
    const float l = scalar::luminance({c.r, c.g, c.b});
    const float stops = scalar::log2_approx(l > 1e-6f ? std::min(l, 1e6f) : 1e-6f);
    counts[static_cast<size_t>(std::clamp(static_cast<int>((stops - kLowest) * kPerStop), 0, kBins - 1))]++;
  }
  return counts;
}

/// Mean over what is left of a histogram without its ends.
double TrimmedMean(const Histogram& histogram, double total) {
  double below = 0, sum = 0, weight = 0;
  for (int i = 0; i < kBins; ++i) {
    const double w = histogram[static_cast<size_t>(i)];
    const double used = std::min(below + w, (1 - kTrimmed) * total) - std::max(below, kTrimmed * total);
    below += w;
    if (used <= 0) continue;
    sum += used * (kLowest + (i + 0.5) / kPerStop);
    weight += used;
  }
  return sum / weight;
}

}  // namespace

double AutoExposureEv(const Image<Rgb32f>& radiance, const Camera& camera, float exposure, double most) {
  const int height = radiance.height();
  std::vector<Counts> rows(static_cast<size_t>(height));
  ParallelFor(height, [&](int64_t y) { rows[static_cast<size_t>(y)] = CountRow(radiance.row(static_cast<int>(y))); });

  // Whole numbers within a row, so that its pixels' order does not matter.
  const bool panorama = std::holds_alternative<Equirectangular>(camera);
  Histogram histogram{};
  double total = 0;
  for (int y = 0; y < height; ++y) {
    const double weight = panorama ? std::cos(std::numbers::pi * (0.5 - (y + 0.5) / height)) : 1;
    for (size_t i = 0; i < kBins; ++i) histogram[i] += weight * rows[static_cast<size_t>(y)][i];
    total += weight * radiance.width();
  }
  if (histogram[0] > (1 - kTrimmed) * total || total == 0) return 0;
  const double stops = std::log2(kAutoGrey / exposure) - TrimmedMean(histogram, total);
  return std::min(std::clamp(stops, -kMost, kMost), std::log2(most / exposure));
}

}  // namespace airsim360::internal

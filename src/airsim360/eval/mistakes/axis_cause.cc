#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "airsim360/eval/mistakes/depth_pairs.h"
#include "airsim360/math/median.h"

namespace airsim360::internal {
namespace {

constexpr std::array<const char*, 3> kAxisWords = {"the depth along the axis of a cube face", "the horizontal distance",
                                                   "the depth along the axis in the middle of the picture"};

// Logarithms of the cosine between each pixel's ray and an axis.
std::vector<double> Cosines(const SampleGrid& grid, size_t axis) {
  std::vector<double> logarithms;
  for (int y = 0; y < grid.height; ++y) {
    const double phi = std::numbers::pi * (0.5 - (y + 0.5) / grid.height), level = std::cos(phi), up = std::abs(std::sin(phi));
    for (int x = 0; x < grid.width; ++x) {
      const double theta = 2 * std::numbers::pi * ((x + 0.5) / grid.width - 0.5);
      const double right = std::abs(level * std::sin(theta)), forward = std::abs(level * std::cos(theta));
      logarithms.push_back(std::log(std::max(1e-3, axis == 0 ? std::max({right, forward, up}) : axis == 1 ? level : forward)));
    }
  }
  return logarithms;
}

// Standard error of a slope where the rests are independent.
double SlopeError(const std::vector<double>& x, const std::vector<double>& y, double slope) {
  const double n = static_cast<double>(x.size());
  const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n, my = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double rest = 0, xx = 0;
  for (size_t i = 0; i < x.size(); ++i) rest += std::pow(y[i] - my - slope * (x[i] - mx), 2), xx += (x[i] - mx) * (x[i] - mx);
  return std::sqrt(rest / n / xx);
}

// In which share of the parts of the sphere the ratio follows the cosine: errors of a net that are even over a part do not.
double FollowingParts(const DepthPairs& pairs, const SampleGrid& grid, const std::vector<double>& cosine, double sign) {
  constexpr int kSectors = 8;
  std::array<std::vector<double>, kSectors> x, y;
  for (size_t i = 0; i < pairs.places.size(); ++i) {
    const int column = static_cast<int>(pairs.places[i]) % grid.width, row = static_cast<int>(pairs.places[i]) / grid.width;
    const auto part = static_cast<size_t>(column * 4 / grid.width + 4 * (row * 2 / grid.height));
    x[part].push_back(cosine[pairs.places[i]]);
    y[part].push_back(pairs.ratio[i]);
  }
  int parts = 0, follow = 0;
  for (size_t part = 0; part < kSectors; ++part) {
    if (x[part].size() < kLeastSamples) continue;
    // Outliers (edges) are drawn in.
    const double middle = UpperMedian(y[part]);
    for (double& v : y[part]) v = std::clamp(v, middle - 2, middle + 2);
    const double slope = SlopeOf(x[part], y[part]);
    // Where the cosine hardly differs, chance decides.
    if (!(SlopeError(x[part], y[part], slope) < 0.25)) continue;
    ++parts;
    follow += sign * slope > 0.6 && sign * slope < 1.5;
  }
  return parts < 3 ? 0 : static_cast<double>(follow) / parts;
}

}  // namespace

LikelyMistake AxisMistake(const DepthPairs& pairs, const SampleGrid& grid) {
  LikelyMistake best;
  double least = pairs.scaled_error;
  for (size_t axis = 0; axis < kAxisWords.size(); ++axis) {
    const std::vector<double> cosine = Cosines(grid, axis);
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> left;
      for (size_t i = 0; i < pairs.ratio.size(); ++i) left.push_back(pairs.ratio[i] - sign * cosine[pairs.places[i]]);
      const double middle = UpperMedian(left), rest = MeanDistance(left, middle);
      if (rest >= least) continue;
      const double share = FollowingParts(pairs, grid, cosine, sign);
      if (share < 0.74) continue;
      least = rest;
      best.text = std::string(sign > 0 ? "predictions" : "truths") + " follow the cosine of the ray: are they " + kAxisWords[axis] +
                  " instead of the range along the ray?";
      best.sure = share > 0.86 && rest < 0.7 * pairs.scaled_error && Agreement(left, middle) >= kNearlyAll;
    }
  }
  return best;
}

}  // namespace airsim360::internal

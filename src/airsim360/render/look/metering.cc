#include "airsim360/render/look/metering.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "airsim360/base/parallel.h"

namespace airsim360::internal {
namespace {

constexpr std::array<double, 3> kLuminance{0.2126, 0.7152, 0.0722};
constexpr int kRowsPerTask = 16;

// 0 below `low`, 1 above `high`.
double Smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// How far a camera takes the sky alone for what lights its picture, 0 … kMost: where most of it is darker than a grey of
// 0.35 under the open sky. Sunlit grey is several times brighter, and so is the sky. Some blue is left in shade, as by eye.
double ShareOfShade(const Daylight& day, const LightHistogram& picture) {
  constexpr double kGrey = 0.35, kMost = 0.7;
  return kMost * Smooth(0.4, 0.9, picture.ShareBelow(kGrey * day.sky.g / std::numbers::pi));
}

}  // namespace

LightHistogram::LightHistogram(const LightCells& light, float kept, const LightCells& scattered, float share) {
  // Whole numbers within a row; the bits of a float count octaves and, linearly, what is within.
  constexpr int kFirst = (kLowest + 127) * 16;
  using Row = std::array<std::array<uint32_t, kBins>, 3>;
  const int tasks = (light.height + kRowsPerTask - 1) / kRowsPerTask;
  std::vector<Counts> parts(static_cast<size_t>(tasks));
  const bool glare = !scattered.planes[0].empty();
  ParallelFor(tasks, [&](int64_t task) {
    Counts& sums = parts[static_cast<size_t>(task)];
    const int first = static_cast<int>(task) * kRowsPerTask;
    for (int y = first; y < std::min(first + kRowsPerTask, light.height); ++y) {
      Row row{};
      const double angle = light.CellAngle(y);
      for (size_t k = 0; k < 3; ++k) {
        const float* a = light.planes[k].data() + light.Index(0, y);
        const float* b = glare ? scattered.planes[k].data() + light.Index(0, y) : a;
        for (int x = 0; x < light.width; ++x) {
          const float value = kept * a[x] + (glare ? share * b[x] : 0);
          const int bin = static_cast<int>(std::bit_cast<uint32_t>(value) >> 19) - kFirst;
          row[k][static_cast<size_t>(std::clamp(bin, 0, kBins - 1))]++;
        }
        for (size_t i = 0; i < kBins; ++i) sums[k][i] += angle * row[k][i];
      }
    }
  });
  for (int i = 0; i < kBins; ++i) middle_[static_cast<size_t>(i)] = std::exp2(kLowest + i / 16) * (1 + (i % 16 + 0.5) / 16);
  double whole = 0;
  for (int y = 0; y < light.height; ++y) whole += light.CellAngle(y) * light.width;
  for (const Counts& part : parts) {
    for (size_t k = 0; k < 3; ++k)
      for (size_t i = 0; i < kBins; ++i) share_[k][i] += part[k][i] / whole;
  }
}

double LightHistogram::MeanEncoded(const std::vector<float>& curve, double clip, const std::array<double, 3>& scale) const {
  const double last = static_cast<double>(curve.size() - 1);
  double mean = 0;
  for (size_t k = 0; k < 3; ++k) {
    for (int i = 0; i < kBins; ++i) {
      const double share = share_[k][static_cast<size_t>(i)];
      if (share == 0) continue;
      const double at = std::sqrt(std::min(1.0, middle_[static_cast<size_t>(i)] * scale[k] / clip)) * last;
      const auto index = static_cast<size_t>(std::min(at, last - 1));
      mean += share * kLuminance[k] * (curve[index] + (curve[index + 1] - curve[index]) * (at - static_cast<double>(index)));
    }
  }
  return mean;
}

double LightHistogram::BrighterThan(double share) const {
  int bin = kBins - 1;
  for (double beyond = share_[1][static_cast<size_t>(bin)]; bin > 0 && beyond <= share;) beyond += share_[1][static_cast<size_t>(--bin)];
  return middle_[static_cast<size_t>(bin)];
}

double LightHistogram::ShareBelow(double limit) const {
  double sum = 0, all = 0;
  for (int i = 1; i < kBins; ++i) {
    const double share = share_[1][static_cast<size_t>(i)];
    all += share;
    if (middle_[static_cast<size_t>(i)] < limit) sum += share;
  }
  return all > 0 ? sum / all : 0;
}

double LightHistogram::LogMean(int channel) const {
  double sum = 0, weight = 0;
  const auto& shares = share_[static_cast<size_t>(channel)];
  for (int i = 1; i < kBins; ++i) {
    sum += shares[static_cast<size_t>(i)] * std::log(middle_[static_cast<size_t>(i)]);
    weight += shares[static_cast<size_t>(i)];
  }
  return weight > 0 ? std::exp(sum / weight) : 0;
}

std::array<double, 3> WhiteBalance(double strength, const Daylight& day, const LightHistogram& picture) {
  std::array<double, 3> gains{1, 1, 1};
  const std::array<double, 3> mean{picture.LogMean(0), picture.LogMean(1), picture.LogMean(2)};
  if (strength <= 0 || !(std::min({mean[0], mean[1], mean[2]}) > 0)) return gains;
  const double height = std::max(0.05, static_cast<double>(day.to_sun.z));
  std::array<double, 3> light{day.sun.r * height + day.sky.r, day.sun.g * height + day.sky.g, day.sun.b * height + day.sky.b};
  const bool is_day = std::min({light[0], light[1], light[2]}) > 0;
  // How far the picture is from what daylight would make of grey ground, in octaves.
  double by_day = 0;
  if (is_day) {
    const double octaves = std::log2(mean[1] / (0.18 * light[1] / std::numbers::pi));
    by_day = Smooth(-6, -3, octaves) * (1 - Smooth(2.6, 4.2, octaves));
    // Lamps of a room in the evening are as bright as what is outside, but far warmer than it makes anything.
    const double warmth = std::log2(mean[0] / mean[2] * light[2] / light[0]);
    by_day *= 1 - Smooth(1.2, 2.2, warmth);
  }
  if (by_day > 0) {
    const std::array<double, 3> sky{day.sky.r, day.sky.g, day.sky.b};
    const double shade = ShareOfShade(day, picture);
    for (size_t k = 0; k < 3; ++k)
      if (sky[k] > 0) light[k] *= std::pow(sky[k] / light[k], shade);
  }
  constexpr double kLowSun = 0.56;
  const double adapted = strength * (kLowSun + (1 - kLowSun) * Smooth(0.05, 0.42, height)) * by_day;
  const double by_mean = strength * (0.21 * by_day + 0.75 * (1 - by_day));
  for (size_t k = 0; k < 3; ++k) {
    if (is_day) gains[k] *= std::pow(light[k] / light[1], -adapted);
    gains[k] *= std::pow(mean[k] / mean[1], -by_mean);
  }
  return gains;
}

double MeterExposure(const LightHistogram& picture, const std::vector<float>& curve, double clip, const std::array<double, 3>& gains,
                     double aim, double low, double high) {
  double a = std::log2(low), b = std::log2(high);
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (a + b), k = std::exp2(middle);
    (picture.MeanEncoded(curve, clip, {gains[0] * k, gains[1] * k, gains[2] * k}) < aim ? a : b) = middle;
  }
  return std::exp2(0.5 * (a + b));
}

}  // namespace airsim360::internal

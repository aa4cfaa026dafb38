#include "airsim360/render/sky/sky_sampler.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/shared/shading_constants.h"

namespace airsim360::internal {
namespace {

constexpr int kAcross = SkySampler::kAcross, kUp = SkySampler::kUp;
constexpr float kCellSolidAngle = 2 * kTauF / (kAcross * kUp);

// Direction of grid coordinates in [0, kAcross] x [0, kUp].
Vec3f DirectionAt(float column, float row) {
  const float z = std::clamp(row * (2.0f / kUp) - 1, -1.0f, 1.0f), azimuth = column * (kTauF / kAcross);
  const float s = std::sqrt(std::max(0.0f, 1 - z * z));
  return {s * std::cos(azimuth), s * std::sin(azimuth), z};
}

// First index whose cumulative share is above u, and where in its step u lies, [0, 1).
struct Found {
  int index;
  float inside;
};
Found Find(const float* cumulative, int count, float u) {
  const int i = std::min(static_cast<int>(std::upper_bound(cumulative, cumulative + count, u) - cumulative), count - 1);
  const float below = i > 0 ? cumulative[i - 1] : 0;
  return {i, std::clamp((u - below) / std::max(cumulative[i] - below, kLeastStep), 0.0f, kBelowOne)};
}

// Running sums of `weights`, scaled to end at 1.
void Accumulate(const double* weights, int count, float* cumulative) {
  double sum = 0, all = 0;
  for (int i = 0; i < count; ++i) all += weights[i];
  for (int i = 0; i < count; ++i) cumulative[i] = static_cast<float>((sum += weights[i]) / all);
  cumulative[count - 1] = 1;
}

}  // namespace

SkySampler::SkySampler(const std::function<float(Vec3f)>& luminance) : density_(kAcross * kUp), cumulative_(kAcross * kUp), row_(kUp) {
  std::vector<double> weight(kAcross * kUp);
  ParallelFor(kUp, [&](int64_t y) {
    for (int x = 0; x < kAcross; ++x) {
      double& w = weight[static_cast<size_t>(y) * kAcross + x];
      for (int k = 0; k < 4; ++k) {
        w += 0.25 * luminance(DirectionAt(static_cast<float>(x) + 0.25f + 0.5f * static_cast<float>(k % 2),
                                          static_cast<float>(y) + 0.25f + 0.5f * static_cast<float>(k / 2)));
      }
    }
  });
  double mean = 0;
  for (const double w : weight) mean += w / (kAcross * kUp);
  const double least = mean > 0 ? 0.02 * mean : 1.0;
  double all = 0;
  for (double& w : weight) all += w += least;

  std::vector<double> rows(kUp);
  for (int y = 0; y < kUp; ++y) {
    const double* w = &weight[static_cast<size_t>(y) * kAcross];
    for (int x = 0; x < kAcross; ++x) {
      rows[y] += w[x];
      density_[static_cast<size_t>(y) * kAcross + x] = static_cast<float>(w[x] / all / kCellSolidAngle);
    }
    Accumulate(w, kAcross, &cumulative_[static_cast<size_t>(y) * kAcross]);
  }
  Accumulate(rows.data(), kUp, row_.data());
}

Vec3f SkySampler::Direction(Vec2f u) const {
  const Found row = Find(row_.data(), kUp, u.y);
  const Found column = Find(&cumulative_[static_cast<size_t>(row.index) * kAcross], kAcross, u.x);
  return DirectionAt(static_cast<float>(column.index) + column.inside, static_cast<float>(row.index) + row.inside);
}

float SkySampler::Pdf(Vec3f d) const {
  float azimuth = std::atan2(d.y, d.x);
  if (azimuth < 0) azimuth += kTauF;
  const int x = std::clamp(static_cast<int>(azimuth * (kAcross / kTauF)), 0, kAcross - 1);
  const int y = std::clamp(static_cast<int>((d.z + 1) * (0.5f * kUp)), 0, kUp - 1);
  return density_[static_cast<size_t>(y) * kAcross + x];
}

}  // namespace airsim360::internal

#include "airsim360/render/sky/cloud_shadow.h"

#include <algorithm>
#include <numeric>

#include "airsim360/base/parallel.h"
#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360::internal {
namespace {

constexpr int kSize = CloudShadowMap::kSize;
constexpr float kCell = CloudShadowMap::kWidth / kSize;

}  // namespace

CloudShadowMap::CloudShadowMap(Vec3f place, Vec3f to_sun, const std::function<float(float, float)>& light_at)
    : place_(place), texels_(static_cast<size_t>(kSize) * kSize) {
  // A very low sun's shadows would run for ever; ten degrees is as far as they are followed.
  const float z = std::max(to_sun.z, 0.17f);
  slant_x_ = to_sun.x / z, slant_y_ = to_sun.y / z;
  ParallelFor(kSize, [&](int64_t j) {
    for (int i = 0; i < kSize; ++i) {
      texels_[static_cast<size_t>(j) * kSize + i] =
          light_at((static_cast<float>(i) + 0.5f - kSize / 2) * kCell, (static_cast<float>(j) + 0.5f - kSize / 2) * kCell);
    }
  });
  mean_ = static_cast<float>(std::accumulate(texels_.begin(), texels_.end(), 0.0) / static_cast<double>(texels_.size()));
}

CloudShadowView CloudShadowMap::view() const {
  return {texels_.empty() ? nullptr : texels_.data(), kSize,     slant_x_, slant_y_, kSize / 2 - 0.5f - place_.x / kCell,
          kSize / 2 - 0.5f - place_.y / kCell,        1 / kCell, place_.z};
}

float CloudShadowMap::At(Vec3f p) const {
  if (texels_.empty()) return 1;
  const CloudShadowView v = view();
  const float x = scalar::shadow_column(p.x, p.z - v.plane_z, v.slant_x, v.origin_x, v.cells_per_metre, static_cast<float>(kSize)),
              y = scalar::shadow_column(p.y, p.z - v.plane_z, v.slant_y, v.origin_y, v.cells_per_metre, static_cast<float>(kSize));
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
  const float* t = v.texels + static_cast<size_t>(j) * kSize + i;
  const float low = t[0] + (t[1] - t[0]) * fx, high = t[kSize] + (t[kSize + 1] - t[kSize]) * fx;
  return low + (high - low) * fy;
}

}  // namespace airsim360::internal

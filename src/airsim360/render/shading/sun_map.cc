#include "airsim360/render/shading/sun_map.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/render/shading/probe_rays.h"

namespace airsim360::internal {
namespace {

constexpr float kLeastTexel = 0.05f, kNothing = -1e30f;

// Corners of a box along an axis.
void Extent(const Box3f& box, Vec3f axis, float& low, float& high) {
  low = INFINITY, high = -INFINITY;
  for (int i = 0; i < 8; ++i) {
    const float t = Dot(axis, Vec3f{(i & 1 ? box.max : box.min).x, (i & 2 ? box.max : box.min).y, (i & 4 ? box.max : box.min).z});
    low = std::min(low, t), high = std::max(high, t);
  }
}

}  // namespace

SunMap::SunMap(const RayTracer& tracer, Vec3f to_sun, int size) : size_(size), to_sun_(to_sun) {
  Box3f box = DetailBounds(tracer.scene());
  if (box.empty()) box.Add(Vec3f{});
  const Vec3f reference = std::fabs(to_sun.z) < 0.9f ? Vec3f{0, 0, 1} : Vec3f{1, 0, 0};
  right_ = Normalized(Cross(reference, to_sun));
  up_ = Cross(to_sun, right_);
  float right, above, low;
  Extent(box, right_, left_, right);
  Extent(box, up_, bottom_, above);
  Extent(tracer.scene().bounds.empty() ? box : tracer.scene().bounds, to_sun, low, top_);
  top_ += 1;
  texel_ = std::max(kLeastTexel, std::max(right - left_, above - bottom_) / static_cast<float>(size));
  heights_.assign(static_cast<size_t>(size) * size, kNothing);
  Bake(tracer);
}

// Rays against the sun's direction from above everything, in blocks of 4x4 texels.
void SunMap::Bake(const RayTracer& tracer) {
  ParallelFor(size_ / 4, [&](int64_t block_row) {
    const FlushDenormals flush;
    alignas(64) int valid[16];
    RayHit16 rays{};
    for (int i = 0; i < 16; ++i) {
      valid[i] = -1, rays.mask[i] = UINT32_MAX;
      rays.direction_x[i] = -to_sun_.x, rays.direction_y[i] = -to_sun_.y, rays.direction_z[i] = -to_sun_.z;
    }
    for (int x = 0; x < size_; x += 4) {
      const int y = static_cast<int>(block_row) * 4;
      for (int i = 0; i < 16; ++i) {
        const Vec3f p = right_ * (left_ + (static_cast<float>(x + (i & 3)) + 0.5f) * texel_) +
                        up_ * (bottom_ + (static_cast<float>(y + (i >> 2)) + 0.5f) * texel_) + to_sun_ * top_;
        rays.origin_x[i] = p.x, rays.origin_y[i] = p.y, rays.origin_z[i] = p.z;
        rays.t_far[i] = INFINITY;
      }
      tracer.Intersect16(valid, rays, true);
      for (int i = 0; i < 16; ++i) {
        if (rays.geometry[i] == kMiss) continue;
        heights_[static_cast<size_t>(y + (i >> 2)) * size_ + x + (i & 3)] = top_ - rays.t_far[i];
      }
    }
  });
}

SunMapView SunMap::view() const {
  const float scale = 1 / texel_;
  return {heights_.data(),
          size_,
          {right_.x * scale, right_.y * scale, right_.z * scale, -left_ * scale},
          {up_.x * scale, up_.y * scale, up_.z * scale, -bottom_ * scale},
          {to_sun_.x, to_sun_.y, to_sun_.z, 0},
          0.05f + 1.5f * texel_};
}

bool SunMap::Sunlit(Vec3f p) const {
  const float column = (Dot(p, right_) - left_) / texel_, row = (Dot(p, up_) - bottom_) / texel_;
  const auto last = static_cast<float>(size_ - 1);
  if (!(column > 0 && column < last && row > 0 && row < last)) return true;
  const float height = heights_[static_cast<size_t>(row) * size_ + static_cast<size_t>(column)];
  return Dot(p, to_sun_) + view().bias >= height;
}

}  // namespace airsim360::internal

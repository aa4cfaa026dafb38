// The shadows of clouds on the ground: a map of the sun's light, seen along the sun's direction.
#pragma once

#include <functional>
#include <vector>

#include "airsim360/math/vector.h"
#include "airsim360/render/shared/shading_data.h"

namespace airsim360::internal {

/// Immutable. Texels lie on the horizontal plane through `place`; another point is moved there along the
/// sun's rays.
class CloudShadowMap {
 public:
  static constexpr int kSize = 384;
  static constexpr float kWidth = 6000;  ///< metres; beyond it the nearest edge counts

  /// No shadow anywhere.
  CloudShadowMap() = default;
  /// `light_at` gives the share of sunlight left at a point of the plane, relative to `place`; the sun must
  /// stand above the horizon.
  CloudShadowMap(Vec3f place, Vec3f to_sun, const std::function<float(float, float)>& light_at);

  float At(Vec3f p) const;
  float mean() const { return mean_; }
  /// Refers to this map.
  CloudShadowView view() const;

  template <class Archive, class Self>
  static void Visit(Archive& archive, Self& s) {
    archive(s.place_, s.slant_x_, s.slant_y_, s.mean_, s.texels_);
  }

 private:
  Vec3f place_;
  float slant_x_ = 0, slant_y_ = 0, mean_ = 1;
  std::vector<float> texels_;
};

}  // namespace airsim360::internal

// Even random points: Sobol's first two dimensions, Owen-scrambled.
#pragma once

#include <algorithm>
#include <cstdint>

#include "airsim360/math/vector.h"
#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360::internal {

using scalar::hash_bits;
#define SHARED inline
#define word uint32_t
#include "airsim360/render/shared/shading_points.h"
#undef SHARED
#undef word

/// Point `index` of the (0, 2)-sequence scrambled by `seed`: any 2^k points from a multiple of 2^k on are
/// stratified in [0, 1)^2 in every way.
inline Vec2f SobolPoint(uint32_t index, uint32_t seed) {
  const uint32_t hash = hash_bits(seed);
  return {unit_of(owen_scramble(reverse_bits(index), hash)), unit_of(owen_scramble(sobol_second(index), hash_bits(hash)))};
}

/// Unit vector of a point of the unit square, areas kept.
inline Vec3f SpherePoint(Vec2f u) {
  const float z = 1 - 2 * u.x;
  const auto [x, y] = scalar::disc_place(std::sqrt(std::max(0.0f, 1 - z * z)), u.y);
  return {x, y, z};
}

/// Directions to points of the sun's disc of 0.53 degrees.
class SunDisc {
 public:
  explicit SunDisc(Vec3f to_sun) : to_sun_(to_sun) {
    const Vec3f reference = std::fabs(to_sun.z) < kUpright ? Vec3f{0, 0, 1} : Vec3f{1, 0, 0};
    right_ = Normalized(Cross(reference, to_sun)) * kSunRayRadius;
    up_ = Cross(to_sun, right_);
  }
  /// Radii, as vectors.
  Vec3f right() const { return right_; }
  Vec3f up() const { return up_; }
  /// Even over the disc for u even over the unit square.
  Vec3f At(Vec2f u) const {
    const auto [x, y] = scalar::disc_place(std::sqrt(u.x), u.y);
    return Normalized(to_sun_ + right_ * x + up_ * y);
  }

 private:
  Vec3f to_sun_, right_, up_;
};

}  // namespace airsim360::internal

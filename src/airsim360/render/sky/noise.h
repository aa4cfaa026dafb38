// Deterministic lattice noise for clouds and macro variation.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360::internal {

/// Well mixed hash of lattice coordinates.
inline uint32_t HashLattice(int32_t x, int32_t y, int32_t z) {
  auto mix = [](uint32_t h) {
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    return h ^ (h >> 16);
  };
  return mix(static_cast<uint32_t>(x) * 73856093u ^
             mix(static_cast<uint32_t>(y) * 19349663u ^ mix(static_cast<uint32_t>(z) * 83492791u + 17u)));
}
/// The same as a number in [0, 1).
inline float HashUnit(int32_t x, int32_t y, int32_t z) {
  return static_cast<float>(HashLattice(x, y, z) >> 8) * 0x1p-24f;
}

inline float SmoothStep(float a, float b, float x) {
  const float t = x <= a ? 0.0f : x >= b ? 1.0f : (x - a) / (b - a);
  return t * t * (3.0f - 2.0f * t);
}

/// Value noise in [0, 1], cells of size 1; `period` > 0 wraps the lattice.
float ValueNoise(float x, float y, int seed, int period = 0);
/// Octaves of ValueNoise, each turned and about twice as fine, weights halving; normalised to [0, 1].
float FractalNoise(float x, float y, int octaves, int seed);

/// Cube of tiling noise, kSize voxels a side, period 1: cauliflower-like Worley octaves mixed with value
/// noise.
class CloudNoise {
 public:
  CloudNoise();
  /// Trilinear, any p.
  float At(Vec3f p) const;

 private:
  static constexpr int kSize = 64;
  std::vector<float> voxels_;
};

}  // namespace airsim360::internal

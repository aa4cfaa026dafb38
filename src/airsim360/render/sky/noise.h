// Deterministic lattice noise for clouds: the same numbers on every machine.
#pragma once

#include <cstdint>
#include <vector>

#include "airsim360/math/vector.h"
#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360::internal {

/// Well mixed hash of lattice coordinates.
inline uint32_t HashLattice(int32_t x, int32_t y, int32_t z) {
  using scalar::hash_bits;
  return hash_bits(static_cast<uint32_t>(x) * 73856093u ^
                   hash_bits(static_cast<uint32_t>(y) * 19349663u ^ hash_bits(static_cast<uint32_t>(z) * 83492791u + 17u)));
}
/// The same as a number in [0, 1).
inline float HashUnit(int32_t x, int32_t y, int32_t z) { return static_cast<float>(HashLattice(x, y, z) >> 8) * 0x1p-24f; }

template <class T>
T Mix(T a, T b, float t) {
  return a + (b - a) * t;
}

inline float SmoothStep(float a, float b, float x) {
  const float t = x <= a ? 0.0f : x >= b ? 1.0f : (x - a) / (b - a);
  return t * t * (3.0f - 2.0f * t);
}

/// Largest whole number not above x, |x| < 2^31; without a call where the processor has no instruction for it.
inline int FloorToInt(float x) {
  const int i = static_cast<int>(x);
  return i - (static_cast<float>(i) > x ? 1 : 0);
}

/// Value noise in [0, 1], cells of size 1; `period` > 0 wraps the lattice.
float ValueNoise(float x, float y, int seed, int period = 0);
/// Gradient noise of the plane, about -1 … 1 with mean 0, cells of size 1; `period` > 0 wraps the lattice.
float GradientNoise(float x, float y, int period, int seed);
/// Octaves of GradientNoise, each twice as fine and half as strong; without a period each is turned, too.
float FractalNoise(float x, float y, int period, int octaves, int seed);
/// FractalNoise along one y of a lattice with a period: the same numbers in a fraction of the time for the many x of a row.
class FractalRow {
 public:
  FractalRow(float y, int period, int octaves, int seed);
  float At(float x) const;

 private:
  // GradientNoise: gradients of the lattice's rows below and above y, of the second part what it adds there.
  struct Octave {
    int period;
    float v;
    std::vector<float> along[2], across[2];
    float At(float x) const;
  };
  std::vector<Octave> octaves_;
};
/// Distance to the nearest of random points of the plane, one a cell of size 1; 0 … about 1.2.
float PointDistance(float x, float y, int period, int seed);

/// Cube of noise in [0, 1] that tiles space with period 1. Immutable.
class NoiseCube {
 public:
  /// Heaps of balls (Worley noise of three sizes: 5, 11 and 23 a side) bent by gradient noise: the shape of cumulus.
  static const NoiseCube& Billows();
  /// Balls of two finer sizes (6 and 13 a side).
  static const NoiseCube& Details();

  /// Trilinear; any p below 2^24 periods.
  float At(Vec3f p) const;

 private:
  /// Worley noise of `balls[k]` points a side with `weights[k]`, then mapped from [low, low + range] with `bend` of gradient noise.
  NoiseCube(int size, std::vector<int> balls, std::vector<float> weights, float low, float range, float bend);
  void Fill(const std::vector<int>& balls, const std::vector<float>& weights, float low, float range, float bend);

  int size_, mask_;
  std::vector<uint8_t> voxels_;  // 2 MB and less: the processor's second cache holds it
};

}  // namespace airsim360::internal

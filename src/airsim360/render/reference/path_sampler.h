// Random numbers of one path: Sobol's first two dimensions for every pair, Owen-scrambled and shuffled, so
// that the samples of a pixel are stratified in each pair and independent between pairs and pixels.
#pragma once

#include <cstdint>

#include "airsim360/base/random.h"
#include "airsim360/math/vector.h"

namespace airsim360::internal {

class PathSampler {
 public:
  /// The sequence of a pixel; the same key gives the same numbers.
  PathSampler(uint64_t seed, uint64_t pixel) : key_(MixBits(MixBits(seed) ^ (pixel * 2 + 1))) {}

  /// Pair `pair` of sample `index`, both in [0, 1).
  Vec2f Pair(uint32_t index, uint32_t pair) const {
    const uint64_t h = MixBits(key_ + pair), g = MixBits(h);
    // A shuffle that keeps every aligned power of two of samples together keeps their stratification.
    const uint32_t i = Reverse(Scramble(Reverse(index), static_cast<uint32_t>(h)));
    uint32_t y = 0;
    for (uint32_t k = i, v = 1u << 31; k != 0; k >>= 1, v ^= v >> 1) {
      if (k & 1) y ^= v;
    }
    return {Unit(Reverse(Scramble(i, static_cast<uint32_t>(g)))),
            Unit(Reverse(Scramble(Reverse(y), static_cast<uint32_t>(g >> 32))))};
  }

 private:
  static uint32_t Reverse(uint32_t x) {
    x = __builtin_bswap32(x);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
  }
  // Every bit flipped by a hash of the lower ones: Owen's scramble of the number with its bits reversed
  // (Laine & Karras 2011; constants of Burley, JCGT 9(4), 2020).
  static uint32_t Scramble(uint32_t x, uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
  }
  static float Unit(uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

  uint64_t key_;
};

}  // namespace airsim360::internal

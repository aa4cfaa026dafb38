// Random numbers of one path: Sobol's first two dimensions for every pair, Owen-scrambled and shuffled, so
// that the samples of a pixel are stratified in each pair and independent between pairs and pixels.
#pragma once

#include <cstdint>

#include "airsim360/base/random.h"
#include "airsim360/math/vector.h"
#include "airsim360/render/shading/sampling.h"

namespace airsim360::internal {

class PathSampler {
 public:
  /// The sequence of a pixel; the same key gives the same numbers.
  PathSampler(uint64_t seed, uint64_t pixel) : key_(MixBits(MixBits(seed) ^ (pixel * 2 + 1))) {}

  /// Pair `pair` of sample `index`, both in [0, 1).
  Vec2f Pair(uint32_t index, uint32_t pair) const {
    const uint64_t h = MixBits(key_ + pair), g = MixBits(h);
    // A shuffle that keeps every aligned power of two of samples together keeps their stratification.
    const uint32_t i = owen_scramble(index, static_cast<uint32_t>(h));
    return {unit_of(reverse_bits(owen_hash(i, static_cast<uint32_t>(g)))),
            unit_of(owen_scramble(sobol_second(i), static_cast<uint32_t>(g >> 32)))};
  }

 private:
  uint64_t key_;
};

}  // namespace airsim360::internal

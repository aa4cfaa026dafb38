// A hash of 32-bit words that mixes all bits.
#pragma once

namespace airsim360 {

/// Wellons's lowbias32: one-to-one, every bit of the word depends on every bit of `h`. `Word` is uint32_t or a vector of them.
/// Shaders and kernels have it as hash_bits (render/shared/shading_hash.h).
template <typename Word>
constexpr Word Scramble(Word h) {
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  return h ^ (h >> 16);
}

}  // namespace airsim360

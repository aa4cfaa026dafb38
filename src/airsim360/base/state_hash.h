// Hash of simulation state: equal numbers give equal hashes on every machine with the same arithmetic.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

#include "airsim360/base/random.h"

namespace airsim360 {

/// Order-dependent mixing of 64-bit words.
class StateHasher {
 public:
  void Add(uint64_t bits) { hash_ = MixBits(hash_ ^ bits) + 0x9e3779b97f4a7c15ull; }
  void Add(int64_t value) { Add(static_cast<uint64_t>(value)); }
  void Add(uint32_t value) { Add(uint64_t{value}); }
  void Add(bool value) { Add(uint64_t{value}); }
  void Add(double value) { Add(std::bit_cast<uint64_t>(value)); }
  /// A vector: anything with x, y and z.
  template <class V>
  requires requires(V v) { v.x, v.y, v.z; }
  void Add(const V& v) {
    if constexpr (requires { v.w; }) Add(static_cast<double>(v.w));
    Add(static_cast<double>(v.x));
    Add(static_cast<double>(v.y));
    Add(static_cast<double>(v.z));
  }
  uint64_t hash() const { return hash_; }

 private:
  uint64_t hash_ = 0;
};

}  // namespace airsim360

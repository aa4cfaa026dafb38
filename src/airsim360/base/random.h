// Keyed random streams: the same key gives the same numbers on every machine and with any number of threads.
#pragma once

#include <cstdint>
#include <string_view>

namespace airsim360 {

/// SplitMix64 finaliser (Steele, Lea, Flood 2014): a bijection of 64-bit integers with good avalanche.
constexpr uint64_t MixBits(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// FNV-1a of a name, for stream keys.
constexpr uint64_t HashName(std::string_view name) {
  uint64_t h = 0xcbf29ce484222325ull;
  for (char c : name) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return h;
}

/// A stream of pseudo-random numbers determined by (seed, name, id) alone. Copyable; copies continue
/// independently.
class RngStream {
 public:
  RngStream(uint64_t seed, std::string_view name, uint64_t id = 0) : state_(MixBits(MixBits(seed ^ HashName(name)) + id)) {}

  /// Uniform over all 64-bit integers (SplitMix64).
  uint64_t Bits() {
    const uint64_t out = MixBits(state_);
    state_ += 0x9e3779b97f4a7c15ull;
    return out;
  }
  /// Uniform in [0, 1), 53 bits.
  double Uniform() { return static_cast<double>(Bits() >> 11) * 0x1p-53; }
  /// Uniform in [low, high).
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  /// Uniform over {0, …, n - 1}; n > 0.
  uint32_t Index(uint32_t n) { return static_cast<uint32_t>((static_cast<unsigned __int128>(Bits()) * n) >> 64); }
  /// True with probability p.
  bool Chance(double p) { return Uniform() < p; }
  /// Normal with mean 0 and standard deviation 1 (Box-Muller, one value per call).
  double Normal();

 private:
  uint64_t state_;
};

}  // namespace airsim360

// sRGB transfer function (IEC 61966-2-1).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace airsim360 {

/// Linear light of an sRGB value, both in [0, 1].
inline double SrgbDecode(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }

/// Linear light in [0, 1] of an 8-bit sRGB value.
inline float SrgbToLinear(uint8_t value) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (int i = 0; i < 256; ++i) t[i] = static_cast<float>(SrgbDecode(i / 255.0));
    return t;
  }();
  return table[value];
}

/// 8-bit sRGB value nearest to linear light; clamps to [0, 1].
inline uint8_t LinearToSrgb8(float linear) {
  const double c = linear < 0 ? 0 : linear > 1 ? 1 : static_cast<double>(linear);
  const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return static_cast<uint8_t>(s * 255.0 + 0.5);
}

/// LinearToSrgb8 by table, some ten times faster, for whole pictures.
class SrgbEncoder {
 public:
  SrgbEncoder() {
    // Where the rounded value steps from k to k + 1.
    for (int k = 0; k < 255; ++k) step_[k] = static_cast<float>(SrgbDecode((k + 0.5) / 255.0));
    for (int i = 0; i <= kGuesses; ++i) guess_[i] = LinearToSrgb8(static_cast<float>(i) / kGuesses);
  }
  uint8_t operator()(float linear) const {
    const float c = linear > 0 ? (linear < 1 ? linear : 1.0f) : 0.0f;
    int k = guess_[static_cast<int>(c * kGuesses)];
    while (k < 255 && c >= step_[k]) ++k;
    while (k > 0 && c < step_[k - 1]) --k;
    return static_cast<uint8_t>(k);
  }

 private:
  static constexpr int kGuesses = 4096;
  float step_[255];
  uint8_t guess_[kGuesses + 1];
};

}  // namespace airsim360

// Colours of pictures that are painted once, as 8-bit sRGB.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "airsim360/image/color.h"

namespace airsim360::internal {

/// LinearToSrgb8 by table, to the very bit: SrgbEncoder is not, where a value lies on the border of two codes.
class SrgbCodes {
 public:
  SrgbCodes() {
    for (int k = 0; k < 255; ++k) {
      float& step = step_[k] = static_cast<float>(SrgbDecode((k + 0.5) / 255));
      while (LinearToSrgb8(step) <= k) step = std::nextafter(step, 2.0f);
      while (LinearToSrgb8(std::nextafter(step, -1.0f)) > k) step = std::nextafter(step, -1.0f);
    }
    for (int i = 0; i <= kGuesses; ++i) guess_[i] = LinearToSrgb8(static_cast<float>(i) / kGuesses);
  }
  uint8_t operator()(float linear) const {
    const float c = linear > 0 ? std::min(linear, 1.0f) : 0.0f;
    int k = guess_[static_cast<int>(c * kGuesses)];
    while (k < 255 && c >= step_[k]) ++k;
    while (k > 0 && c < step_[k - 1]) --k;
    return static_cast<uint8_t>(k);
  }

 private:
  static constexpr int kGuesses = 4096;
  float step_[255];  // the least value of code k + 1
  uint8_t guess_[kGuesses + 1];
};

}  // namespace airsim360::internal

// Colours of pictures that are painted once, as 8-bit sRGB.
#pragma once

#include <bit>
#include <cstdint>

#include "airsim360/image/color.h"

namespace airsim360::internal {

/// LinearToSrgb8 by table, to the very bit: SrgbEncoder's steps are rounded to floats, so a value that is one of them is asked for
/// itself.
class SrgbCodes {
 public:
  uint8_t operator()(float linear) const {
    const uint8_t code = encode_(linear);
    const float before = std::bit_cast<float>(std::bit_cast<uint32_t>(linear) - 1);
    return linear > 0 && encode_(before) != code ? LinearToSrgb8(linear) : code;
  }

 private:
  SrgbEncoder encode_;
};

}  // namespace airsim360::internal

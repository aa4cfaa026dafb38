// Colours of mesh vertices.
#pragma once

#include <cmath>
#include <cstdint>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// Linear light and coverage in steps of 1/65535, so that sources of 8 and of 16 bits a channel are kept exactly.
/// White by default.
struct VertexColor {
  uint16_t r = 65535, g = 65535, b = 65535, a = 65535;
  bool operator==(const VertexColor&) const = default;
};

/// The nearest colour; channels beyond [0, 1] are clamped, those that are no numbers are 0.
inline VertexColor MakeVertexColor(Vec3f linear, float alpha = 1) {
  const auto channel = [](float x) { return static_cast<uint16_t>(x > 0 ? std::lround((x < 1 ? x : 1.0f) * 65535.0f) : 0); };
  return {channel(linear.x), channel(linear.y), channel(linear.z), channel(alpha)};
}

/// Red, green and blue, each in [0, 1]; 65535 gives 1 to the bit.
inline Vec3f LinearColor(VertexColor c) {
  constexpr float kStep = 1.0f / 65535.0f;
  return {static_cast<float>(c.r) * kStep, static_cast<float>(c.g) * kStep, static_cast<float>(c.b) * kStep};
}

}  // namespace airsim360

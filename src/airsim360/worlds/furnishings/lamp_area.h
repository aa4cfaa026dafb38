// Areas of lamp surfaces, from which their luminance follows.
#pragma once

#include <cmath>
#include <numbers>
#include <span>

#include "airsim360/math/vector.h"

namespace airsim360::internal {

/// Area of a surface of revolution with the profile (radius, height): cone frusta (Pappus).
inline float LatheArea(std::span<const Vec2f> profile) {
  float area = 0;
  for (size_t i = 0; i + 1 < profile.size(); ++i)
    area += std::numbers::pi_v<float> * (profile[i].x + profile[i + 1].x) *
            std::hypot(profile[i + 1].x - profile[i].x, profile[i + 1].y - profile[i].y);
  return area;
}

}  // namespace airsim360::internal

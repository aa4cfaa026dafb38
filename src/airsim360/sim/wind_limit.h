// How strong a wind can be set, for every way to set one.
#pragma once

#include <cstdio>

#include "airsim360/base/error.h"
#include "airsim360/math/vector.h"

namespace airsim360 {

inline constexpr double kStrongestWind = 200;  ///< m/s

/// InputError naming the wind, its strength and the nearest of the same direction. `wind` is in the caller's frame.
inline void CheckWind(Vec3d wind) {
  const double strength = Norm(wind);
  if (strength <= kStrongestWind) return;
  const Vec3d nearest = wind * (kStrongestWind / strength);
  char text[240];
  std::snprintf(text, sizeof text, "wind: (%g, %g, %g) is %g m/s, more than %g; the nearest is (%g, %g, %g)", wind.x, wind.y, wind.z,
                strength, kStrongestWind, nearest.x, nearest.y, nearest.z);
  throw InputError(text);
}

}  // namespace airsim360

// The curved earth under clouds.
#pragma once

#include <cmath>

#include "airsim360/math/vector.h"

namespace airsim360::internal {

inline constexpr float kEarthRadius = 6.371e6f;

/// Metres along a ray of sine `z` >= 0 from the ground to an altitude.
inline float DistanceToAltitude(float z, float altitude) {
  const float b = kEarthRadius * z;
  return (2 * kEarthRadius + altitude) * altitude / (b + std::sqrt(b * b + (2 * kEarthRadius + altitude) * altitude));
}

/// Altitude of a point given relative to the observer on the ground; right to a metre up to 300 km.
inline float AltitudeOf(Vec3f p) { return p.z + (p.x * p.x + p.y * p.y) * (0.5f / (kEarthRadius + p.z)); }

}  // namespace airsim360::internal

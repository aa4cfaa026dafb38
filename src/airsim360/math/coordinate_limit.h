// How far from the origin anything may be put: the one bound of every position that comes from outside.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/math/vector.h"

namespace airsim360 {

/// Metres along each axis of W, of N or of a body. Files, command lines, wires and bindings refuse what is
/// beyond, so that nothing computed from it leaves the range in which rays can be traced (RayTracer).
inline constexpr double kCoordinateLimit = 1e7;

inline bool IsWithinLimit(Vec3d p) {
  return std::abs(p.x) <= kCoordinateLimit && std::abs(p.y) <= kCoordinateLimit && std::abs(p.z) <= kCoordinateLimit;
}

/// "1e+30 is not in -1e+07 … 1e+07"
inline std::string BeyondLimitText(double value, double limit = kCoordinateLimit) {
  char text[96];
  std::snprintf(text, sizeof text, "%g is not in %g … %g", value, -limit, limit);
  return text;
}

/// InputError "`what`: 1e+30 is not in …" unless the place is within the limit.
inline Vec3d CheckedPlace(const std::string& what, Vec3d p) {
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(p[i]) <= kCoordinateLimit)) throw InputError(what + ": " + BeyondLimitText(p[i]) + " metres");
  }
  return p;
}

}  // namespace airsim360

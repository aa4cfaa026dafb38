// What kernels look for in waypoints and durations. Included by kernels only.
#pragma once

#include "airsim360/planning/splines/spline_kernel.h"
#include "airsim360/planning/splines/spline_lanes.h"

namespace airsim360::internal::AIRSIM360_ISA {

/// Error grows with the fourth to fifth power of such ratios; see docs/internals/trajectories.md.
constexpr double kSingleRatio = 16, kDoubleRatio = kEvenRatio;

AIRSIM360_INLINE bool UnevenHere(double a, double b, double c) {
  const double low = a < b ? a : b, high = a < b ? b : a, right = b < c ? c : b;
  return (high > kSingleRatio * low) | (a > kDoubleRatio * right) | (c > kDoubleRatio * high);
}

AIRSIM360_INLINE bool Extreme(double least, double largest) { return (least < kShortestDuration) | (largest > kLongestDuration); }

/// Points [n][3] to [n][4], the fourth zero; whether all are finite. Whole vectors are written, for the
/// solvers read them so: narrower stores would not be forwarded.
AIRSIM360_INLINE bool Pad(const double* points, size_t n, double* out) {
  V4 sum = {};
  for (size_t i = 0; i < n; ++i) {
    const double* const p = points + 3 * i;
    // Beyond the last point nothing may be read.
    const V4 point = i + 1 < n ? __builtin_shufflevector(Load4(p), V4{}, 0, 1, 2, 7) : V4{p[0], p[1], p[2], 0};
    sum += point - point;
    Store4(point, out + 4 * i);
  }
  return sum[0] + sum[1] + sum[2] == 0;
}

}  // namespace airsim360::internal::AIRSIM360_ISA

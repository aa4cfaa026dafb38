// Upper bounds of squared speed and acceleration on every segment of a path, from Bernstein control values.
#pragma once

#include <cstddef>

#include "airsim360/base/kernel_isa.h"

namespace airsim360::internal {

/// Control values of |v|^2 (degree 12 or 8) and |a|^2 (degree 10 or 6) in SI units, eight segments at a time.
struct HullArguments {
  const double* coefficients;  ///< [segment][3][powers]
  const double* durations;
  size_t segments;
  int powers;                     ///< 8 or 6
  double* speed_bounds;           ///< [segments rounded up to 8]: of |v|^2, rounding included
  double* acceleration_bounds;    ///< of |a|^2
  double* speed_controls;         ///< [group of 8][13][8]
  double* acceleration_controls;  ///< [group of 8][11][8]
};

constexpr size_t kSpeedControls = 13, kAccelerationControls = 11;

struct HullKernels {
  void (*hulls)(const HullArguments&);
};

}  // namespace airsim360::internal

AIRSIM360_DECLARE_KERNEL(extern const HullKernels kHullKernels)

// How much a path exceeds its limits, smoothed: a power sum over samples, with its derivatives.
#pragma once

#include <cstddef>

#include "airsim360/base/kernel_isa.h"

namespace airsim360::internal {

struct ExcessArguments {
  const double* coefficients;  ///< [segment][3][powers]
  const double* durations;
  size_t segments;
  int powers;            ///< 8 or 6
  const double* basis;   ///< [samples][16]: k tau^(k-1) for k = 0..7, then k (k-1) tau^(k-2)
  size_t samples;        ///< per segment
  int squarings;         ///< exponent q = 2^squarings, at least 2
  double inverse_speed;  ///< 1 / (limit^2)
  double inverse_acceleration;
  double weight;           ///< of a sample per second of its segment
  double* by_coefficient;  ///< out, like coefficients
  double* by_duration;     ///< out: at fixed coefficients
};

/// sum over samples of weight T ((|v| / v_max)^(2 q) + (|a| / a_max)^q).
struct ExcessKernels {
  double (*excess)(const ExcessArguments&);
};

}  // namespace airsim360::internal

AIRSIM360_DECLARE_KERNEL(extern const ExcessKernels kExcessKernels)

// How much a path exceeds its limits, smoothed: a power sum over samples, with its derivatives.
#pragma once

#include <cstddef>

#include "airsim360/base/kernel_isa.h"

namespace airsim360::internal {

struct ExcessArguments {
  const double* coefficients;  ///< [segment][3][powers]
  const double* durations;
  size_t segments;
  int powers;  ///< 8 or 6
  /// [samples / share][16][1 for share 1, else 8]: k tau^(k-1) for k = 0..7, then k (k-1) tau^(k-2); eight
  /// lanes hold the number of each share's sample 8 / share times
  const double* basis;
  size_t samples;        ///< per segment
  size_t share = 1;      ///< lanes that share the samples of a segment: ExcessShare or 1
  int squarings;         ///< exponent q = 2^squarings, at least 2
  double inverse_speed;  ///< 1 / (limit^2)
  double inverse_acceleration;
  /// Squares of |v| / v_max and |a| / a_max below these count as these: their powers would not be normal
  /// numbers, with which processors are a hundred times slower.
  double least_speed = 0, least_acceleration = 0;
  double weight;           ///< of a sample per second of its segment
  double* by_coefficient;  ///< out, like coefficients
  double* by_duration;     ///< out: at fixed coefficients
};

/// Few segments would leave lanes empty.
constexpr size_t ExcessShare(size_t segments, size_t samples) {
  const size_t share = segments <= 2 ? 4 : segments <= 4 ? 2 : 1;
  return samples % share == 0 ? share : 1;
}

/// Numbers of the basis for each `share` samples.
constexpr size_t ExcessBasisSize(size_t share) { return share == 1 ? 16 : 16 * 8; }

/// sum over samples of weight T ((|v| / v_max)^(2 q) + (|a| / a_max)^q).
struct ExcessKernels {
  double (*excess)(const ExcessArguments&);
};

}  // namespace airsim360::internal

AIRSIM360_DECLARE_KERNEL(extern const ExcessKernels kExcessKernels)

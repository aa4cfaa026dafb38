// Length of the way of a flight.
#pragma once

#include <cmath>

#include "airsim360/planning/splines/polynomial_trajectory.h"

namespace airsim360 {

/// Metres along the path: the integral of the speed by Gauss-Legendre quadrature (8 parts a segment, 5 points
/// each; relative error below 1e-6 for smooth flights).
inline double ArcLength(const PolynomialTrajectory& path) {
  constexpr int kParts = 8;
  constexpr double kPoints[] = {0, 0.5384693101056831, 0.9061798459386640};  // on [-1, 1], DLMF 3.5.27
  constexpr double kWeights[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  double length = 0;
  for (size_t s = 0; s < path.segments(); ++s) {
    const double half = path.durations()[s] / (2 * kParts);
    for (int k = 0; k < kParts; ++k) {
      const double middle = path.start(s) + (2 * k + 1) * half;
      length += half * kWeights[0] * Norm(path.At(middle).v);
      for (int i = 1; i < 3; ++i) {
        const double d = half * kPoints[i];
        length += half * kWeights[i] * (Norm(path.At(middle - d).v) + Norm(path.At(middle + d).v));
      }
    }
  }
  return length;
}

}  // namespace airsim360

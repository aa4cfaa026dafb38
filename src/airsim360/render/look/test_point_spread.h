// For tests: the analytic point-spread function of the lens.
#pragma once

#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/render/look/scatter.h"

namespace airsim360::internal {

/// Legendre series of the symbol in scatter.h, damped, and with the first order of the damping taken out.
inline double PointSpread(double angle_deg, double theta) {
  const double a2 = std::pow(angle_deg * kDegree, 2), x = std::cos(theta);
  const auto series = [&](double damping) {
    double p0 = 1, p1 = x, sum = 1;
    const int most = static_cast<int>(5 / damping);
    for (int l = 1; l < most; ++l) {
      const double f = 1 / (1 + std::pow(a2 * l * (l + 1.0), kScatterExponent));
      sum += (2 * l + 1) * f * std::exp(-0.5 * damping * damping * l * (l + 1.0)) * p1;
      const double p2 = ((2 * l + 1) * x * p1 - l * p0) / (l + 1);
      p0 = p1, p1 = p2;
    }
    return sum / (4 * kPi);
  };
  constexpr double kDamping = 0.1 * kDegree;
  return (4 * series(kDamping) - series(2 * kDamping)) / 3;
}

}  // namespace airsim360::internal

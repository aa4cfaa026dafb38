// Polynomials about another point.
#pragma once

#include <span>

namespace airsim360 {

/// Rewrites ascending powers of t as ascending powers of t - shift (repeated synthetic division).
inline void ShiftPolynomial(std::span<double> c, double shift) {
  for (size_t k = 0; k + 1 < c.size(); ++k) {
    for (size_t i = c.size() - 1; i-- > k;) c[i] += shift * c[i + 1];
  }
}

}  // namespace airsim360

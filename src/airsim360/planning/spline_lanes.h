// SIMD vectors of the spline kernels and the moves between them and memory. Included by kernels only.
#pragma once

#include <cstddef>

#include "airsim360/planning/spline_filter.h"

namespace airsim360::internal::AIRSIM360_ISA {

typedef double V4 __attribute__((vector_size(32)));
typedef double V8 __attribute__((vector_size(64)));
typedef double V2Memory __attribute__((vector_size(16), aligned(8), may_alias));
typedef double V4Memory __attribute__((vector_size(32), aligned(8), may_alias));
typedef double V8Memory __attribute__((vector_size(64), aligned(8), may_alias));

AIRSIM360_INLINE V4 Load4(const double* p) { return *reinterpret_cast<const V4Memory*>(p); }
AIRSIM360_INLINE V8 Load8(const double* p) { return *reinterpret_cast<const V8Memory*>(p); }
AIRSIM360_INLINE void Store8(V8 v, double* p) { *reinterpret_cast<V8Memory*>(p) = v; }
AIRSIM360_INLINE V8 Join(V4 low, V4 high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
AIRSIM360_INLINE V8 Join(double low, double high) { return V8{low, low, low, low, high, high, high, high}; }
/// Lanes 0 to 3 of one and 4 to 7 of the other.
AIRSIM360_INLINE V8 Halves(V8 low, V8 high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 12, 13, 14, 15);
}

AIRSIM360_INLINE void Transpose4(V4& a, V4& b, V4& c, V4& d) {
  const V4 ab_low = __builtin_shufflevector(a, b, 0, 4, 2, 6),
           ab_high = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const V4 cd_low = __builtin_shufflevector(c, d, 0, 4, 2, 6),
           cd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// Writes kPowers coefficients for each lane of a half: c[power] has a lane per destination.
template <int kPowers>
AIRSIM360_INLINE void StoreHalf(const V8* c, int half, double* const* out, int lanes) {
  V4 low[4], high[4];
  AIRSIM360_UNROLL
  for (int i = 0; i < 4; ++i) {
    const V8 second = i + 4 < kPowers ? c[i + 4] : V8{};
    low[i] = half == 0 ? __builtin_shufflevector(c[i], c[i], 0, 1, 2, 3)
                       : __builtin_shufflevector(c[i], c[i], 4, 5, 6, 7);
    high[i] = half == 0 ? __builtin_shufflevector(second, second, 0, 1, 2, 3)
                        : __builtin_shufflevector(second, second, 4, 5, 6, 7);
  }
  Transpose4(low[0], low[1], low[2], low[3]);
  Transpose4(high[0], high[1], high[2], high[3]);
  AIRSIM360_UNROLL
  for (int lane = 0; lane < lanes; ++lane) {
    *reinterpret_cast<V4Memory*>(out[lane]) = low[lane];
    if constexpr (kPowers == 8) {
      *reinterpret_cast<V4Memory*>(out[lane] + 4) = high[lane];
    } else {
      *reinterpret_cast<V2Memory*>(out[lane] + 4) = __builtin_shufflevector(high[lane], high[lane], 0, 1);
    }
  }
}

/// x = A^-1 b in place, A symmetric positive definite of n <= D rows in packed form, for several b.
template <int D, int A, class V>
AIRSIM360_INLINE void SolveSymmetric(const V* a, int n, V (*b)[D]) {
  V l[D][D], inverse[D];
  AIRSIM360_UNROLL
  for (int j = 0; j < n; ++j) {
    V d = a[Packed(j + 1, j + 1, D)];
    AIRSIM360_UNROLL
    for (int k = 0; k < j; ++k) d -= l[k][j] * l[j][k];
    inverse[j] = 1.0 / d;
    AIRSIM360_UNROLL
    for (int i = j + 1; i < n; ++i) {
      V sum = a[Packed(j + 1, i + 1, D)];
      AIRSIM360_UNROLL
      for (int k = 0; k < j; ++k) sum -= l[k][i] * l[j][k];
      l[j][i] = sum;               // upper: not yet divided by the pivot
      l[i][j] = sum * inverse[j];  // lower
    }
  }
  AIRSIM360_UNROLL
  for (int axis = 0; axis < A; ++axis) {
    V* x = b[axis];
    AIRSIM360_UNROLL
    for (int i = 0; i < n; ++i) {
      AIRSIM360_UNROLL
      for (int k = 0; k < i; ++k) x[i] -= l[i][k] * x[k];
    }
    AIRSIM360_UNROLL
    for (int i = n; i-- > 0;) {
      x[i] *= inverse[i];
      AIRSIM360_UNROLL
      for (int k = i + 1; k < n; ++k) x[i] -= l[k][i] * x[k];
    }
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA

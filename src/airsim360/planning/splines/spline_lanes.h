// SIMD vectors of the spline kernels and the moves between them and memory. Included by kernels only.
#pragma once

#include <cstddef>

#include "airsim360/planning/splines/spline_filter.h"

namespace airsim360::internal::AIRSIM360_ISA {

typedef double V2 __attribute__((vector_size(16)));
typedef double V4 __attribute__((vector_size(32)));
typedef double V2Memory __attribute__((vector_size(16), aligned(8), may_alias));
typedef double V4Memory __attribute__((vector_size(32), aligned(8), may_alias));

AIRSIM360_INLINE V2 Load2(const double* p) { return *reinterpret_cast<const V2Memory*>(p); }
AIRSIM360_INLINE V4 Load4(const double* p) { return *reinterpret_cast<const V4Memory*>(p); }
AIRSIM360_INLINE void Store4(V4 v, double* p) { *reinterpret_cast<V4Memory*>(p) = v; }
AIRSIM360_INLINE V4 Splat4(double x) { return V4{x, x, x, x}; }

#ifdef __AVX512F__
typedef double V8 __attribute__((vector_size(64)));
typedef double V8Memory __attribute__((vector_size(64), aligned(8), may_alias));

AIRSIM360_INLINE V8 Join(V4 low, V4 high) { return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7); }
AIRSIM360_INLINE V4 Low(V8 v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); }
AIRSIM360_INLINE V4 High(V8 v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); }
AIRSIM360_INLINE V8 Load8(const double* p) { return *reinterpret_cast<const V8Memory*>(p); }
AIRSIM360_INLINE void Store8(V8 v, double* p) { *reinterpret_cast<V8Memory*>(p) = v; }
AIRSIM360_INLINE V8 Larger(V8 a, V8 b) { return a > b ? a : b; }

/// Row i, lane j becomes row j, lane i.
AIRSIM360_INLINE void Transpose8(V8* row) {
  V8 pair[8], four[8];
  AIRSIM360_UNROLL
  for (int i = 0; i < 8; i += 2) {
    pair[i] = __builtin_shufflevector(row[i], row[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    pair[i + 1] = __builtin_shufflevector(row[i], row[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  // four[0 .. 3]: rows 0 to 3 of lanes (0, 4), (2, 6), (1, 5), (3, 7), two by two; four[4 .. 7]: rows 4 to 7.
  AIRSIM360_UNROLL
  for (int i = 0; i < 8; i += 4) {
    AIRSIM360_UNROLL
    for (int odd = 0; odd < 2; ++odd) {
      const V8 a = pair[i + odd], b = pair[i + 2 + odd];
      four[i + 2 * odd] = __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13);
      four[i + 2 * odd + 1] = __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15);
    }
  }
  AIRSIM360_UNROLL
  for (int i = 0; i < 4; ++i) {
    const int lane = (i & 1) * 2 + (i >> 1);
    row[lane] = __builtin_shufflevector(four[i], four[i + 4], 0, 1, 4, 5, 8, 9, 12, 13);
    row[lane + 4] = __builtin_shufflevector(four[i], four[i + 4], 2, 3, 6, 7, 10, 11, 14, 15);
  }
}
#else
/// Two vectors of four: GCC splits vectors longer than the machine's by way of memory.
struct V8 {
  V4 low, high;

  AIRSIM360_INLINE double operator[](int lane) const { return lane < 4 ? low[lane] : high[lane - 4]; }
  AIRSIM360_INLINE V8 operator-() const { return {-low, -high}; }
  AIRSIM360_INLINE V8& operator+=(V8 b) { return *this = *this + b; }
  AIRSIM360_INLINE V8& operator-=(V8 b) { return *this = *this - b; }
  AIRSIM360_INLINE V8& operator*=(V8 b) { return *this = *this * b; }
  AIRSIM360_INLINE V8& operator+=(double b) { return *this = *this + b; }
  AIRSIM360_INLINE V8& operator*=(double b) { return *this = *this * b; }
  AIRSIM360_INLINE friend V8 operator+(V8 a, V8 b) { return {a.low + b.low, a.high + b.high}; }
  AIRSIM360_INLINE friend V8 operator-(V8 a, V8 b) { return {a.low - b.low, a.high - b.high}; }
  AIRSIM360_INLINE friend V8 operator*(V8 a, V8 b) { return {a.low * b.low, a.high * b.high}; }
  AIRSIM360_INLINE friend V8 operator+(V8 a, double b) { return {a.low + b, a.high + b}; }
  AIRSIM360_INLINE friend V8 operator-(V8 a, double b) { return {a.low - b, a.high - b}; }
  AIRSIM360_INLINE friend V8 operator*(V8 a, double b) { return {a.low * b, a.high * b}; }
  AIRSIM360_INLINE friend V8 operator*(double a, V8 b) { return b * a; }
  AIRSIM360_INLINE friend V8 operator/(double a, V8 b) { return {a / b.low, a / b.high}; }
};

AIRSIM360_INLINE V8 Join(V4 low, V4 high) { return {low, high}; }
AIRSIM360_INLINE V4 Low(V8 v) { return v.low; }
AIRSIM360_INLINE V4 High(V8 v) { return v.high; }
AIRSIM360_INLINE V8 Load8(const double* p) { return {Load4(p), Load4(p + 4)}; }
AIRSIM360_INLINE void Store8(V8 v, double* p) {
  Store4(v.low, p);
  Store4(v.high, p + 4);
}
AIRSIM360_INLINE V8 Larger(V8 a, V8 b) { return {a.low > b.low ? a.low : b.low, a.high > b.high ? a.high : b.high}; }
#endif

AIRSIM360_INLINE void Transpose4(V4& a, V4& b, V4& c, V4& d) {
  const V4 ab_low = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_high = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const V4 cd_low = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// Writes kPowers coefficients for each of the first lanes: c[power] has a lane per destination. `scale`:
/// times these factors of powers 0 to 3 and 4 to 7.
template <int kPowers>
AIRSIM360_INLINE void StorePowers(const V4* c, double* const* out, int lanes, const V4* scale = nullptr) {
  V4 low[4], high[4];
  AIRSIM360_UNROLL
  for (int i = 0; i < 4; ++i) {
    low[i] = c[i];
    high[i] = i + 4 < kPowers ? c[i + 4] : V4{};
  }
  Transpose4(low[0], low[1], low[2], low[3]);
  Transpose4(high[0], high[1], high[2], high[3]);
  AIRSIM360_UNROLL
  for (int lane = 0; lane < lanes; ++lane) {
    if (scale != nullptr) {
      low[lane] *= scale[0];
      high[lane] *= scale[1];
    }
    Store4(low[lane], out[lane]);
    if constexpr (kPowers == 8) {
      Store4(high[lane], out[lane] + 4);
    } else {
      *reinterpret_cast<V2Memory*>(out[lane] + 4) = __builtin_shufflevector(high[lane], high[lane], 0, 1);
    }
  }
}

/// x = A^-1 b in place, A symmetric positive definite of n <= D <= 3 rows in packed form, for several b. By
/// cofactors, which give and take scaling of rows and columns and need but one division.
template <int D, int A, class M, class V>
AIRSIM360_INLINE void SolveSymmetric(const M* a, int n, V (*b)[D]) {
  if constexpr (D == 3) {
    if (n == 3) {
      const M c11 = a[3] * a[5] - a[4] * a[4], c12 = a[2] * a[4] - a[1] * a[5], c13 = a[1] * a[4] - a[2] * a[3];
      const M c22 = a[0] * a[5] - a[2] * a[2], c23 = a[1] * a[2] - a[0] * a[4], c33 = a[0] * a[3] - a[1] * a[1];
      const M inverse = 1.0 / (a[0] * c11 + (a[1] * c12 + a[2] * c13));
      AIRSIM360_UNROLL
      for (int axis = 0; axis < A; ++axis) {
        V* const x = b[axis];
        const V b1 = x[0], b2 = x[1], b3 = x[2];
        x[0] = (b1 * c11 + (b2 * c12 + b3 * c13)) * inverse;
        x[1] = (b1 * c12 + (b2 * c22 + b3 * c23)) * inverse;
        x[2] = (b1 * c13 + (b2 * c23 + b3 * c33)) * inverse;
      }
      return;
    }
  }
  const M a22 = a[Packed(2, 2, D)], inverse = 1.0 / (n == 1 ? a[0] : a[0] * a22 - a[1] * a[1]);
  AIRSIM360_UNROLL
  for (int axis = 0; axis < A; ++axis) {
    V* const x = b[axis];
    const V b1 = x[0], b2 = x[1];
    x[0] = (n == 1 ? b1 : b1 * a22 - b2 * a[1]) * inverse;
    if (n > 1) x[1] = (b2 * a[0] - b1 * a[1]) * inverse;
  }
}

/// One forward step: fills the record of a segment, moves the belief to its end.
template <class Model, class V, int A>
AIRSIM360_INLINE void Step(const V* delta, SegmentRecord<V, A, Model::kStates>& record, KnotBelief<V, A, Model::kStates>& belief) {
  record.start = belief;
  StepCovariance<double, Model>(record, belief);
  const V zero[A] = {};
  StepMean<double, Model>(zero, delta, record, belief);
}

/// The same for a first segment, whose start has known derivatives of zero, but for the highest where that is
/// free. The record does not keep the belief there.
template <class Model, class V, int A>
AIRSIM360_INLINE void StepFromRest(bool free_start, const V* delta, SegmentRecord<V, A, Model::kStates>& record,
                                   KnotBelief<V, A, Model::kStates>& belief) {
  if (free_start) {
    StepFreeCovariance<double, Model>(record, belief);
  } else {
    StepKnownCovariance<Model>(record, belief);
  }
  AIRSIM360_UNROLL
  for (int axis = 0; axis < A; ++axis) {
    record.innovation[axis] = delta[axis];
    AIRSIM360_UNROLL
    for (int i = 0; i < Model::kStates; ++i) belief.mean[axis][i] = record.gain[i] * delta[axis];
  }
}

/// Multiplies c[k] by factor^k.
template <int kPowers, class V>
AIRSIM360_INLINE void ScalePowers(V factor, V* c) {
  V power = factor;
  AIRSIM360_UNROLL
  for (int k = 1; k < kPowers; ++k) {
    c[k] *= power;
    if (k + 1 < kPowers) power *= factor;
  }
}

/// Moves the highest coefficient so that the polynomial, evaluated at the end of its duration by Horner's
/// scheme, gives the waypoint there: rounding of the others would show as a gap at the end of a route.
template <int kPowers, class V>
AIRSIM360_INLINE void CloseGap(V duration, V inverse, V to, V* c) {
  V value = c[kPowers - 1], power = inverse;
  AIRSIM360_UNROLL
  for (int k = kPowers - 2; k >= 0; --k) {
    value = value * duration + c[k];
    if (k > 0) power *= inverse;
  }
  c[kPowers - 1] += (to - value) * power;
}

}  // namespace airsim360::internal::AIRSIM360_ISA

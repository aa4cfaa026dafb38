#include "airsim360/planning/splines/hull_kernel.h"

#include "airsim360/planning/splines/spline_lanes.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

AIRSIM360_INLINE constexpr double Choose(int n, int k) { return Factorial<double>(n) / (Factorial<double>(k) * Factorial<double>(n - k)); }

/// h: power coefficients 0 to n of one axis, replaced by binomial(n, i) times the Bernstein control value i:
/// sum over k of binomial(n - k, i - k) h_k, by additions alone: Q_m = (1 + x) Q_(m-1) + h_m x^m.
template <int n>
AIRSIM360_INLINE void ToScaledBernstein(V8* h) {
  AIRSIM360_UNROLL
  for (int m = 1; m <= n; ++m) {
    AIRSIM360_UNROLL
    for (int i = m; i >= 1; --i) h[i] += h[i - 1];
  }
}

/// Control values of the squared norm of three polynomials of degree n, times unit; returns their largest
/// with an allowance for rounding.
template <int n>
AIRSIM360_INLINE V8 SquaredNormControls(V8 (*h)[8], V8 unit, double* controls) {
  V8 q[2 * n + 1] = {}, magnitude = {};
  AIRSIM360_UNROLL
  for (int axis = 0; axis < 3; ++axis) {
    ToScaledBernstein<n>(h[axis]);
    V8 largest = {};
    AIRSIM360_UNROLL
    for (int i = 0; i <= n; ++i) {
      const V8 control = h[axis][i] * (1 / Choose(n, i));
      largest = Larger(largest, control * control);
      q[2 * i] += h[axis][i] * h[axis][i];
      const V8 twice = h[axis][i] + h[axis][i];
      AIRSIM360_UNROLL
      for (int j = i + 1; j <= n; ++j) q[i + j] += twice * h[axis][j];
    }
    magnitude += largest;
  }
  V8 bound = {};
  AIRSIM360_UNROLL
  for (int k = 0; k <= 2 * n; ++k) {
    const V8 control = q[k] * (1 / Choose(2 * n, k)) * unit;
    Store8(control, controls + 8 * k);
    bound = Larger(bound, control);
  }
  // Every control value is a mean of at most 3 (n + 1) products below the largest, each with a few roundings.
  return bound + magnitude * unit * 0x1p-46;
}

template <int kPowers>
void Hulls(const HullArguments& args) {
  constexpr int n = kPowers - 1;
  for (size_t first = 0; first < args.segments; first += 8) {
    alignas(64) double inverses[8], terms[3][n][8];
    for (size_t lane = 0; lane < 8; ++lane) {
      const size_t segment = first + lane < args.segments ? first + lane : args.segments - 1;
      const double duration = args.durations[segment];
      inverses[lane] = 1 / duration;
      for (size_t axis = 0; axis < 3; ++axis) {
        const double* const c = args.coefficients + (3 * segment + axis) * kPowers;
        double power = duration;
        for (size_t k = 1; k < kPowers; ++k, power *= duration) terms[axis][k - 1][lane] = c[k] * power;
      }
    }
    V8 v[3][8] = {}, a[3][8] = {};
    for (int axis = 0; axis < 3; ++axis) {
      AIRSIM360_UNROLL
      for (int k = 1; k <= n; ++k) {
        v[axis][k - 1] = Load8(terms[axis][k - 1]) * static_cast<double>(k);
        if (k > 1) a[axis][k - 2] = v[axis][k - 1] * static_cast<double>(k - 1);
      }
    }
    const V8 inverse = Load8(inverses), inverse2 = inverse * inverse;
    const size_t group = first / 8;
    Store8(SquaredNormControls<n - 1>(v, inverse2, args.speed_controls + group * 8 * kSpeedControls), args.speed_bounds + first);
    Store8(SquaredNormControls<n - 2>(a, inverse2 * inverse2, args.acceleration_controls + group * 8 * kAccelerationControls),
           args.acceleration_bounds + first);
  }
}

void AllHulls(const HullArguments& arguments) { arguments.powers == 8 ? Hulls<8>(arguments) : Hulls<6>(arguments); }

}  // namespace

const HullKernels kHullKernels = {AllHulls};

}  // namespace airsim360::internal::AIRSIM360_ISA

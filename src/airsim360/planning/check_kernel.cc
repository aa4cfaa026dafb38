#include "airsim360/planning/spline_kernel.h"
#include "airsim360/planning/spline_lanes.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

typedef long long I8 __attribute__((vector_size(64)));

/// Error grows with the fourth to fifth power of such ratios; see docs/trajectories.md.
constexpr double kSingleRatio = 16, kDoubleRatio = 8;

bool AnyLane(I8 mask) {
  long long any = 0;
  for (int lane = 0; lane < 8; ++lane) any |= mask[lane];
  return any != 0;
}

/// Whether three neighbouring durations are uneven; all bits of a lane if so.
AIRSIM360_INLINE I8 Uneven(V8 a, V8 b, V8 c) {
  const V8 low = a < b ? a : b, high = a < b ? b : a, right = b < c ? c : b;
  return (high > kSingleRatio * low) | (a > kDoubleRatio * right) | (c > kDoubleRatio * high);
}

/// x - x is zero for finite numbers and NaN for others.
bool AllFinite(const double* x, size_t n) {
  V8 sum[2] = {};
  size_t i = 0;
  for (; i + 16 <= n; i += 16) {
    const V8 a = Load8(x + i), b = Load8(x + i + 8);
    sum[0] += a - a;
    sum[1] += b - b;
  }
  bool finite = i == 0 || !AnyLane((sum[0] + sum[1]) != V8{});
  for (; i < n; ++i) finite &= x[i] - x[i] == 0;
  return finite;
}

bool AllPositive(const double* x, size_t n) {
  I8 bad = {};
  size_t i = 0;
  for (; i + 8 <= n; i += 8) bad |= ~(Load8(x + i) > V8{});
  bool positive = i == 0 || !AnyLane(bad);
  for (; i < n; ++i) positive &= x[i] > 0;
  return positive;
}

AIRSIM360_INLINE bool UnevenHere(double a, double b, double c) {
  const double low = a < b ? a : b, high = a < b ? b : a, right = b < c ? c : b;
  return (high > kSingleRatio * low) | (a > kDoubleRatio * right) | (c > kDoubleRatio * high);
}

bool AnyUneven(const double* durations, size_t n) {
  if (n < 2) return false;
  I8 mask = {};
  size_t i = 0;
  for (; i + 10 <= n; i += 8) {
    mask |= Uneven(Load8(durations + i), Load8(durations + i + 1), Load8(durations + i + 2));
  }
  bool uneven = i > 0 && AnyLane(mask);
  for (; i + 2 < n; ++i) uneven |= UnevenHere(durations[i], durations[i + 1], durations[i + 2]);
  return uneven || UnevenHere(durations[n - 2], durations[n - 1], durations[n - 1]);
}

/// Whole vectors are written, for the solvers read them so: narrower stores would not be forwarded.
bool PadPoints(const double* points, size_t n, double* out) {
  V4 sum = {};
  for (size_t i = 0; i < n; ++i) {
    const double* const p = points + 3 * i;
    // Beyond the last point nothing may be read.
    const V4 point =
        i + 1 < n ? __builtin_shufflevector(Load4(p), V4{}, 0, 1, 2, 4) : V4{p[0], p[1], p[2], 0};
    sum += point - point;
    *reinterpret_cast<V4Memory*>(out + 4 * i) = point;
  }
  return sum[0] + sum[1] + sum[2] == 0;
}

DurationCheck CopyDurations(const double* durations, size_t n, double* out) {
  constexpr size_t kShort = 16;  // calls would cost more than the work
  if (n >= kShort) {
    __builtin_memcpy(out, durations, n * sizeof(double));
    return {AllFinite(durations, n) && AllPositive(durations, n), AnyUneven(durations, n)};
  }
  bool valid = true, uneven = false;
  for (size_t i = 0; i < n; ++i) {
    const double duration = durations[i];
    valid &= (duration > 0) & (duration - duration == 0);
    if (i > 0) uneven |= UnevenHere(durations[i - 1], duration, durations[i + 1 < n ? i + 1 : i]);
    out[i] = duration;
  }
  return {valid, uneven};
}

}  // namespace

const CheckKernels kCheckKernels = {AllFinite, AllPositive, AnyUneven, PadPoints, CopyDurations};

}  // namespace airsim360::internal::AIRSIM360_ISA

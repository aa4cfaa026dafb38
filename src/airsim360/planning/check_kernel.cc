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
  V8 rest = {};
  for (; i < n; ++i) rest[i % 8] += x[i] - x[i];
  return !AnyLane((sum[0] + sum[1] + rest) != V8{});
}

bool AllPositive(const double* x, size_t n) {
  I8 bad = {};
  size_t i = 0;
  for (; i + 8 <= n; i += 8) bad |= ~(Load8(x + i) > V8{});
  bool positive = !AnyLane(bad);
  for (; i < n; ++i) positive &= x[i] > 0;
  return positive;
}

bool AnyUneven(const double* durations, size_t n) {
  if (n < 2) return false;
  I8 uneven = {};
  size_t i = 0;
  for (; i + 10 <= n; i += 8) {
    uneven |= Uneven(Load8(durations + i), Load8(durations + i + 1), Load8(durations + i + 2));
  }
  V8 a = V8{} + 1, b = a, c = a;
  for (size_t lane = 0; i + 1 < n; ++i, ++lane) {
    a[lane] = durations[i];
    b[lane] = durations[i + 1];
    c[lane] = i + 2 < n ? durations[i + 2] : durations[i + 1];
  }
  return AnyLane(uneven | Uneven(a, b, c));
}

}  // namespace

const CheckKernels kCheckKernels = {AllFinite, AllPositive, AnyUneven};

}  // namespace airsim360::internal::AIRSIM360_ISA

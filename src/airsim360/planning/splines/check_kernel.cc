#include "airsim360/planning/splines/number_check.h"
#include "airsim360/planning/splines/spline_kernel.h"
#include "airsim360/planning/splines/spline_lanes.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

typedef long long I4 __attribute__((vector_size(32)));

bool AnyLane(I4 mask) {
  long long any = 0;
  for (int lane = 0; lane < 4; ++lane) any |= mask[lane];
  return any != 0;
}

/// Whether three neighbouring durations are uneven; all bits of a lane if so.
AIRSIM360_INLINE I4 Uneven(V4 a, V4 b, V4 c) {
  const V4 low = a < b ? a : b, high = a < b ? b : a, right = b < c ? c : b;
  return (high > kSingleRatio * low) | (a > kDoubleRatio * right) | (c > kDoubleRatio * high);
}

/// x - x is zero for finite numbers and NaN for others.
bool AllFinite(const double* x, size_t n) {
  V4 sum[2] = {};
  size_t i = 0;
  for (; i + 8 <= n; i += 8) {
    const V4 a = Load4(x + i), b = Load4(x + i + 4);
    sum[0] += a - a;
    sum[1] += b - b;
  }
  bool finite = i == 0 || !AnyLane((sum[0] + sum[1]) != V4{});
  for (; i < n; ++i) finite &= x[i] - x[i] == 0;
  return finite;
}

bool AnyUneven(const double* durations, size_t n) {
  if (n < 2) return false;
  I4 mask = {};
  size_t i = 0;
  for (; i + 6 <= n; i += 4) {
    mask |= Uneven(Load4(durations + i), Load4(durations + i + 1), Load4(durations + i + 2));
  }
  bool uneven = i > 0 && AnyLane(mask);
  for (; i + 2 < n; ++i) uneven |= UnevenHere(durations[i], durations[i + 1], durations[i + 2]);
  return uneven || UnevenHere(durations[n - 2], durations[n - 1], durations[n - 1]);
}

bool PadPoints(const double* points, size_t n, double* out) { return Pad(points, n, out); }

/// Most routes are even altogether, which least and largest duration tell.
NumberCheck CopyDurations(const double* durations, size_t n, double* out) {
  double least = durations[0], largest = durations[0];
  bool valid = true;
  size_t i = 0;
  if (n >= 8) {
    V4 low = Load4(durations), high = low;
    I4 bad = {};
    for (; i + 4 <= n; i += 4) {
      const V4 duration = Load4(durations + i);
      Store4(duration, out + i);
      low = duration < low ? duration : low;
      high = duration > high ? duration : high;
      bad |= ~(duration > V4{});
    }
    valid = !AnyLane(bad);
    for (int lane = 0; lane < 4; ++lane) {
      least = low[lane] < least ? low[lane] : least;
      largest = high[lane] > largest ? high[lane] : largest;
    }
  }
  for (; i < n; ++i) {
    const double duration = durations[i];
    out[i] = duration;
    valid &= duration > 0;
    least = duration < least ? duration : least;
    largest = duration > largest ? duration : largest;
  }
  valid &= largest - largest == 0;
  const bool uneven = !(largest <= kDoubleRatio * least) && AnyUneven(durations, n);
  return {valid, uneven || Extreme(least, largest)};
}

}  // namespace

const CheckKernels kCheckKernels = {AllFinite, AnyUneven, PadPoints, CopyDurations};

}  // namespace airsim360::internal::AIRSIM360_ISA

// Clocks of the benchmarks.
#pragma once

#include <ctime>

namespace airsim360 {

/// Seconds of a clock: CLOCK_MONOTONIC, or processor time, CLOCK_PROCESS_CPUTIME_ID of all threads,
/// CLOCK_THREAD_CPUTIME_ID of this one.
inline double SecondsOf(clockid_t clock) {
  timespec now;
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace airsim360

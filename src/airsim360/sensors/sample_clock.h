// When a sensor with a rate gives its next sample.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace airsim360 {

/// Number of the last sample at or before t: sample 0 is at t = 0.
inline int64_t SampleIndex(double rate_hz, int64_t t_ns) { return t_ns / std::max<int64_t>(1, std::llround(1e9 / rate_hz)); }

/// Whether a step of dt that ends at t brings a new sample. Rates above 1 / dt give one a step.
inline bool SampleDue(double rate_hz, int64_t t_ns, int64_t dt_ns) {
  return SampleIndex(rate_hz, t_ns) != SampleIndex(rate_hz, t_ns - dt_ns);
}

/// Seconds that a sample at t averages over: since the one before, or a period for the first.
inline double SampleLength(double rate_hz, int64_t t_ns, int64_t last_ns) {
  return t_ns > last_ns && last_ns > 0 ? static_cast<double>(t_ns - last_ns) * 1e-9 : 1 / rate_hz;
}

}  // namespace airsim360

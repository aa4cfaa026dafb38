// A clock for what waits and reports. The simulation has its own time.
#pragma once

#include <chrono>

namespace airsim360 {

/// Seconds of a clock that never goes back, since a moment of the machine's own.
inline double SteadySeconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace airsim360

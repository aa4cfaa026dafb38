// Real time: a client of the loop that keeps simulated time beside the wall clock. The only place here that
// knows of a wall clock; nothing it measures reaches the state.
#pragma once

#include <atomic>

#include "airsim360/sim/sim_loop.h"

namespace airsim360 {

struct PaceReport {
  double simulated = 0;         ///< seconds
  double elapsed = 0;           ///< seconds of wall time while not paused
  double lost = 0;              ///< seconds of wall time given up because the machine was too slow
  double real_time_factor = 0;  ///< simulated / elapsed
};

class RealTimePacer {
 public:
  /// `speed` simulated seconds a second, > 0; 0 = as fast as the machine can. InputError for less.
  RealTimePacer(SimLoop& loop, double speed);

  /// Advances the loop in slices of a few milliseconds until simulated time `until_ns` or Stop; waits while
  /// paused. Falls behind by at most a tenth of a second: what is lost then is not caught up with.
  void Run(int64_t until_ns);
  /// From any thread.
  void Stop() { stop_ = true; }
  PaceReport report() const;

 private:
  SimLoop& loop_;
  double speed_;
  std::atomic<bool> stop_ = false;
  std::atomic<int64_t> simulated_ns_ = 0;
  std::atomic<double> elapsed_ = 0, lost_ = 0;
};

}  // namespace airsim360

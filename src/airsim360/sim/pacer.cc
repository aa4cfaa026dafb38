#include "airsim360/sim/pacer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int64_t kSliceNs = 5'000'000;  // simulated at a time
constexpr double kMostBehind = 0.1;      // seconds of wall time
constexpr auto kPausedWait = std::chrono::milliseconds(2);

double Seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

}  // namespace

RealTimePacer::RealTimePacer(SimLoop& loop, double speed) : loop_(loop), speed_(speed) {
  if (!(speed >= 0 && std::isfinite(speed)))
    throw InputError("speed of the simulation: " + std::to_string(speed) + " is not a number of 0 or more");
}

void RealTimePacer::Run(int64_t until_ns) {
  const int64_t dt_ns = loop_.model().dt_ns;
  const int64_t slice = std::max<int64_t>(1, kSliceNs / dt_ns);
  Clock::time_point last = Clock::now();
  double ahead = 0;  // seconds of wall time that simulated time is ahead of it
  while (!stop_ && loop_.t_ns() < until_ns) {
    const int64_t left = (until_ns - loop_.t_ns() + dt_ns - 1) / dt_ns;
    const int64_t steps = loop_.AdvanceUnlessPaused(std::min(slice, left));
    if (steps == 0) {
      std::this_thread::sleep_for(kPausedWait);
      last = Clock::now();
      continue;
    }
    const double simulated = static_cast<double>(steps * dt_ns) * 1e-9;
    simulated_ns_ += steps * dt_ns;
    if (speed_ > 0) {
      ahead += simulated / speed_ - Seconds(Clock::now() - last);
      const Clock::time_point before = last;
      last = Clock::now();
      if (ahead > 0) {
        std::this_thread::sleep_for(std::chrono::duration<double>(ahead));
        ahead -= Seconds(Clock::now() - last);
        last = Clock::now();
      } else if (ahead < -kMostBehind) {
        lost_ = lost_ - ahead - kMostBehind;
        ahead = -kMostBehind;
      }
      elapsed_ = elapsed_ + Seconds(last - before);
    } else {
      const Clock::time_point now = Clock::now();
      elapsed_ = elapsed_ + Seconds(now - last);
      last = now;
    }
  }
}

PaceReport RealTimePacer::report() const {
  const double elapsed = elapsed_, simulated = static_cast<double>(simulated_ns_) * 1e-9;
  return {simulated, elapsed, lost_, elapsed > 0 ? simulated / elapsed : 0};
}

}  // namespace airsim360

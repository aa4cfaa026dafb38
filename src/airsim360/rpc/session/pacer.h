// How many steps are due: by the wall clock, by what calls have asked for, or none.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "airsim360/rpc/wire/reply.h"

namespace airsim360 {

inline constexpr int64_t kFrameNs = 20'000'000;  ///< what simContinueForFrames counts: AirSim's command period

class Pacer {
 public:
  using Clock = std::chrono::steady_clock;

  /// `speed`: simulated seconds in one of the wall clock's. In lockstep time passes in Continue alone.
  Pacer(bool lockstep, double speed) : lockstep_(lockstep), speed_(speed), paused_(lockstep) {}

  /// Also ends a Continue; its replies are answered.
  void Pause(bool paused, int64_t t_ns);
  bool paused() const { return paused_; }
  /// Goes on until `t_ns` + `duration_ns`, then pauses; the reply is answered then.
  void Continue(int64_t t_ns, int64_t duration_ns, const Reply& reply);

  /// Simulated time up to which steps may run now; t_ns itself if none is due.
  int64_t Due(int64_t t_ns);
  /// When the next step will be due; nullopt while nothing moves by itself.
  std::optional<Clock::time_point> NextDue(int64_t t_ns, int64_t dt_ns) const;
  /// Ends a Continue whose time has come: its replies, to be answered.
  std::vector<Reply> Reached(int64_t t_ns);
  /// Simulated over asked-for speed in the last seconds: 1 when the machine keeps up.
  double real_time_factor() const { return factor_; }

 private:
  void Restart(int64_t t_ns);
  void Measure(int64_t t_ns, Clock::time_point now);

  bool lockstep_;
  double speed_;
  bool paused_;
  int64_t until_ns_ = -1;  // of a Continue
  std::vector<Reply> waiting_;
  Clock::time_point wall_start_{};
  int64_t sim_start_ns_ = 0;
  bool running_ = false;
  // Keeping up.
  Clock::time_point measured_{};
  int64_t measured_ns_ = 0;
  double factor_ = 1;
};

}  // namespace airsim360

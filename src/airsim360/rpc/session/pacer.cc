#include "airsim360/rpc/session/pacer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "airsim360/base/log.h"

namespace airsim360 {
namespace {

constexpr int64_t kMostBehindNs = 250'000'000;  // of simulated time: more is not made up for
constexpr double kMeasureSeconds = 5, kSlowFactor = 0.98;

}  // namespace

void Pacer::Restart(int64_t t_ns) {
  wall_start_ = measured_ = Clock::now();
  sim_start_ns_ = measured_ns_ = t_ns;
  running_ = true;
}

void Pacer::Pause(bool paused, int64_t t_ns) {
  until_ns_ = -1;
  for (const Reply& reply : waiting_) reply.Nil();
  waiting_.clear();
  if (paused_ == paused) return;
  paused_ = paused;
  if (!paused) Restart(t_ns);
}

void Pacer::Continue(int64_t t_ns, int64_t duration_ns, const Reply& reply) {
  until_ns_ = t_ns + duration_ns;
  waiting_.push_back(reply);
  paused_ = false;
  Restart(t_ns);
}

int64_t Pacer::Due(int64_t t_ns) {
  if (paused_) return t_ns;
  if (lockstep_) return std::max(until_ns_, t_ns);
  if (!running_) Restart(t_ns);
  const auto now = Clock::now();
  const double wall = std::chrono::duration<double>(now - wall_start_).count();
  int64_t due = sim_start_ns_ + static_cast<int64_t>(wall * speed_ * 1e9);
  // What cannot be kept up with is given up, so that the drone does not race afterwards.
  if (due - t_ns > kMostBehindNs) {
    const int64_t lost = due - t_ns - kMostBehindNs;
    sim_start_ns_ -= lost;
    due -= lost;
  }
  Measure(t_ns, now);
  return until_ns_ >= 0 ? std::min(due, until_ns_) : due;
}

void Pacer::Measure(int64_t t_ns, Clock::time_point now) {
  const double wall = std::chrono::duration<double>(now - measured_).count();
  if (wall < kMeasureSeconds) return;
  factor_ = static_cast<double>(t_ns - measured_ns_) * 1e-9 / (wall * speed_);
  measured_ = now;
  measured_ns_ = t_ns;
  if (factor_ >= kSlowFactor) return;
  char text[120];
  std::snprintf(text, sizeof text, "the simulation does not keep up: real-time factor %.2f", factor_ * speed_);
  LogWarning(text);
}

std::optional<Pacer::Clock::time_point> Pacer::NextDue(int64_t t_ns, int64_t dt_ns) const {
  if (paused_ || lockstep_ || !running_) return std::nullopt;
  const double ahead = static_cast<double>(t_ns + dt_ns - sim_start_ns_) * 1e-9 / speed_;
  return wall_start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(ahead));
}

std::vector<Reply> Pacer::Reached(int64_t t_ns) {
  if (until_ns_ < 0 || t_ns < until_ns_) return {};
  until_ns_ = -1;
  paused_ = true;
  return std::exchange(waiting_, {});
}

}  // namespace airsim360

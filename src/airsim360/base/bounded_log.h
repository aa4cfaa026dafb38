// Warnings that somebody outside can cause as often as he likes.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

namespace airsim360 {

/// Writes the first warnings of each period and counts the others, which the next period's first line tells of. Thread-safe.
class BoundedLog {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr size_t kLines = 5;
  static constexpr std::chrono::seconds kPeriod{10};

  void Warn(std::string_view message);
  /// What Warn writes at `now`; "" = nothing.
  std::string LineAt(std::string_view message, Clock::time_point now);

 private:
  std::mutex mutex_;  // of what follows
  Clock::time_point start_{};
  size_t written_ = 0, left_out_ = 0;
};

}  // namespace airsim360

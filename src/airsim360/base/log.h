// Messages and progress for people: stderr only, so that stdout stays machine-readable.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace airsim360 {

/// One line on stderr.
void LogInfo(std::string_view message);
void LogWarning(std::string_view message);

/// Where stderr is no terminal, what takes long is told in a line each time this has passed.
inline constexpr std::chrono::milliseconds kLogPeriod{5000};

namespace internal {
class ProgressTicker;
}

/// How far work has come: on a terminal a bar with the time left, elsewhere lines such as "collect: 37/100,
/// 1:02 left" each `period`; nothing for what is over sooner.
class ProgressBar {
 public:
  ProgressBar(std::string label, int64_t total, std::chrono::milliseconds period = kLogPeriod);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  /// Shows that `done` of the total is finished. Any thread, one at a time.
  void Update(int64_t done);

 private:
  std::unique_ptr<internal::ProgressTicker> ticker_;
};

/// Work of unknown length while the object lives: "building city_park: 15 s" each `period`, on a terminal
/// too.
class LongTask {
 public:
  explicit LongTask(std::string what, std::chrono::milliseconds period = kLogPeriod);
  ~LongTask();
  LongTask(const LongTask&) = delete;
  LongTask& operator=(const LongTask&) = delete;
  /// Since its beginning.
  double seconds() const;

 private:
  std::unique_ptr<internal::ProgressTicker> ticker_;
};

/// "3:07", "1:02:07": for people.
std::string ClockText(double seconds);

}  // namespace airsim360

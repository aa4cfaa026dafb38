// Messages and progress for people: stderr only, so that stdout stays machine-readable.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace airsim360 {

/// One line on stderr.
void LogInfo(std::string_view message);
void LogWarning(std::string_view message);

/// A bar with the time left on stderr, only when stderr is a terminal; silent otherwise.
class ProgressBar {
 public:
  ProgressBar(std::string label, int64_t total);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  /// Shows that `done` of the total is finished.
  void Update(int64_t done);

 private:
  std::string label_;
  int64_t total_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace airsim360

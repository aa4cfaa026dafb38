// Commands that serve until they are interrupted.
#pragma once

#include <chrono>

namespace airsim360 {

/// While it lives SIGINT and SIGTERM end Wait() and nothing else, whichever thread they come to. One at a time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Returns when one of them has come, or Stop() was called.
  void Wait() const;
  /// From any thread.
  void Stop() const;
};

/// What an action or a picture has to end in when a server is stopped.
constexpr std::chrono::milliseconds kLastJob{800};

/// From now on the process has that long to end by itself; then it ends with status 0, whatever still runs. For what
/// cannot be stopped in the middle, as a picture. To be called once what is kept is on the disk.
void EndWithin(std::chrono::milliseconds time);

}  // namespace airsim360

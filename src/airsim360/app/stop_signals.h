// Commands that serve until they are interrupted.
#pragma once

#include <chrono>
#include <csignal>

namespace airsim360 {

/// Holds back SIGINT and SIGTERM while it lives, so that they end Wait() and nothing else. Made before the threads
/// of a server, which inherit that.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Returns when one of them has come.
  void Wait() const;

 private:
  sigset_t signals_;
};

/// From now on the process has that long to end by itself; then it ends with status 0, whatever still runs. For what
/// cannot be stopped in the middle, as a picture. To be called once what is kept is on the disk.
void EndWithin(std::chrono::milliseconds time);

}  // namespace airsim360

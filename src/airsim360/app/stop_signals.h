// Commands that serve until they are interrupted.
#pragma once

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

}  // namespace airsim360

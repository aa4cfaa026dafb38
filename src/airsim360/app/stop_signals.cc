#include "airsim360/app/stop_signals.h"

#include <cstdlib>
#include <thread>

#include "airsim360/base/log.h"

namespace airsim360 {

StopSignals::StopSignals() {
  sigemptyset(&signals_);
  for (const int signal : {SIGINT, SIGTERM}) sigaddset(&signals_, signal);
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
}

StopSignals::~StopSignals() { pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr); }

void StopSignals::Wait() const {
  int signal = 0;
  sigwait(&signals_, &signal);
  LogInfo("stopping");
}

void EndWithin(std::chrono::milliseconds time) {
  std::thread([time] {
    std::this_thread::sleep_for(time);
    LogInfo("stopped in the middle of a job");
    std::_Exit(EXIT_SUCCESS);
  }).detach();
}

}  // namespace airsim360

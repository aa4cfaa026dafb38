#include "airsim360/app/stop_signals.h"

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

}  // namespace airsim360

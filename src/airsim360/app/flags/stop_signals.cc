#include "airsim360/app/flags/stop_signals.h"

#include <semaphore.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "airsim360/base/log.h"

namespace airsim360 {

namespace {

// Signals that have come. A handler may do little more than post to it (signal-safety(7)).
sem_t came;

void Note(int) { sem_post(&came); }

void HandleWith(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

}  // namespace

StopSignals::StopSignals() {
  sem_init(&came, 0, 0);
  HandleWith(Note);
}

StopSignals::~StopSignals() { HandleWith(SIG_DFL); }

void StopSignals::Stop() const { sem_post(&came); }

void StopSignals::Wait() const {
  while (sem_wait(&came) != 0 && errno == EINTR) {
  }
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

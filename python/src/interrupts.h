// Ctrl-C in calls that take long: Python notes a signal at once, and acts on it when it is asked to.
#pragma once

#include <atomic>
#include <chrono>
#include <future>

#include "airsim360/render/frame/interruption.h"
#include "airsim360/sim/sim_loop.h"
#include "convert.h"

namespace airsim360::python {

inline constexpr std::chrono::milliseconds kBetweenLooks{50};

/// For a loop that does not hold the GIL.
class SignalWatch {
 public:
  /// Throws what a signal's handler raised (KeyboardInterrupt); looks no more often than pays.
  void Look() {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < kBetweenLooks) return;
    last_ = now;
    const py::gil_scoped_acquire hold;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// As SimLoop::Advance; stops between two steps when a signal comes. Without the GIL.
inline void AdvanceWatched(SimLoop& loop, int64_t steps) {
  constexpr int64_t kSlice = 4;  // steps of many drones and people take milliseconds
  SignalWatch watch;
  for (; steps > 0; steps -= kSlice) {
    loop.Advance(std::min(kSlice, steps));
    watch.Look();
  }
}

/// What `take` returns, a picture of so many pixels. It is given up when a signal comes (InterruptibleScope says how soon). Without
/// the GIL.
template <class Take>
auto TakeWatched(int64_t pixels, const Take& take) -> decltype(take()) {
  constexpr int64_t kSoonDone = int64_t{512} * 1024;  // fewer are not worth a thread
  if (pixels < kSoonDone) return take();
  std::atomic<bool> wanted = true;
  auto picture = std::async(std::launch::async, [&] {
    const InterruptibleScope scope(wanted);
    return take();
  });
  SignalWatch watch;
  try {
    while (picture.wait_for(kBetweenLooks) != std::future_status::ready) watch.Look();
  } catch (...) {
    wanted = false;
    picture.wait();
    throw;
  }
  return picture.get();
}

}  // namespace airsim360::python

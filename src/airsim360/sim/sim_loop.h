// The owner of a running simulation: commands go in from any thread, snapshots come out.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "airsim360/sim/recording.h"
#include "airsim360/sim/step.h"

namespace airsim360 {

/// All functions may be called from any thread; only Advance and Restore change the state, one at a time.
class SimLoop {
 public:
  /// Begins with `start`, or with StartState(*model).
  explicit SimLoop(std::shared_ptr<const SimModel> model);
  SimLoop(std::shared_ptr<const SimModel> model, SimState start);

  const SimModel& model() const { return *model_; }
  const std::shared_ptr<const SimModel>& shared_model() const { return model_; }

  /// Is applied at the beginning of the next step, after those posted before. InputError at once for what
  /// Step would refuse with one.
  void Post(SimCommand command);
  /// Takes `steps` steps, whether paused or not: what a lockstep client calls.
  void Advance(int64_t steps);

  std::shared_ptr<const SimState> Snapshot() const;
  /// Continues from a snapshot; waiting commands are dropped, and a recording ends.
  void Restore(const SimState& snapshot);
  int64_t t_ns() const;

  /// What happened since the last call, oldest first; the oldest are dropped beyond kMostEvents.
  std::vector<SimEvent> TakeEvents();
  static constexpr size_t kMostEvents = 65536;

  /// For pacing clients: Advance does not ask. `steps` > 0: runs that many more steps, then is paused.
  void Pause();
  void Continue(int64_t steps = -1);
  bool paused() const;
  /// Takes up to `steps` steps while not paused; returns how many.
  int64_t AdvanceUnlessPaused(int64_t steps);

  /// Notes commands and hashes from now on. InputError as Recorder.
  void StartRecording(std::string note, int64_t hash_every = 1000);
  /// The run since StartRecording; nullopt if none is noted.
  std::optional<Recording> StopRecording();

 private:
  void StepOnce();

  std::shared_ptr<const SimModel> model_;
  mutable std::mutex mutex_;  // of everything below
  SimState state_;
  std::vector<SimCommand> waiting_;
  std::vector<SimEvent> events_;
  int64_t allowed_ = -1;  // steps until the next pause; -1 = never
  std::optional<Recorder> recorder_;
};

}  // namespace airsim360

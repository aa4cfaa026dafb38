// The owner of a running simulation: commands go in from any thread, snapshots come out.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "airsim360/sim/recording.h"
#include "airsim360/sim/step.h"

namespace airsim360 {

/// Commands vehicles from inside a loop.
class SimPilot {
 public:
  virtual ~SimPilot() = default;
  /// Before every step, in the thread that steps; `happened`: in the step before. What is added to `commands` is applied in
  /// this step, after what was posted. Calls nothing of the loop.
  virtual void BeforeStep(const SimModel& model, const SimState& state, std::span<const SimEvent> happened,
                          std::vector<SimCommand>& commands) = 0;
};

/// All functions may be called from any thread; only those that step and Restore change the
/// state, one at a time. Every simulation of the program is stepped here, but for looks ahead beside it (InstantAfter) and
/// repetitions (Replay).
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
  /// Is told the state after a step and what happened in it; says whether to take another one. Calls nothing of
  /// the loop.
  using AfterStep = std::function<bool(const SimState& state, std::span<const SimEvent> happened)>;
  /// Takes up to `steps` steps while `go_on` says so, whether paused or not; returns how many. Their events are
  /// told to `go_on` alone.
  int64_t AdvanceWhile(int64_t steps, const AfterStep& go_on);

  /// Asks `pilot` from the next step on, after those attached before.
  void Attach(std::shared_ptr<SimPilot> pilot);
  /// Asks it no more; nothing happens if it is not attached.
  void Detach(const SimPilot* pilot);

  std::shared_ptr<const SimState> Snapshot() const;
  /// Continues from a snapshot; waiting commands are dropped, pilots are asked no more, and a recording ends.
  void Restore(const SimState& snapshot);
  int64_t t_ns() const;

  // For the one thread that steps, between its steps.

  /// The state itself, without a copy.
  const SimState& state() const { return state_; }
  /// The same, to be changed by hand (put somewhere else, made anew). Ends a recording.
  SimState& Edit();
  /// Steps follow this model from now on: things have moved, a drone came. Ends a recording.
  void SetModel(std::shared_ptr<const SimModel> model);

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
  std::vector<std::shared_ptr<SimPilot>> pilots_;
  std::vector<SimEvent> happened_;  // in the last step, for pilots
  int64_t allowed_ = -1;            // steps until the next pause; -1 = never
  std::optional<Recorder> recorder_;
};

}  // namespace airsim360

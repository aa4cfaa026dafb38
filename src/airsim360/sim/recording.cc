#include "airsim360/sim/recording.h"

#include "airsim360/base/error.h"
#include "airsim360/sim/trajectory_reference.h"

namespace airsim360 {

Recorder::Recorder(const SimModel& model, const SimState& start, std::string note, int64_t hash_every) : hash_every_(hash_every) {
  recording_.note = std::move(note);
  recording_.dt_ns = model.dt_ns;
  recording_.first_step = start.step;
  recording_.start_hash = HashState(start);
}

void Recorder::Before(const SimState& state, std::span<const SimCommand> commands) {
  if (commands.empty()) return;
  for (const SimCommand& command : commands) {
    const auto* flight = std::get_if<FlightCommand>(&command.action);
    const auto* trajectory = flight ? std::get_if<TrajectoryCommand>(&flight->command) : nullptr;
    if (trajectory && !dynamic_cast<const PlannedReference*>(trajectory->trajectory.get()))
      throw InputError("recording: only planned trajectories can be recorded (PlannedReference)");
  }
  recording_.commands.push_back({state.step, {commands.begin(), commands.end()}});
}

void Recorder::After(const SimState& state) {
  if (state.step % hash_every_ == 0) recording_.hashes.emplace_back(state.step, HashState(state));
}

Recording Recorder::Finish(const SimState& state) const {
  Recording recording = recording_;
  recording.steps = state.step - recording.first_step;
  if (recording.hashes.empty() || recording.hashes.back().first != state.step) recording.hashes.emplace_back(state.step, HashState(state));
  return recording;
}

ReplayResult Replay(const SimModel& model, const Recording& recording, SimState& state) {
  if (model.dt_ns != recording.dt_ns) {
    throw InputError("replay: the recording has steps of " + std::to_string(recording.dt_ns) + " ns, the model of " +
                     std::to_string(model.dt_ns));
  }
  if (state.step != recording.first_step || HashState(state) != recording.start_hash) {
    throw InputError("replay: the run began with another state (" + recording.note + ")");
  }
  ReplayResult result;
  auto command = recording.commands.begin();
  auto hash = recording.hashes.begin();
  while (result.steps < recording.steps && result.same) {
    std::span<const SimCommand> commands;
    if (command != recording.commands.end() && command->step == state.step) commands = (command++)->commands;
    Step(model, commands, state);
    ++result.steps;
    if (hash == recording.hashes.end() || hash->first != state.step) continue;
    result.hash = HashState(state);
    result.same = (hash++)->second == result.hash;
    if (!result.same) result.differs_at = state.step;
  }
  return result;
}

}  // namespace airsim360

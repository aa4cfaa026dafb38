// Recordings: the commands of a run with hashes of its states, so that the run can be repeated bit for bit.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/sim/step.h"

namespace airsim360 {

inline constexpr uint32_t kRecordingVersion = 1;

/// Commands that were applied in the step that began at `step`.
struct RecordedStep {
  int64_t step = 0;
  std::vector<SimCommand> commands;
};

/// A run from one state on. Steps and hashes are in ascending order.
struct Recording {
  std::string note = {};  ///< how the model was made, for people: world, drones, seed
  int64_t dt_ns = 0;
  int64_t first_step = 0, steps = 0;  ///< where the run began, and how long it was
  uint64_t start_hash = 0;            ///< HashState of the state it began with
  std::vector<RecordedStep> commands = {};
  std::vector<std::pair<int64_t, uint64_t>> hashes = {};  ///< (state.step, HashState)
};

/// Notes a run while it goes on.
class Recorder {
 public:
  /// `hash_every` steps a hash is noted, and one at the end.
  Recorder(const SimModel& model, const SimState& start, std::string note, int64_t hash_every = 1000);
  /// Before Step with the same arguments. InputError for a trajectory that is no PlannedReference: a
  /// recording could not hold it.
  void Before(const SimState& state, std::span<const SimCommand> commands);
  /// After Step.
  void After(const SimState& state);
  /// The run so far.
  Recording Finish(const SimState& state) const;

 private:
  Recording recording_;
  int64_t hash_every_;
};

/// How a repetition went.
struct ReplayResult {
  bool same = true;
  int64_t steps = 0;        ///< simulated
  int64_t differs_at = -1;  ///< first noted step whose hash is another
  uint64_t hash = 0;        ///< of the last state
};

/// Repeats a run from `state`. InputError if the step or the start state are not those of the recording;
/// stops at the first hash that differs.
ReplayResult Replay(const SimModel& model, const Recording& recording, SimState& state);

/// File form: little-endian, magic "A360RUN\n" and version first, SHA-256 of the rest last.
Bytes EncodeRecording(const Recording& recording);
/// InputError "name: …" for anything else, with the version that is wrong or the place; memory is taken only
/// for what is there.
Recording DecodeRecording(std::span<const std::byte> bytes, std::string_view name);
void WriteRecording(const std::filesystem::path& path, const Recording& recording);
Recording ReadRecording(const std::filesystem::path& path);

}  // namespace airsim360

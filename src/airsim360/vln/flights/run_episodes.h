// Flying episodes and writing down what came of them.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/stage/stage.h"
#include "airsim360/vln/agents/told_agents.h"
#include "airsim360/vln/flights/flight_rules.h"

namespace airsim360 {

struct VlnRunOptions {
  std::string agent = "oracle";
  VlnView view = VlnView::kErp;
  std::optional<Decisions> decisions = {};  ///< none: the protocol's
  std::string protocol = "ours";
  int64_t limit = 0;      ///< of episodes; 0 = all
  int workers = 1;        ///< episodes at a time
  bool realtime = false;  ///< what an agent takes to think passes in its episode
  int width = 1024;       ///< of panoramas, pixels
  RenderSettings picture = {};
  ExecOptions exec = {};
  ChatOptions chat = {};
  /// Told of each flight at its beginning and every Episode::kPathPeriodNs of it; one worker alone.
  std::function<void(const Episode& flight)> watch = {};
  std::filesystem::path out = {};  ///< results.jsonl; beside it NAME.transcript.jsonl of agent openai
  /// Opens a world with its people.
  std::function<std::shared_ptr<Stage>(const std::string& world, uint64_t seed, int64_t people)> open = {};
};

/// A decision of a flight.
struct VlnStep {
  double t = 0;            ///< simulated seconds
  Vec3d p;                 ///< where it was taken
  double yaw_deg = 0;      ///< heading there, counter-clockwise from +X
  std::string said, told;  ///< by the agent (kLongestSaid bytes at most, printable); of what went wrong, "" = nothing
};
inline constexpr size_t kLongestSaid = 1000;
inline constexpr int64_t kPathEveryNs = 500'000'000;  ///< between two places of `pred`

/// What came of one episode: a line of results.jsonl.
struct VlnResult {
  std::string id, template_id, world, difficulty, agent, view, decisions_by, protocol;
  std::string end;          ///< stopped, collision, max_steps, max_seconds, gave_up, not_flown
  std::string explanation;  ///< why it is no success, or what faults there were
  bool success = false, oracle_success = false, collided = false, stopped = false;
  double radius = 0, distance = 0;  ///< of the protocol; metres from the last place to the goal
  double path_length = 0, geodesic_length = 0, straight_length = 0;
  int64_t decisions = 0, faults = 0, moves = 0;
  double yaw_turned_deg = 0, seconds = 0;
  /// Where a thing in a room can be stopped at in many places, the one of them that is nearest to where the flight ended.
  std::optional<Vec3d> goal = {};
  std::vector<Vec3d> places = {};        ///< with `goal`: all of them; passing any is an oracle success. Empty in files of older versions
  std::vector<Vec3d> parts = {};         ///< goals of the parts of the instruction before the last
  std::vector<Vec3d> ref, pred;          ///< the way that was meant; the one flown, every kPathEveryNs and the end
  std::vector<double> heading_deg = {};  ///< at each place of `pred`; empty in files of versions that did not write it
  std::vector<VlnStep> log = {};         ///< as well
};

/// Flies what `out` does not hold yet, in the order of the file, and gives the results of all. Killed at any time and run
/// again it ends with the same bytes. InputError where `out` holds results of another run.
std::vector<VlnResult> RunEpisodes(const std::vector<LanguageEpisode>& episodes, const VlnRunOptions& options);

/// By the protocol that it was flown under.
VlnScore ScoreOf(const VlnResult& result);
/// Share of the parts of its instruction that the flight did, in their order: their goals within the radius one after the other; the
/// last one counts if the flight is a success.
double ProcessFidelity(const VlnResult& result);
std::string ResultLine(const VlnResult& result);
/// InputError "FILE:LINE.field: …".
VlnResult ParseResultLine(const std::string& line, const std::string& where);
std::vector<VlnResult> ReadResults(const std::filesystem::path& file);

}  // namespace airsim360

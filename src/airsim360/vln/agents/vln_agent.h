// Who flies an episode. One object flies one episode; the same observations give the same answers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "airsim360/tasks/agent_server/episode.h"
#include "airsim360/vln/agents/answer.h"
#include "airsim360/vln/agents/eyes.h"

namespace airsim360 {

/// What an agent may use to decide. Those who cheat (oracle) or recognise perfectly (mask) read the episode's goal.
struct VlnSituation {
  const LanguageEpisode& episode;
  const Episode& flight;
  Decisions decisions;
  int64_t step = 0, steps_left = 0;  ///< decisions taken, and left
  double radius = 20;                ///< of success
  const RayTracer& solid;            ///< what a drone can touch
  Eyes& eyes;
  std::string told = {};  ///< of the last decision: what went wrong with it; "" = nothing

  Viewpoint Pose() const;
  std::shared_ptr<const SceneState> moved() const { return flight.moved(); }
};

/// An answer and what happened on the way to it.
struct Decision {
  Answer answer;
  std::vector<std::string> faults = {};  ///< of endpoints and grammar, in words, in order
  bool give_up = false;                  ///< the agent cannot go on: the episode ends where it is
  std::string said = {};                 ///< by a program or a model, word for word; "" = `answer` says it all
};

class VlnAgent {
 public:
  virtual ~VlnAgent() = default;
  virtual Decision Decide(VlnSituation& situation) = 0;
};

inline constexpr const char* kAgentNames[] = {"oracle", "random", "forward", "heuristic", "mask", "exec", "openai"};

/// Flies the reference path: by waypoints, by steps of the list, or, where one straight move is all, to where that can lead.
std::unique_ptr<VlnAgent> MakeOracleAgent();
/// Draws: steps, turns, moves, and stops at times. By the episode's seed.
std::unique_ptr<VlnAgent> MakeRandomAgent(uint64_t seed);
/// Straight ahead, and stops.
std::unique_ptr<VlnAgent> MakeForwardAgent();
/// Reads the words of direction in the instruction, goes there as far as is free, and stops. Sees nothing.
std::unique_ptr<VlnAgent> MakeHeuristicAgent();
/// Knows the thing that is meant when it sees it, and sees what its view shows: compares views without a model.
std::unique_ptr<VlnAgent> MakeMaskAgent();

}  // namespace airsim360

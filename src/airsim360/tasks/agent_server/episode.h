// One navigation episode: a drone, a task, limits, and what has come of it. The protocol-free heart of the
// agent interface; docs/guide/agents.md is its user's view.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/routes/shortest_way.h"
#include "airsim360/sim/sim_loop.h"
#include "airsim360/tasks/agent_server/agent_action.h"
#include "airsim360/tasks/agent_server/agent_world.h"

namespace airsim360 {

/// What ends an episode well: the agent says stop near the goal (vision-and-language navigation), or it is
/// near the goal at all (goal reaching).
enum class SuccessRule { kStop, kReach };
inline constexpr const char* kSuccessRuleNames[] = {"stop", "reach"};

/// Of a reference path, and of more goals.
inline constexpr size_t kMostReferencePoints = 4096;

struct EpisodeSpec {
  std::string instruction;             ///< what the agent is asked to do, in words; may be empty
  std::optional<Vec3d> goal;           ///< in W; none: a free place by the seed
  std::vector<Vec3d> more_goals = {};  ///< other places that count as the goal too; at most 4096
  std::optional<Vec3d> start;          ///< in W; none: the world's first free place
  double start_yaw = 0;                ///< rad
  std::vector<Vec3d> reference_path;   ///< of a demonstration; empty: FindShortestWay of the drone
  uint64_t seed = 0;                   ///< of the goal, gusts and sensors
  std::string drone = "hummingbird";   ///< DroneCatalog
  SuccessRule success = SuccessRule::kStop;
  double success_radius = 0;  ///< metres; 0 = 20 in the open (AerialVLN), 1 in rooms
  double speed = 3;           ///< m/s of actions that say none
  PresetSizes presets;
  int64_t max_steps = 500;   ///< actions
  double max_seconds = 600;  ///< simulated
  bool end_on_collision = true;
  bool tells_goal = true;  ///< its agent is told where the goal is, and how it scores before it is over
};

enum class EpisodeEnd { kRunning, kStopped, kReached, kCollision, kMaxSteps, kMaxSeconds };
inline constexpr const char* kEpisodeEndNames[] = {"running", "stopped", "reached", "collision", "max_steps", "max_seconds"};

/// Scores as in Anderson et al., "On Evaluation of Embodied Navigation Agents" (2018).
struct EpisodeScore {
  bool success = false;
  bool oracle_success = false;        ///< some place of the path was within the radius
  double navigation_error = 0;        ///< metres from the last place to the goal
  double path_length = 0;             ///< metres flown
  double shortest_length = 0;         ///< of the reference path, or of the shortest free way
  bool shortest_is_straight = false;  ///< no free way was found: all goes by the straight line to the goal
  double ndtw = 0;                    ///< NormalizedTimeWarping to the reference, by the radius of success
  double spl = 0;                     ///< success * shortest / max(path, shortest)
};

/// One thread at a time. The same spec and the same actions give the same bytes.
class Episode {
 public:
  /// InputError naming the field (`start`, `goal`, `drone`, …) that makes no sense in this world.
  Episode(std::shared_ptr<AgentWorld> world, EpisodeSpec spec);

  /// Back to the start; with a seed, as if made with it.
  void Reset(std::optional<uint64_t> seed = {});
  /// Flies one action to its end, or until the episode ends. InputError when the episode is over or the drone
  /// cannot fly the action.
  void Act(const AgentAction& action);
  /// Calls `watch` now, and from now on every kPathPeriodNs of flight.
  void Watch(std::function<void(const Episode&)> watch);
  /// Time goes by while the agent thinks: the drone flies on with its last action. Nothing once it is over.
  void Wait(double seconds);

  AgentWorld& world() { return *world_; }
  const std::shared_ptr<AgentWorld>& shared_world() const { return world_; }
  const EpisodeSpec& spec() const { return spec_; }
  const Vehicle& vehicle() const { return state().vehicles[0]; }
  const SimState& state() const { return loop_->state(); }
  int rotors() const { return static_cast<int>(loop_->model().drones[0]->model().rotors.size()); }
  /// The people as they stand now, for pictures; null: nobody.
  std::shared_ptr<const SceneState> moved() const;
  Vec3d start() const { return start_W_; }
  Vec3d goal() const { return goal_W_; }
  double success_radius() const { return radius_; }
  /// Metres to the nearest place of the goal.
  double distance_to_goal() const;
  int64_t steps() const { return steps_; }
  double seconds() const { return 1e-9 * static_cast<double>(state().t_ns); }
  EpisodeEnd end() const { return end_; }
  EpisodeScore Score() const;
  /// Places every kPathPeriodNs, the first at the start.
  const std::vector<Vec3d>& path() const { return path_; }
  static constexpr int64_t kPathPeriodNs = 100'000'000;

 private:
  void Check() const;
  void ChoosePlaces();
  void BuildModel();
  /// Flies on until `until_ns`, the end of the episode, or the target of `plan` (null: none) is reached.
  bool Fly(int64_t until_ns, const ActionPlan* plan);
  void Note(std::span<const SimEvent> happened);
  bool Arrived(const ActionPlan& plan) const;
  AgentPose Setpoint() const;

  std::shared_ptr<AgentWorld> world_;
  EpisodeSpec spec_;
  double radius_ = 1;
  Vec3d start_W_, goal_W_;
  std::unique_ptr<SimLoop> loop_;
  EpisodeEnd end_ = EpisodeEnd::kRunning;
  int64_t steps_ = 0;
  std::optional<AgentPose> setpoint_;  ///< where the last action led, if the drone came to rest there
  bool refused_ = false;
  std::string refusal_;
  double nearest_ = 0;  ///< metres to the goal so far
  double length_ = 0;
  Vec3d last_p_W_;
  std::vector<Vec3d> path_;
  std::function<void(const Episode&)> watch_ = {};
  mutable ShortestWayCache shortest_way_;  ///< looked for when the first score is asked for
};

}  // namespace airsim360

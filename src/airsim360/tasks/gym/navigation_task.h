// What a learning drone is asked to do in a world, where its episodes begin, and what a step earns. Pure
// functions of world, task and seed: the same episode everywhere.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/sim/step.h"

namespace airsim360 {

enum class NavigationKind {
  kReach,   ///< fly to a given point
  kAvoid,   ///< the same where something stands between, keeping away from surfaces
  kSearch,  ///< find a thing of a given category: see it in the panorama from near enough
};
inline constexpr const char* kNavigationNames[] = {"reach", "avoid", "search"};
/// Kind of a name; InputError naming the nearest if there is none.
NavigationKind ParseNavigationKind(std::string_view name);

/// Metres, seconds. Rewards of a step add up.
struct NavigationTask {
  NavigationKind kind = NavigationKind::kReach;
  double least_distance = 3, most_distance = 30;  ///< between start and goal, where the world has such pairs
  double goal_radius = 1;                         ///< reached within it; search: found at this range (3 is a good value)
  double clearance = 0.7;                         ///< free around starts and goals
  double area = 100;                              ///< starts and goals lie at most so far from the world's spawn, seen from above
  double min_height = 0.8, max_height = 15;       ///< of starts and goals above the ground
  double seconds = 60;                            ///< an episode is cut off after it
  std::string target = {};                        ///< search: category path, "" = any thing of everyday size
  double safe_distance = 1.5;                     ///< avoid: nearer to a surface costs, see near_cost
  double progress_reward = 1;                     ///< per metre that the goal came nearer (reach, avoid)
  double goal_reward = 10, crash_cost = 10;
  double step_cost = 0.01;   ///< of every step
  double near_cost = 0.5;    ///< avoid: times (1 - clearance / safe_distance) where that is positive
  double seen_reward = 0.1;  ///< search: of a step after which the target is in sight
};

/// InputError naming the first field that makes no sense.
void CheckTask(const NavigationTask& task);

struct NavigationEpisode {
  RigidTransform X_WB;          ///< where it starts, hovering
  Vec3d goal_W;                 ///< search: middle of the target
  EntityId target = kNoEntity;  ///< search
};

/// What is asked of an episode instead of what it would draw.
struct EpisodeWish {
  std::optional<Vec3d> start_W, goal_W;  ///< metres
  std::optional<double> yaw;             ///< heading at the start, radians
};

/// What a step led to.
struct NavigationScore {
  double reward = 0;
  bool reached = false, crashed = false;
};

/// What is seen of a target in a panorama.
struct TargetSight {
  int pixels = 0;    ///< that show it
  double range = 0;  ///< metres to the nearest of them
};

/// The places of a world between which a task's episodes lead. All starts and goals can be reached from each
/// other by a ball of radius `clearance`. Immutable.
class NavigationWorld {
 public:
  /// InputError if the task makes no sense, or the world has fewer than two such places or no such target.
  NavigationWorld(std::shared_ptr<const RayTracer> tracer, const NavigationTask& task);

  const NavigationTask& task() const { return task_; }
  const RayTracer& tracer() const { return *tracer_; }
  const std::shared_ptr<const RayTracer>& shared_tracer() const { return tracer_; }
  const std::vector<Vec3d>& places() const { return places_; }
  const std::vector<EntityId>& targets() const { return targets_; }

  /// Episode number `episode` of environment `environment`: a function of the three numbers alone.
  NavigationEpisode Sample(uint64_t seed, uint64_t environment, uint64_t episode) const;

  /// `episode` as wished. InputError for a place outside the world or nearer to a surface than half the task's
  /// clearance (as near as drawn ones come), for a number that is none, and for the goal of a search, which is a thing.
  NavigationEpisode Wished(NavigationEpisode episode, const EpisodeWish& wish) const;

  /// What a step from `before` to `now` is worth; `clearance` in metres, `sight` counts for searches alone.
  NavigationScore Score(const NavigationEpisode& episode, Vec3d before, Vec3d now, double clearance, bool crashed,
                        const TargetSight& sight) const;

 private:
  void CheckPlace(const char* what, Vec3d place) const;
  Vec3d Near(Vec3d place, double u, double v, double w) const;
  NavigationEpisode SampleSearch(RngStream& random) const;

  std::shared_ptr<const RayTracer> tracer_;
  NavigationTask task_;
  std::vector<Vec3d> places_;
  std::vector<EntityId> targets_;
};

}  // namespace airsim360

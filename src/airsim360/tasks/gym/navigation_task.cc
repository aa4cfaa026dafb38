#include "airsim360/tasks/gym/navigation_task.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/routes/roadmap.h"
#include "airsim360/scene/viewpoint.h"

namespace airsim360 {
namespace {

constexpr int kCandidates = 500;       // places tried in a world
constexpr int kTries = 512;            // draws of a pair before the best so far is taken
constexpr float kEverydaySize = 25;    // metres: longest extent of a target that was not asked for by name
constexpr int kLeastTargetPixels = 3;  // of a panorama: fewer do not count as seen

/// Those places that hang together with the first one that has neighbours.
std::vector<Vec3d> Connected(const RayTracer& tracer, std::vector<Vec3d> places, double radius) {
  const Roadmap map = Connect(tracer, std::move(places), radius);
  std::vector<Vec3d> best;
  std::vector<bool> seen(map.places.size());
  for (size_t first = 0; first < map.places.size(); ++first) {
    if (seen[first]) continue;
    const CheapestWays ways = FindCheapestWays(map, static_cast<int>(first));
    std::vector<Vec3d> part;
    for (size_t i = 0; i < map.places.size(); ++i) {
      if (!std::isfinite(ways.cost[i])) continue;
      seen[i] = true;
      part.push_back(map.places[i]);
    }
    if (part.size() > best.size()) best = std::move(part);
  }
  return best;
}

double LevelDistance(Vec3d a, Vec3d b) { return std::hypot(a.x - b.x, a.y - b.y); }

bool IsUnder(std::string_view path, std::string_view ancestor) {
  return path == ancestor || (path.starts_with(ancestor) && path[ancestor.size()] == '/');
}

std::vector<EntityId> FindTargets(const Scene& scene, const NavigationTask& task, Vec3d spawn) {
  if (!task.target.empty()) scene.tree.At(task.target);
  std::vector<EntityId> targets;
  for (const Entity& entity : scene.entities) {
    if (entity.bounds.empty()) continue;
    const Category& category = scene.tree[entity.category];
    const Vec3f size = entity.bounds.size();
    const bool wanted =
        task.target.empty() ? category.thing && std::max({size.x, size.y, size.z}) <= kEverydaySize : IsUnder(category.path, task.target);
    if (wanted && LevelDistance(VecCast<double>(entity.bounds.center()), spawn) <= task.area) targets.push_back(entity.id);
  }
  if (targets.empty()) {
    throw InputError("task: there is no " + (task.target.empty() ? std::string("thing") : "'" + task.target + "'") +
                     " to be searched for within " + std::to_string(static_cast<int>(task.area)) + " m");
  }
  return targets;
}

}  // namespace

NavigationKind ParseNavigationKind(std::string_view name) { return ParseChoice<NavigationKind>("task", name, kNavigationNames); }

void CheckTask(const NavigationTask& task) {
  const auto check = [](const char* field, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw InputError("task." + std::string(field) + ": " + std::to_string(value) + " is not in " + std::to_string(low) + " ... " +
                     std::to_string(high));
  };
  check("least_distance", task.least_distance, 0, 1e5);
  check("most_distance", task.most_distance, task.least_distance, 1e5);
  check("goal_radius", task.goal_radius, 0.05, 1000);
  check("clearance", task.clearance, 0.05, 50);
  check("area", task.area, 1, 1e5);
  check("min_height", task.min_height, 0, 1e4);
  check("max_height", task.max_height, task.min_height, 1e4);
  check("seconds", task.seconds, 0.01, 1e6);
  check("safe_distance", task.safe_distance, 0.01, 2);
  for (const double value : {task.progress_reward, task.goal_reward, task.crash_cost, task.step_cost, task.near_cost, task.seen_reward})
    check("rewards and costs", value, -1e6, 1e6);
}

NavigationWorld::NavigationWorld(std::shared_ptr<const RayTracer> tracer, const NavigationTask& task)
    : tracer_(std::move(tracer)), task_(task) {
  CheckTask(task_);
  const Scene& scene = tracer_->scene();
  const Vec3d spawn = VecCast<double>(FirstViewpoint(scene));
  std::vector<Vec3d> places = FindFreePlaces(
      *tracer_,
      {.seed = 0, .radius = task_.clearance, .min_height = task_.min_height, .max_height = task_.max_height, .candidates = kCandidates});
  std::erase_if(places, [&](Vec3d p) { return LevelDistance(p, spawn) > task_.area; });
  places_ = Connected(*tracer_, std::move(places), task_.clearance);
  if (places_.size() < 2) throw InputError("task: the world has no free places for it; try less clearance");
  if (task_.kind == NavigationKind::kSearch) targets_ = FindTargets(scene, task_, spawn);
}

Vec3d NavigationWorld::Near(Vec3d place, double u, double v, double w) const {
  // Half of the free ball around the place: still half of the clearance everywhere.
  const double radius = 0.5 * task_.clearance * std::cbrt(u), angle = 2 * std::numbers::pi * v, z = 2 * w - 1;
  const double level = std::sqrt(1 - z * z);
  return place + radius * Vec3d{level * std::cos(angle), level * std::sin(angle), z};
}

NavigationEpisode NavigationWorld::SampleSearch(RngStream& random) const {
  const Scene& scene = tracer_->scene();
  NavigationEpisode episode;
  episode.target = targets_[random.Index(static_cast<uint32_t>(targets_.size()))];
  episode.goal_W = VecCast<double>(scene.entity(episode.target).bounds.center());
  return episode;
}

NavigationEpisode NavigationWorld::Sample(uint64_t seed, uint64_t environment, uint64_t number) const {
  RngStream random(seed, "navigation episode", MixBits(environment) ^ number);
  const auto place = [&] {
    const Vec3d middle = places_[random.Index(static_cast<uint32_t>(places_.size()))];
    const double u = random.Uniform(), v = random.Uniform(), w = random.Uniform();
    return Near(middle, u, v, w);
  };
  const bool search = task_.kind == NavigationKind::kSearch;
  NavigationEpisode episode;
  if (search) episode = SampleSearch(random);

  // Draw pairs until one fits; else take the one whose distance misses the wanted ones least.
  double least_miss = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTries && least_miss > 0; ++i) {
    const Vec3d start = place(), goal = search ? episode.goal_W : place();
    const double distance = Norm(goal - start);
    double miss = std::max({task_.least_distance - distance, distance - task_.most_distance, 0.0});
    if (distance == 0) continue;
    // What is to be avoided must be there.
    if (task_.kind == NavigationKind::kAvoid && !tracer_->Occluded(VecCast<float>(start), VecCast<float>(goal))) miss += 1e-3;
    if (miss >= least_miss) continue;
    least_miss = miss;
    episode.X_WB.p = start;
    episode.goal_W = goal;
  }
  episode.X_WB = BodyPose(episode.X_WB.p, random.Uniform(-std::numbers::pi, std::numbers::pi), 0, 0);
  return episode;
}

void NavigationWorld::CheckPlace(const char* what, Vec3d p) const {
  const std::string fault = PlaceFault(*tracer_, p, 0.5 * task_.clearance);
  if (fault.empty()) return;
  char place[100];
  std::snprintf(place, sizeof place, ": (%g, %g, %g) ", p.x, p.y, p.z);
  throw InputError(what + (place + fault));
}

NavigationEpisode NavigationWorld::Wished(NavigationEpisode episode, const EpisodeWish& wish) const {
  if (wish.goal_W && task_.kind == NavigationKind::kSearch)
    throw InputError("goal: a search looks for a thing: choose its category by the task's option 'target'");
  if (wish.goal_W) CheckPlace("goal", *wish.goal_W);
  if (wish.start_W) CheckPlace("start", *wish.start_W);
  if (wish.yaw && !std::isfinite(*wish.yaw)) throw InputError("yaw: not a finite number");
  if (wish.goal_W) episode.goal_W = *wish.goal_W;
  if (wish.start_W) episode.X_WB.p = *wish.start_W;
  if (wish.yaw) episode.X_WB = BodyPose(episode.X_WB.p, *wish.yaw, 0, 0);
  return episode;
}

NavigationScore NavigationWorld::Score(const NavigationEpisode& episode, Vec3d before, Vec3d now, double clearance, bool crashed,
                                       const TargetSight& sight) const {
  NavigationScore score;
  score.crashed = crashed;
  score.reward = -task_.step_cost;
  const double distance = Norm(episode.goal_W - now);
  if (task_.kind == NavigationKind::kSearch) {
    const bool seen = sight.pixels >= kLeastTargetPixels;
    score.reached = !crashed && seen && sight.range <= task_.goal_radius;
    if (seen) score.reward += task_.seen_reward;
  } else {
    score.reached = !crashed && distance <= task_.goal_radius;
    score.reward += task_.progress_reward * (Norm(episode.goal_W - before) - distance);
  }
  if (task_.kind == NavigationKind::kAvoid) score.reward -= task_.near_cost * std::max(0.0, 1 - clearance / task_.safe_distance);
  if (score.reached) score.reward += task_.goal_reward;
  if (crashed) score.reward -= task_.crash_cost;
  return score;
}

}  // namespace airsim360

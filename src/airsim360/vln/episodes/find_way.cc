#include "airsim360/planning/search.h"
#include "airsim360/vln/episodes/places.h"

namespace airsim360::internal {
namespace {

constexpr double kOpenWay = 0.6, kRoomWay = 0.47;  // metres free around a way
constexpr double kMargin = 4, kSpacing = 0.25;     // metres of the lattice within rooms: around both ends, between nodes
constexpr size_t kMostExpanded = 20'000;           // nodes looked at: enough for a hall; behind a shut door there are fewer
constexpr double kHeuristic = 1.1;                 // as of FindShortestWay

}  // namespace

ShortestWay FindWay(const VlnGround& ground, Vec3d start, Vec3d goal) {
  if (!ground.rooms()) return FindShortestWay(ground.tracer(), start, goal, kOpenWay);
  const WorldClearance surfaces(ground.tracer(), nullptr);
  const BoundedClearance world(surfaces, BoxAround(start, goal, kMargin, ground.inhabited()));
  const SearchResult found =
      FindPath(start, goal, world, {.radius = kRoomWay, .spacing = kSpacing, .heuristic = kHeuristic, .max_expanded = kMostExpanded});
  if (found.outcome != SearchOutcome::kFound) return {{start, goal}, false};
  return {Shortcut(found.path, world, kRoomWay), true};
}

}  // namespace airsim360::internal

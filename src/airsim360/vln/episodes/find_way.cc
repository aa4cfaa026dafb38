#include "airsim360/planning/routes/search.h"
#include "airsim360/vln/episodes/places.h"

namespace airsim360::internal {
namespace {

constexpr double kOpenWay = 0.6;  // metres free around a way
constexpr double kMargin = 4;     // metres of the lattice within rooms around both ends

// How ways are looked for within rooms: with room on all sides; then through doors, of which those of bathrooms leave 0.76 m.
struct RoomSearch {
  double radius, spacing;  // metres free around the way, between nodes
  size_t most_expanded;    // nodes looked at: enough for a hall; behind a shut door there are fewer
};
constexpr RoomSearch kRoomSearches[] = {{0.47, 0.25, 20'000}, {kNarrowWay, 0.12, 60'000}};

}  // namespace

ShortestWay FindWay(const VlnGround& ground, Vec3d start, Vec3d goal) {
  if (!ground.rooms()) return FindShortestWay(ground.tracer(), start, goal, kOpenWay);
  const WorldClearance surfaces(ground.tracer(), nullptr);
  const BoundedClearance world(surfaces, BoxAround(start, goal, kMargin, ground.inhabited()));
  for (const auto& [radius, spacing, most] : kRoomSearches) {
    const SearchResult found =
        FindPath(start, goal, world, {.radius = radius, .spacing = spacing, .heuristic = kWayHeuristic, .max_expanded = most});
    if (found.outcome == SearchOutcome::kFound) return {Shortcut(found.path, world, radius), true};
  }
  return {{start, goal}, false};
}

}  // namespace airsim360::internal

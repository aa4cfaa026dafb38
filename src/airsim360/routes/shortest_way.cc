#include "airsim360/routes/shortest_way.h"

#include <algorithm>
#include <cmath>

#include "airsim360/planning/routes/search.h"
#include "airsim360/routes/world_clearance.h"

namespace airsim360 {
namespace {

constexpr double kFinest = 0.25;          // metres between lattice nodes
constexpr double kMaxNodes = 2e6;         // of the lattice: 16 bytes each
constexpr size_t kMaxExpanded = 100'000;  // nodes looked at from either side
constexpr double kMinRadius = 0.05;       // metres: what has less room counts as inside a thing
constexpr double kFit = 0.95;             // of the room at start and goal, so that rounding does not block them

// Where the way may lead: all of a closed room; in the open, where flights are, and around both ends.
Box3d SpaceOf(const RayTracer& tracer, Vec3d start, Vec3d goal) {
  constexpr double kMargin = 10;  // metres
  Box3d box = FlightBox(tracer);
  if (tracer.scene().sky_entity == kNoEntity) return box;
  const Vec3d margin{kMargin, kMargin, kMargin};
  return {Min(box.min, Min(start, goal) - margin), Max(box.max, Max(start, goal) + margin)};
}

double SpacingFor(const Box3d& box) {
  const Vec3d size = box.max - box.min;
  return std::max(kFinest, std::cbrt(size.x * size.y * size.z / kMaxNodes));
}

}  // namespace

ShortestWay FindShortestWay(const std::shared_ptr<const RayTracer>& tracer, Vec3d start, Vec3d goal, double radius) {
  const ShortestWay straight{{start, goal}, false};
  const WorldClearance surfaces(tracer, nullptr);
  for (const Vec3d end : {start, goal}) radius = std::min(radius, kFit * surfaces.Clearance(end, 2 * radius));
  if (!(radius >= kMinRadius)) return straight;

  // Near both ends first, where the lattice can be fine; then everywhere.
  const Box3d space = SpaceOf(*tracer, start, goal);
  const Box3d near = BoxAround(start, goal, 5 + Norm(goal - start) / 2, space);
  for (const Box3d& box : {near, space}) {
    const BoundedClearance world(surfaces, box);
    const SearchOptions options{.radius = radius, .spacing = SpacingFor(box), .heuristic = kWayHeuristic, .max_expanded = kMaxExpanded};
    const SearchResult found = FindPath(start, goal, world, options);
    if (found.outcome == SearchOutcome::kFound) return {Shortcut(found.path, world, radius), true};
    if (near.min == space.min && near.max == space.max) break;
  }
  return straight;
}

const ShortestWay& ShortestWayCache::Find(const std::shared_ptr<const RayTracer>& tracer, Vec3d start, Vec3d goal, double radius) {
  if (!way_ || start_ != start || goal_ != goal) {
    way_ = FindShortestWay(tracer, start, goal, radius);
    start_ = start;
    goal_ = goal;
  }
  return *way_;
}

}  // namespace airsim360

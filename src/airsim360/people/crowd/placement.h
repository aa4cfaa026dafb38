// First places of people: nobody inside of another.
#pragma once

#include <unordered_map>
#include <vector>

#include "airsim360/people/behaviour/plan.h"
#include "airsim360/people/crowd/crowd.h"
#include "airsim360/people/navigation/navmesh.h"

namespace airsim360::internal {

class Placement {
 public:
  Placement(const NavMesh& mesh, uint64_t seed) : mesh_(mesh), seed_(seed) {}
  /// Up to `count` places in an area, at random while there is room, then as close as people stand in a crowd.
  std::vector<NavPoint> Fill(const NavArea& area, size_t count, uint64_t stream);
  /// False if somebody stands there.
  bool Take(const NavPoint& point);
  /// Whoever took exactly this point is elsewhere.
  void Leave(const NavPoint& point);
  /// The place nearest to (x, y) whatever its height.
  NavPoint AnyHeight(Vec3d p, double reach) const;

 private:
  bool IsFree(const NavPoint& point, double distance) const;
  uint64_t CellOf(double x, double y) const;
  const NavMesh& mesh_;
  uint64_t seed_;
  std::unordered_map<uint64_t, std::vector<Vec3d>> taken_;  // by square metre
};

/// How people from `first` on begin whose area is one of those in rooms: on seats, in lines, in talks of two.
void PlanBeginnings(const CrowdModel& model, PersonIndex first, const std::vector<char>& in_rooms, Placement& placement, CrowdPlan& plan);

}  // namespace airsim360::internal

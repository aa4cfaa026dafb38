// The way of one person: gates instead of points, so that many people can turn a corner or use a door side by
// side ("way portals": S. Curtis, J. Snape, D. Manocha, "Way portals: efficient multi-agent navigation with
// line-segment goals", I3D 2012).
#pragma once

#include <vector>

#include "airsim360/people/navigation/navmesh.h"

namespace airsim360::internal {

/// A corner of a way with the room beside it: whoever passes between `p` and `p` + `side` has turned the corner.
/// The goal has no room.
struct Gate {
  Vec3d p;
  Vec2d side;         ///< metres, away from what the way turns around
  Vec2d ahead;        ///< unit vector through the gate
  double onward = 0;  ///< metres from here to the goal
};

/// One gate a corner of the way, less its start; the last one is the goal.
std::vector<Gate> GatesOf(const NavMesh& mesh, const NavPath& path);

/// The place of the gate nearest to p.
Vec2d NearestInGate(const Gate& gate, Vec2d p);

/// Whether someone at p may look for the next gate.
bool HasPassed(const Gate& gate, Vec2d p);

}  // namespace airsim360::internal

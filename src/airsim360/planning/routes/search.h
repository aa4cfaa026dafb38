// Collision-free polylines: A* on a lattice whose nodes and edges are checked against the true distances,
// then shortcuts.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "airsim360/planning/clearance.h"

namespace airsim360 {

struct SearchOptions {
  double radius = 0.5;                 ///< metres to keep from every surface
  double spacing = 1;                  ///< metres between lattice nodes along an axis
  double heuristic = 1;                ///< weight of the straight distance to go; 0 makes it Dijkstra's search
  size_t max_nodes = size_t{1} << 24;  ///< of the lattice; a larger one is an InputError
  size_t max_expanded = 1'000'000;     ///< nodes looked at from either side
};

enum class SearchOutcome {
  kFound,
  kStartBlocked,   ///< the start is nearer than the radius to a surface
  kGoalBlocked,    ///< the goal is
  kStartEnclosed,  ///< all that can be reached from the start was looked at
  kGoalEnclosed,   ///< all from which the goal can be reached was looked at
  kGaveUp,         ///< neither after max_expanded nodes
};

struct SearchResult {
  SearchOutcome outcome = SearchOutcome::kFound;
  std::vector<Vec3d> path;    ///< start … goal; every edge proved clear (SegmentIsClear); empty if not found
  double length = 0;          ///< metres, of the path
  size_t expanded = 0;        ///< nodes
  double reached_volume = 0;  ///< m^3 of the lattice cells that the enclosed side reaches
};

/// Shortest way on the lattice of 26 neighbours a node (the start is a node, the goal is joined to the nodes
/// around it) inside world.box(). A pure function of its arguments.
SearchResult FindPath(Vec3d start, Vec3d goal, const BoundedClearance& world, const SearchOptions& options);

/// Fewer and shorter legs: leaves out points between which the straight way is clear, then cuts corners until
/// that gains less than a thousandth. Every leg is proved clear.
std::vector<Vec3d> Shortcut(std::vector<Vec3d> path, const ClearanceQuery& world, double radius);

/// Metres along a polyline.
double PolylineLength(const std::vector<Vec3d>& points);

/// Box around two points grown by `margin`, inside `limits`.
Box3d BoxAround(Vec3d a, Vec3d b, double margin, const Box3d& limits);

}  // namespace airsim360

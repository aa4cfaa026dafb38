// The streets of a town as lines between nodes, by the kind of its plan.
#pragma once

#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/worlds/osm/data/patches.h"
#include "airsim360/worlds/town_spec.h"

namespace airsim360::internal {

struct StreetEdge {
  size_t a = 0, b = 0;
  std::vector<Vec2d> bends;  ///< between the two nodes
  int rank = 1;              ///< as TownStreet::rank
};

struct StreetNet {
  std::vector<Vec2d> nodes;
  std::vector<StreetEdge> edges;
  std::vector<Vec2d> LineOf(const StreetEdge& edge) const;
};

/// Streets that fill the town's rectangle around the origin and leave it on all sides.
StreetNet PlanStreets(const TownSpec& spec, RngStream& rng);

}  // namespace airsim360::internal

// What lies around the ground of a map.
#pragma once

#include <vector>

#include "airsim360/worlds/osm/osm_ground_builder.h"

namespace airsim360::internal {

/// What goes on beyond the edge of the ground.
enum class Beyond { kTown, kOpen, kSea };

/// A piece of the edge: of side 0 (south), 1 (east), 2 (north) or 3 (west), from share s0 to s1 of its length,
/// counter-clockwise.
struct EdgeStretch {
  int side = 0;
  double s0 = 0, s1 = 1;
  Beyond beyond = Beyond::kTown;
};

/// The whole edge, in order. What the edge cuts goes on outwards: the sea exactly where it reaches the edge; in a
/// `town`, open country behind parks, woods, fields and other waters of a hectare and more, else houses.
std::vector<EdgeStretch> EdgeOf(const OsmScene& scene, const GroundBuilder& ground, bool town);

/// What lies at p, outside the ground.
Beyond BeyondAt(const std::vector<EdgeStretch>& edge, const OsmBox& ground, Vec2d p);

/// The country around, to the horizon, and a sheet below everything that closes what rounding leaves open. `town`:
/// roofs to 900 m, as far as the edge says so. The sea around is part of the entity `sea`.
void LayCountry(OsmScene& scene, GroundBuilder& ground, const std::vector<EdgeStretch>& edge, bool town, EntityId sea);
/// Around a built-up extract the town goes on: blocks of plain houses as high as those inside, thinning out.
void RaiseBackdrop(OsmScene& scene, MeshBuilder& mesh, const std::vector<OsmBuilding>& buildings, const std::vector<EdgeStretch>& edge);

}  // namespace airsim360::internal

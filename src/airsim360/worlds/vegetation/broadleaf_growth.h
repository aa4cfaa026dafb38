// Broad-leaved trees: crowns of overlapping lobes filled by space colonisation, leaves on the thin twigs.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "airsim360/worlds/vegetation/plant_mesh.h"

namespace airsim360::internal {

/// How leaves stand along a shoot.
enum class LeafOrder {
  kSpiral,     ///< each a golden angle on
  kAlternate,  ///< left and right in turn, in flat sprays
  kOpposite,   ///< in pairs, each pair across the one before
};

/// One individual of a species; metres.
struct BroadleafSpecies {
  std::string_view name;
  float height, clear_trunk, crown_radius, trunk_radius;
  float leader;       ///< how far up the crown the trunk goes on, 0..1
  int lobes;          ///< the crown is the union of so many ellipsoids round an axis
  float lobe_radius;  ///< in crown radii
  int attractors;
  GrowthOptions growth;
  LeafShape leaf;
  int leaves;
  float clumping;  ///< 0 even … 1 leaves in clumps with gaps between
  Vec3f bark;
  LeafOrder order = LeafOrder::kSpiral;
  float internode = 0.04f;     ///< metres of shoot between leaves or pairs
  float shoot = 0.30f;         ///< length of the longest shoots
  int holes = 6;               ///< balls without branches in the crown, through which the sky is seen
  float open_side = 0.25f;     ///< how much farther the crown reaches to the side that it leans to, in radii
  float lean = 0.03f;          ///< of the trunk's top, standard deviation in heights
  float dead = 0;              ///< share of the limbs that carry no leaves any more
  float min_branch = 0.0075f;  ///< thinnest branch that is drawn
  float depth = 1;             ///< how much darker the inside of the crown is: 0 not at all, 1 as in PlantLayers
  float transmission = 0.8f;   ///< of the leaves
};

/// The crown: ellipsoids scattered round its axis, wider below the middle than above and farther to one side, less holes.
class Crown {
 public:
  Crown(const BroadleafSpecies& species, RngStream& random);
  bool Contains(Vec3f p) const;
  Vec3f center() const { return lobes_[0].first; }
  /// About the share of the sky that a leaf at p sees: less deep inside and on the underside.
  float Openness(Vec3f p) const;

 private:
  float height_, radius_;
  bool InOneOf(const std::vector<std::pair<Vec3f, float>>& balls, Vec3f p) const;
  std::vector<std::pair<Vec3f, float>> lobes_, holes_;  // centres, and radii in crown radii
};

/// Trunk, limbs that leave it at different heights, and branches that fill the crown; thickened.
std::vector<BranchNode> GrowTree(const BroadleafSpecies& species, const Crown& crown, RngStream& random);

/// The whole tree.
Model GrowBroadleaf(const BroadleafSpecies& species, const Texture& atlas, uint64_t seed);

/// The same tree for seeing from far: a share `detail` of the leaves, each larger, and only thick branches.
BroadleafSpecies Simplified(BroadleafSpecies species, float detail);

}  // namespace airsim360::internal

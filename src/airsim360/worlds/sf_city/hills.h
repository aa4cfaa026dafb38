// Streets and hills of sf_city: a grid of blocks on a flat plan, and where the plan lies in W. X east, Y north; an avenue (x = 0)
// and a cross street (y = 0) meet at the origin.
#pragma once

#include <vector>

#include "airsim360/worlds/kit/drape.h"
#include "airsim360/worlds/kit/street_plan.h"

namespace airsim360::internal {

inline constexpr float kSteepest = 0.31f;   ///< of the centre lines of its streets, as San Francisco's steepest
inline constexpr float kLatticeEdge = 560;  ///< the lattice is fine up to there
inline constexpr float kBayLevel = -1.6f;   ///< of the water of the bay
inline constexpr float kWorldEdge = 15000;

/// 6 x 6 core blocks in a ring of backdrop blocks. The lake is a kPark, the hill park a kPlaza.
StreetPlan PlanSfCity();

/// What a block is for.
enum class Quarter { kHouses, kShops, kTowers, kLake, kHillPark };
Quarter QuarterOf(const Block& block);

/// The ground: hills over which streets run in grades from level crossing to level crossing, level across; streets of the hills
/// bend by up to a fifth of a right angle.
class Hills {
 public:
  explicit Hills(const StreetPlan& plan);

  /// Height of the ground of a plan's point, metres; 0 downtown and at the lake, below kBayLevel in the bay.
  float Height(Vec2f p) const;
  /// Where a plan's point lies in W.
  Vec3f Ground(Vec2f p) const;
  const Drape& drape() const { return drape_; }

 private:
  float Raw(Vec2f p) const;
  float SteepestStreet(const StreetPlan& plan) const;

  std::vector<StreetLine> ns_, ew_;
  float pavement_ = 4, scale_ = 1;
  Drape drape_;
};

}  // namespace airsim360::internal

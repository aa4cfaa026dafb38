// The shapes of a procedural person.
#pragma once

#include <algorithm>

#include "airsim360/people/body/anatomy.h"
#include "airsim360/people/body/loft.h"
#include "airsim360/people/body/wardrobe.h"

namespace airsim360::internal {

inline constexpr int kBodyLevels = 4;

/// What the parts of a figure are built from.
struct FigureContext {
  const Body& body;
  const Proportions& p;
  const Wardrobe& wear;
  int level;  ///< of detail, 0 to 3

  double H() const { return p.stature; }
  Vec3d joint(Joint j) const { return body.p_PJ[At(j)]; }
  /// Segments around and steps between rings, coarser by level.
  int Around(int fine) const;
  int Steps(int fine) const { return level == 0 ? fine : level == 1 ? std::max(1, fine - 1) : 1; }
};

void AddTrunk(const FigureContext& context, LoftMesh& mesh);
void AddLegs(const FigureContext& context, LoftMesh& mesh);
void AddArms(const FigureContext& context, LoftMesh& mesh);
void AddHead(const FigureContext& context, LoftMesh& mesh);
/// Phone, bag, umbrella and stroller, each rigid on its bone at rest. Shared by all bodies: sizes in metres.
void AddProps(const std::array<Vec3d, kJointCount>& p_PJ, double stature, uint32_t first_material, LoftMesh& mesh);

/// Every level-th ring of a list for the coarsest level, else all.
std::vector<LoftRing> Thinned(std::vector<LoftRing> rings, int level);

}  // namespace airsim360::internal

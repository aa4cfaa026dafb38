// Parcels and building volumes of the blocks of a street plan: footprints, heights, styles; no geometry yet.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "airsim360/scene/scene.h"
#include "airsim360/worlds/kit/street_plan.h"

namespace airsim360 {

enum class FacadeStyle {
  kBrickWalkUp,
  kClassicStone,
  kStuccoShutters,
  kConcreteGrid,
  kCurtainWall,
  kBrickLoft,
  kRibbon,
  kDeco,         ///< stone piers from base to cornice, paired windows between them
  kBrownstone,   ///< a row house with a stoop
  kBracedGlass,  ///< dark curtain wall behind diagonal braces
  kTerracotta,   ///< a rusticated base, brick and terracotta above it, a cornice of copper
  kGlazedDeco,   ///< slender piers of glazed brick that rise past the roof, decorated spandrels between them
  kCount
};

/// Styles by their names (FacadeStyleNames); InputError naming the nearest.
std::vector<FacadeStyle> StylesOf(const std::vector<std::string>& names);

enum class EdgeKind {
  kStreet,  ///< full dress, shops below
  kRear,    ///< windows without ornament
  kParty,   ///< shared with a neighbour; bare above its roof
};

enum class RoofKind { kFlatGravel, kFlatBitumen, kHipTile, kHipSlate };

/// One building, or one tier of a stepped one: a convex outline extruded from `base`.
struct BuildingPlan {
  std::vector<Vec2f> outline;       ///< counter-clockwise from above
  std::vector<EdgeKind> edges;      ///< edge i runs from corner i to corner i + 1
  std::vector<float> party_height;  ///< of the neighbour behind a party edge, else 0
  int floors = 4;                   ///< above the ground floor
  FacadeStyle style = FacadeStyle::kBrickWalkUp;
  int palette = 0;
  RoofKind roof = RoofKind::kFlatGravel;
  uint64_t seed = 0;
  float cornice = 1;           ///< scale of the cornice of its style
  bool canopies = true;        ///< over its lobby
  bool shops = true;           ///< on the ground floor towards streets; else windows and doors
  size_t block = 0;            ///< index into StreetPlan::blocks
  float base = 0;              ///< > 0: a tier on the roof of the plan before it, part of the same building
  std::vector<Vec2f> upper;    ///< outline of the tier that stands on this roof; empty = none
  GroundRect kept_free{};      ///< part of the deck where no machines stand; empty = none
  int mural_edge = -1;         ///< party wall that is kept bare for a picture; -1 = none
  bool fire_escapes = true;    ///< where its style has them
  int curtain_floor = -1;      ///< storey whose windows all have red curtains; -1 = none
  bool awnings = true;         ///< its shops may have some
  std::string name;            ///< of the entity; empty = "building"
  float first_storey() const;  ///< height of the first storey above the ground floor (or of the tier's foot)
  float height() const;        ///< of the eaves or the roof deck, metres
  GroundRect bounds() const;
};

/// Storey heights of a style.
struct StyleMetrics {
  float ground_height, floor_height, bay;
  int palettes;
};
const StyleMetrics& MetricsOf(FacadeStyle style);

/// Buildings of all built and backdrop blocks, block by block. A perimeter of parcels around a courtyard.
std::vector<BuildingPlan> PlanBuildings(const StreetPlan& plan, uint64_t seed);
/// Sets party_height of plans[first …]: party walls are hidden up to the roof of the neighbour they touch.
void HidePartyWalls(std::vector<BuildingPlan>& plans, size_t first);
/// The open middle of a built block (its perimeter buildings are this deep at most).
GroundRect CourtyardOf(const Block& block);

/// A convex outline moved inwards by `d` (outwards where negative).
std::vector<Vec2f> OffsetConvex(const std::vector<Vec2f>& outline, float d);

/// Ground within plan.reach() that no building stands on, square metres.
double FreeGroundArea(const StreetPlan& plan, const std::vector<BuildingPlan>& buildings);

}  // namespace airsim360

// The parts of sf_city that its builder puts together.
#pragma once

#include <optional>

#include "airsim360/worlds/building/bay_house.h"
#include "airsim360/worlds/sf_city/hills.h"
#include "airsim360/worlds/town/district.h"

namespace airsim360::internal {

inline constexpr float kSetback = 2.4f;  ///< of row houses behind the pavement

/// A row house: its own frame lies on the plan at `origin` (front corner, left seen from the street).
struct RowHouse {
  size_t block = 0;
  Vec2f origin, along, inward;  ///< on the plan
  float ground = 0;             ///< z of the house's z = 0 in W
  float rear = 0;               ///< height of the yard behind it over `ground`
  int scheme = 0;               ///< of colours
  BayHouse shape;
  Vec2f At(float s, float d) const { return origin + along * s + inward * d; }
};

/// Any other building, on the plan's own axes; a tier has `ground` of the building that it stands on.
struct PlacedBuilding {
  BuildingPlan plan;
  float ground = 0;
  float foot = 0;  ///< how far its walls reach below `ground`
};

/// The yard behind a house down to the middle of the block.
struct HillYard {
  size_t block = 0;
  GroundRect rect;
  float out = 1;  ///< +1: the house stands south of it
};

struct SfPlan {
  std::vector<RowHouse> houses;
  std::vector<PlacedBuilding> buildings;
  std::vector<HillYard> yards;
  std::vector<GroundRect> plazas;  ///< open lots among the towers
};
SfPlan PlanSfBuildings(const StreetPlan& plan, const Hills& hills, uint64_t seed);

/// Ground of W minus footprints, square metres, within plan.reach().
double FreeSfGround(const StreetPlan& plan, const SfPlan& city);

/// How props come to stand on the hills; while `building` is set, on a building in plan coordinates.
class SlopeLay {
 public:
  explicit SlopeLay(const Hills& hills) : hills_(hills) {}
  AffineTransform operator()(std::string_view kind, const AffineTransform& placed) const;
  /// From the plan around `at`, z over `ground`, to W: for rigid things, which stay upright.
  AffineTransform Rigid(Vec2f at, float ground) const;
  std::optional<AffineTransform> building;

 private:
  const Hills& hills_;
};

/// Colour schemes of the row houses: surfaces in which wall, trim, frame, door and garage differ.
std::vector<Surfaces> AddHouseSchemes(SceneBuilder& builder, const Surfaces& surfaces);

void BuildSfBuildings(District& district, const Hills& hills, const SfPlan& city, SlopeLay& lay);
/// Front gardens, drives and back yards.
void LaySfYards(District& district, const SfPlan& city);
/// Squares and parking lots behind shops and between towers.
void LayOpenGround(District& district, const SfPlan& city);
/// The park on the slope: lawns, walks, stairs, a look-out, a playground.
void BuildHillPark(District& district, const Hills& hills, const Block& block);
void FurnishSfPavements(District& district, const Hills& hills, const SfPlan& city);
void FurnishSfStreets(District& district, const Hills& hills, const std::vector<StreetStretch>& streets);
/// Poles with wires over the pavements of the hills and over the trolley street; rails and cable cars.
void HangSfWires(District& district, const Hills& hills);
void LayCableCarLine(District& district, const Hills& hills);
/// Far blocks, hills, the bay and its other shore. `far` is a ground that nothing lays.
void BuildFarSf(District& district, Ground& far, const Hills& hills);

}  // namespace airsim360::internal

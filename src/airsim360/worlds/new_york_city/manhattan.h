// Parcels and buildings of Manhattan blocks: two rows of lots back to back, towers with setbacks among walk-ups and
// row houses of 20 to 25 feet, as in the streets that give the figures of data/osm/distributions.csv.
#pragma once

#include <string>
#include <vector>

#include "airsim360/worlds/building/massing.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360::internal {

/// What a lot is used for.
enum class LotUse {
  kBuilding,
  kPlaza,  ///< paved, with fountain and café
  kDirt,   ///< a building site
};

/// A parcel: lot `index` of `count` in row `row` (0 faces the street to the south, 1 to the north).
struct Lot {
  size_t block = 0;
  int row = 0, index = 0, count = 0;
  GroundRect rect;
  LotUse use = LotUse::kBuilding;
  std::string role;     ///< "" or the name of a hand-set lot: "deco corner", "grid tower", …
  std::string name;     ///< of its buildings; "" = they have none
  float height = 0;     ///< of the highest roof
  float podium = 0;     ///< of the roof at the street
  bool houses = false;  ///< cut into narrow houses, each with a back yard
  FacadeStyle style = FacadeStyle::kBrickWalkUp;
  bool boards = true;  ///< signs may hang on its walls above the shops
  bool corner() const { return index == 0 || index + 1 == count; }
};

/// The yard behind a house, down to the middle of the block.
struct BackYard {
  size_t block = 0;
  GroundRect rect;
  float out = 1;  ///< +1: the house stands south of it, -1: north
};

struct Manhattan {
  std::vector<Lot> lots;
  std::vector<BuildingPlan> buildings;  ///< block by block; a tier follows the one that it stands on
  std::vector<BackYard> yards;
};

/// How tall and how mixed: 1 is New York's Midtown.
struct ManhattanOptions {
  uint64_t seed = 0;
  float height_scale = 1;
  std::vector<FacadeStyle> styles = {};  ///< of lots that are not hand-set; empty = all
  CityStyle style = CityStyle::kPresent;
};
Manhattan PlanManhattan(const StreetPlan& plan, const ManhattanOptions& options);

/// The lot of that role; InputError if there is none.
const Lot& LotOf(const Manhattan& city, std::string_view role);

}  // namespace airsim360::internal

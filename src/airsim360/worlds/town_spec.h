// A town by its measures: what `town:` of a world file, and words, say.
#pragma once

#include <cstdint>

#include "airsim360/base/config.h"

namespace airsim360 {

enum class TownPlan { kGrid, kOrganic, kRadial, kLinear, kScattered };
enum class TownStyle { kModern, kBrick, kAzulejo, kOchre, kTimber, kWhitewashed, kStone, kSuburban, kIndustrial, kMixed };
enum class TownRelief { kFlat, kRolling, kSlope, kHill, kValley };
/// kIsland: the sea on all sides.
enum class TownWater { kNone, kSea, kRiver, kLake, kCanal, kIsland };
enum class TownPaving { kAsphalt, kCobbles, kCalcada, kDirt };
/// What goes on around the town, to the horizon.
enum class TownCountry { kCity, kFields, kForest, kDesert };
/// Of walls and of roofs; kStyle: as the style of the houses has them.

enum class TownColours { kStyle, kWhite, kOchre, kBright, kRed, kGrey };
enum class TownRoofs { kStyle, kTiled, kSlate, kFlat };

inline constexpr const char* kTownColours[] = {"style", "white", "ochre", "bright", "red", "grey"};
inline constexpr const char* kTownRoofs[] = {"style", "tiled", "slate", "flat"};
inline constexpr const char* kTownPlans[] = {"grid", "organic", "radial", "linear", "scattered"};
inline constexpr const char* kTownStyles[] = {"modern",      "brick", "azulejo",  "ochre",      "timber",
                                              "whitewashed", "stone", "suburban", "industrial", "mixed"};
inline constexpr const char* kTownReliefs[] = {"flat", "rolling", "slope", "hill", "valley"};
inline constexpr const char* kTownWaters[] = {"none", "sea", "river", "lake", "canal", "island"};
inline constexpr const char* kTownPavings[] = {"asphalt", "cobbles", "calcada", "dirt"};
inline constexpr const char* kTownCountries[] = {"city", "fields", "forest", "desert"};

struct TownSpec {
  static constexpr double kLeastSide = 120, kMostSide = 1200, kMostFloors = 60, kMostClimb = 120;

  TownPlan plan = TownPlan::kGrid;
  TownStyle style = TownStyle::kMixed;
  TownRelief relief = TownRelief::kFlat;
  TownWater water = TownWater::kNone;
  TownPaving paving = TownPaving::kAsphalt;
  TownCountry country = TownCountry::kCity;
  TownColours colours = TownColours::kStyle;
  TownRoofs roofs = TownRoofs::kStyle;
  double width = 360, depth = 320;  ///< metres east and north
  double climb = 20;                ///< metres between the lowest and the highest ground; flat towns have none
  double least_floors = 2, most_floors = 5;
  double street = 10, block = 70;  ///< metres: between walls of a street, its pavements included; of a block
  double built = 0.9;              ///< share of the street fronts that have a house
  double setback = 0;              ///< metres of front gardens; > 0: houses stand apart
  double trees = 1, traffic = 1;   ///< of streets; cars at the kerb and in the lanes
  uint64_t squares = 1, parks = 1;
  uint64_t houses = 0;  ///< at most so many; 0 = as many as fit
  bool church = false, castle = false, clock_tower = false, windmill = false, market = false, cafes = false, ruins = false, arches = false,
       wires = false, harbour = false, playground = false, fountain = false, towers = false, palms = false, terrace = false,
       cycle_lanes = false;
  bool lamps = true, bus_stops = false;
  bool central_water = false;  ///< a river, canal or lake lies in the middle

  /// On one side, or on all.
  bool at_sea() const { return water == TownWater::kSea || water == TownWater::kIsland; }

  /// Names the fields.
  void Visit(ConfigVisitor& v);
  /// InputError, beginning with `prefix`, where two fields exclude each other.
  void Check(const char* prefix) const;
};

}  // namespace airsim360

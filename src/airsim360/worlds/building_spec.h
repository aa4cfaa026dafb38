// A building by its measures: what `building:` of a world file says, seen from inside.
#pragma once

#include <cstdint>
#include <utility>

#include "airsim360/base/config.h"

namespace airsim360 {

enum class BuildingUse { kApartment, kOffice, kWarehouse, kMall, kCarPark, kLibrary };
inline constexpr const char* kBuildingUses[] = {"apartment", "office", "warehouse", "mall", "car_park", "library"};

struct BuildingSpec {
  static constexpr double kLeastSide = 10, kMostSide = 120;
  static constexpr uint64_t kMostStoreys = 6;

  BuildingUse use = BuildingUse::kApartment;
  double width = 0, depth = 0;  ///< metres east and north, between the faces of the outer walls; 0 = as usual for the use
  uint64_t storeys = 0;         ///< 0 = as usual for the use
  double storey_height = 0;     ///< metres from floor to floor; 0 = as usual for the use
  double open_doors = 0.6;      ///< share of the doors that stand open
  double clutter = 1;           ///< how much stands about, 1 = as in use
  bool furnished = true;        ///< false: no furniture, goods and cars; what is fixed stays (lamps, sinks, kitchen units)
  bool atrium = false;          ///< a hall through all storeys (offices, libraries; malls have one anyway)

  /// Names the fields.
  void Visit(ConfigVisitor& v);
  /// InputError, beginning with `prefix`, for measures that a building of this use cannot have.
  void Check(const char* prefix) const;
  /// Metres east and north that the plan of a use needs.
  static std::pair<double, double> LeastSides(BuildingUse use);
  /// The same with every 0 replaced by what is usual for the use.
  BuildingSpec Settled() const;
};

}  // namespace airsim360

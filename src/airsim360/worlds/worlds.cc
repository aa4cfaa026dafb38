#include "airsim360/worlds/worlds.h"

#include "airsim360/base/error.h"
#include "airsim360/worlds/built_in.h"

namespace airsim360 {
namespace {

struct BuiltIn {
  std::string_view name;
  WorldInfo (*info)();
  std::shared_ptr<const Scene> (*build)(const WorldOptions&);
};

constexpr BuiltIn kBuiltIn[] = {
    {"apartment", internal::ApartmentInfo, internal::BuildApartment},
    {"box_room", internal::BoxRoomInfo, internal::BuildBoxRoom},
    {"building", internal::BuildingInfo, internal::BuildBuilding},
    {"car_park", internal::CarParkInfo, internal::BuildCarPark},
    {"city_park", internal::CityParkInfo, internal::BuildCityPark},
    {"downtown_city", internal::DowntownCityInfo, internal::BuildDowntownCity},
    {"downtown_west", internal::DowntownWestInfo, internal::BuildDowntownWest},
    {"lisbon_downtown", internal::LisbonDowntownInfo, internal::BuildLisbonDowntown},
    {"mall", internal::MallInfo, internal::BuildMall},
    {"map_town", internal::MapTownInfo, internal::BuildMapTown},
    {"new_york_city", internal::NewYorkCityInfo, internal::BuildNewYorkCity},
    {"new_york_city_1950s", internal::NewYorkCity1950sInfo, internal::BuildNewYorkCity1950s},
    {"office", internal::OfficeInfo, internal::BuildOffice},
    {"rome", internal::RomeInfo, internal::BuildRome},
    {"roof", internal::RoofInfo, internal::BuildRoof},
    {"rural_cabins", internal::RuralCabinsInfo, internal::BuildRuralCabins},
    {"sf_city", internal::SfCityInfo, internal::BuildSfCity},
    {"sunlit_room", internal::SunlitRoomInfo, internal::BuildSunlitRoom},
    {"town", internal::TownInfo, internal::BuildTown},
    {"warehouse", internal::WarehouseInfo, internal::BuildWarehouse},
};

}  // namespace

const std::vector<WorldInfo>& ListWorlds() {
  static const std::vector<WorldInfo> list = [] {
    std::vector<WorldInfo> infos;
    for (const BuiltIn& world : kBuiltIn) infos.push_back(world.info());
    return infos;
  }();
  return list;
}

std::optional<BuildingRooms> RoomsOfWorld(std::string_view name, const WorldOptions& options) {
  return internal::RoomsOfBuilding(name, options);
}

std::shared_ptr<const Scene> BuildWorld(std::string_view name, const WorldOptions& options) {
  std::vector<std::string> names;
  for (const BuiltIn& world : kBuiltIn) {
    if (world.name == name) return world.build(options);
    names.emplace_back(world.name);
  }
  throw InputError(UnknownChoiceMessage("world", name, names));
}

}  // namespace airsim360

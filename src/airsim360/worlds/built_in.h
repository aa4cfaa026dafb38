// The built-in worlds, one function each; worlds.cc lists them.
#pragma once

#include <memory>
#include <vector>

#include "airsim360/scene/scene.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
struct Placement;
}

namespace airsim360::internal {

/// The analytic test world of docs/reference/contracts.md: inner faces at x = ±5, y = ±5, z = 0, z = 6; a cube of edge
/// 1 m centred at (3, 0, 0.5), without its bottom face, which would coincide with the floor. Seven entities,
/// no sky.
std::shared_ptr<const Scene> BuildBoxRoom(const WorldOptions& options);
WorldInfo BoxRoomInfo();

/// A furnished room of 6 x 5 m with two windows of clear glass, and a garden outside.
std::shared_ptr<const Scene> BuildSunlitRoom(const WorldOptions& options);
WorldInfo SunlitRoomInfo();

/// A downtown of nine blocks around a plaza and a park, with backdrop to the horizon.
std::shared_ptr<const Scene> BuildDowntownWest(const WorldOptions& options);
/// The same; `placements` receives every prop that was placed by the rule of free footprints.
std::shared_ptr<const Scene> BuildDowntownWest(const WorldOptions& options, std::vector<Placement>* placements);
WorldInfo DowntownWestInfo();

/// Nine blocks of Midtown Manhattan around a crossing, with a lake park and a skyline.
std::shared_ptr<const Scene> BuildNewYorkCity(const WorldOptions& options);
/// The same; `placements` as above.
std::shared_ptr<const Scene> BuildNewYorkCity(const WorldOptions& options, std::vector<Placement>* placements);
WorldInfo NewYorkCityInfo();

/// The same streets in the 1950s: BuildNewYorkCity with options.city.style.
std::shared_ptr<const Scene> BuildNewYorkCity1950s(const WorldOptions& options);
WorldInfo NewYorkCity1950sInfo();

/// A park around the bend of a road, with a lake, groves and lawns, woods to the horizon.
std::shared_ptr<const Scene> BuildCityPark(const WorldOptions& options);
/// The same; `placements` as above.
std::shared_ptr<const Scene> BuildCityPark(const WorldOptions& options, std::vector<Placement>* placements);
WorldInfo CityParkInfo();

/// 36 blocks of San Francisco over hills and down to a boulevard of towers, with two parks and a bay.
std::shared_ptr<const Scene> BuildSfCity(const WorldOptions& options);
/// The same; `placements` as above, on the flat plan of the streets.
std::shared_ptr<const Scene> BuildSfCity(const WorldOptions& options, std::vector<Placement>* placements);
WorldInfo SfCityInfo();

/// A town of wall-to-wall houses, drawn as a map (osm/town_map.h) and built as maps are.
std::shared_ptr<const Scene> BuildMapTown(const WorldOptions& options);
WorldInfo MapTownInfo();

/// Towns of the town maker (town_maker/named_towns.cc): five by name, and one of the measures in options.town.
std::shared_ptr<const Scene> BuildDowntownCity(const WorldOptions& options);
WorldInfo DowntownCityInfo();
std::shared_ptr<const Scene> BuildLisbonDowntown(const WorldOptions& options);
WorldInfo LisbonDowntownInfo();
std::shared_ptr<const Scene> BuildRome(const WorldOptions& options);
WorldInfo RomeInfo();
std::shared_ptr<const Scene> BuildRoof(const WorldOptions& options);
WorldInfo RoofInfo();
std::shared_ptr<const Scene> BuildRuralCabins(const WorldOptions& options);
WorldInfo RuralCabinsInfo();
std::shared_ptr<const Scene> BuildTown(const WorldOptions& options);
WorldInfo TownInfo();

/// Buildings from inside (interior/interiors.cc): five by name, and one of the measures in options.building.
std::shared_ptr<const Scene> BuildApartment(const WorldOptions& options);
WorldInfo ApartmentInfo();
std::shared_ptr<const Scene> BuildOffice(const WorldOptions& options);
WorldInfo OfficeInfo();
std::shared_ptr<const Scene> BuildWarehouse(const WorldOptions& options);
WorldInfo WarehouseInfo();
std::shared_ptr<const Scene> BuildMall(const WorldOptions& options);
WorldInfo MallInfo();
std::shared_ptr<const Scene> BuildCarPark(const WorldOptions& options);
WorldInfo CarParkInfo();
std::shared_ptr<const Scene> BuildBuilding(const WorldOptions& options);
WorldInfo BuildingInfo();
std::optional<BuildingRooms> RoomsOfBuilding(std::string_view name, const WorldOptions& options);

}  // namespace airsim360::internal

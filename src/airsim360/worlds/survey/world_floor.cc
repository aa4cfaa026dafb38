#include "airsim360/worlds/survey/world_floor.h"

#include <array>
#include <set>
#include <string>
#include <string_view>

#include "airsim360/worlds/building/massing.h"
#include "airsim360/worlds/new_york_city/manhattan.h"
#include "airsim360/worlds/sf_city/city.h"

namespace airsim360 {
namespace {

// Categories that the AirSim360 paper lists for its scenes of these names.
constexpr std::array kNewYork = {"traffic/barrier/concrete_block",
                                 "furniture/misc",
                                 "traffic/temporary/cone",
                                 "barrier/fence/metal_fence",
                                 "construction/pillar",
                                 "furniture/lighting/street_light",
                                 "furniture/waste/trash_can",
                                 "furniture/mail/post_box",
                                 "furniture/shade/umbrella",
                                 "furniture/table",
                                 "furniture/seating/chair",
                                 "furniture/planter/green_pot",
                                 "traffic/bollard/road_column",
                                 "signage/billboard",
                                 "construction/awning",
                                 "construction/scaffolding",
                                 "signage/flag/usa",
                                 "vegetation/plant",
                                 "construction/rooftop/ventilation_tube",
                                 "construction/building",
                                 "furniture/vending/hotdog_cart",
                                 "ground/road",
                                 "ground/sidewalk",
                                 "ground/dirt",
                                 "sky"};
constexpr std::array kDowntown = {"barrier/fence/wood_fence",
                                  "barrier/railing/pillar",
                                  "barrier/railing/rail",
                                  "construction/awning",
                                  "construction/building",
                                  "construction/building/roof",
                                  "furniture/lighting/lamp_post",
                                  "furniture/lighting/street_light",
                                  "furniture/planter/pot",
                                  "furniture/seating/bench/wood",
                                  "furniture/seating/chair",
                                  "furniture/shade/tarp",
                                  "furniture/shade/tarp_post",
                                  "furniture/shade/umbrella",
                                  "furniture/table/dining_table",
                                  "furniture/vending/food_cart",
                                  "furniture/waste/recycle_bin",
                                  "ground/path/park_walkway",
                                  "ground/pavement/modular",
                                  "ground/road",
                                  "ground/terrain/landscape",
                                  "nature/mountain",
                                  "nature/rock",
                                  "signage/poster_stand",
                                  "traffic/bollard/car_pillar",
                                  "vegetation/tree/broadleaf/generic",
                                  "vegetation/tree/broadleaf/narrowleaf",
                                  "vegetation/tree/conifer/pine",
                                  "sky"};
constexpr std::array kSanFrancisco = {"construction/building",
                                      "ground/sidewalk",
                                      "ground/road",
                                      "vehicle/bus",
                                      "barrier/fence",
                                      "traffic/temporary/cone",
                                      "furniture/utility/fire_hydrant",
                                      "furniture/utility/parking_meter",
                                      "furniture/transit/bus_stop",
                                      "furniture/utility/electric_box",
                                      "furniture/waste/trash",
                                      "traffic/temporary/tube",
                                      "traffic/barrier/barrier",
                                      "furniture/lighting/lamp_post/type_a",
                                      "furniture/lighting/lamp_post/type_b",
                                      "water/lake",
                                      "barrier/rope_bollard",
                                      "traffic/barrier/metal_barricade",
                                      "vegetation/tree/broadleaf/generic",
                                      "sky"};

// Those with three entities or more (there is one sky, and one lake is a lake).
template <size_t N>
double Present(const std::array<const char*, N>& categories, const WorldSurvey& survey) {
  double present = 0;
  for (const std::string_view path : categories) {
    const auto it = survey.categories.find(std::string(path));
    present += it != survey.categories.end() && it->second >= (path == "sky" || path == "water/lake" ? 1 : 3);
  }
  return present;
}

double Styles(const std::vector<BuildingPlan>& buildings, const GroundRect& reach) {
  std::set<FacadeStyle> styles;
  for (const BuildingPlan& plan : buildings)
    if (reach.Contains(plan.bounds().center())) styles.insert(plan.style);
  return static_cast<double>(styles.size());
}

// The kinds of row houses count as styles, too.
double SfStyles() {
  const StreetPlan plan = internal::PlanSfCity();
  const internal::SfPlan city = internal::PlanSfBuildings(plan, internal::Hills(plan), 0);
  std::vector<BuildingPlan> buildings;
  for (const internal::PlacedBuilding& placed : city.buildings) buildings.push_back(placed.plan);
  std::set<BayHouse::Kind> kinds;
  for (const internal::RowHouse& house : city.houses) kinds.insert(house.shape.kind);
  return Styles(buildings, plan.reach()) + static_cast<double>(kinds.size());
}

struct Floor {
  double area, inside, backdrop, styles, lamps, cars, manholes, instances, triangles, trees, species, meshes, road, pavement, categories,
      entities;
};

}  // namespace

std::vector<FloorRow> StructuralFloor(std::string_view world, const WorldSurvey& s) {
  const bool old = world == "new_york_city_1950s", new_york = old || world == "new_york_city", sf = world == "sf_city";
  if (!new_york && !sf && world != "downtown_west") return {};
  const Floor floor = sf         ? Floor{250000, 110, 60, 10, 440, 710, 200, 110e3, 200e6, 500, 2, 8, 4100, 8100, 20, 10000}
                      : new_york ? Floor{44800, 20, 60, 8, 80, 130, 35, 20e3, 50e6, 60, 2, 6, 700, 1500, 25, 3000}
                                 : Floor{60000, 27, 60, 5, 100, 60, 30, 27e3, 60e6, 150, 3, 9, 1000, 1900, 29, 3000};
  const StreetPlan plan = new_york ? PlanNewYorkCity() : PlanDowntownWest();
  const auto style = old ? CityStyle::k1950s : CityStyle::kPresent;
  const double styles =
      sf ? SfStyles() : Styles(new_york ? internal::PlanManhattan(plan, {.style = style}).buildings : PlanBuildings(plan, 0), plan.reach());
  return {{"ground, m2", floor.area, s.ground_area_m2},
          {"buildings inside", floor.inside, static_cast<double>(s.buildings_inside)},
          {"buildings of the backdrop to 600 m", floor.backdrop, static_cast<double>(s.buildings_backdrop)},
          {"facade styles", floor.styles, styles},
          {"lamp posts", floor.lamps, static_cast<double>(s.lamp_posts)},
          {"parked and driving cars", floor.cars, static_cast<double>(s.cars)},
          {"manholes", floor.manholes, static_cast<double>(s.manholes)},
          {"instances", floor.instances, static_cast<double>(s.counts.instances)},
          {"triangles with instances", floor.triangles, static_cast<double>(s.counts.instanced_triangles)},
          {"trees", floor.trees, static_cast<double>(s.trees)},
          {"species of trees", floor.species, static_cast<double>(s.tree_species)},
          {"distinct trees", floor.meshes, static_cast<double>(s.tree_meshes)},
          {"road, m", floor.road, s.road_m},
          {"pavement, m", floor.pavement, s.pavement_m},
          {"categories of the paper, three each", floor.categories,
           sf         ? Present(kSanFrancisco, s)
           : new_york ? Present(kNewYork, s)
                      : Present(kDowntown, s)},
          {"entities", floor.entities, static_cast<double>(s.counts.entities)}};
}

}  // namespace airsim360

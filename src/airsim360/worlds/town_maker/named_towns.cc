// The towns that are built in, by their measures.
#include <algorithm>
#include <array>
#include <iterator>
#include <span>

#include "airsim360/base/error.h"
#include "airsim360/worlds/built_in.h"
#include "airsim360/worlds/town_maker/town_build.h"

namespace airsim360::internal {
namespace {

struct Named {
  std::string_view name;
  const char* description;
  TownSpec spec;
  double area_m2;  ///< that can be walked on, of seed 0
};

// Longer than a screen because it is a table: a town for each name.
const std::array<Named, 6>& Towns() {
  static const std::array<Named, 6> towns{{
      {"downtown_city",
       "a downtown of towers on podiums around three plazas with fountains, trees and cafés, wide streets with traffic and cycle lanes, high-rises to the horizon",
       {.plan = TownPlan::kGrid,
        .style = TownStyle::kModern,
        .width = 420,
        .depth = 360,
        .least_floors = 9,
        .most_floors = 40,
        .street = 22,
        .block = 92,
        .built = 0.96,
        .trees = 1.1,
        .traffic = 1.2,
        .squares = 3,
        .parks = 1,
        .cafes = true,
        .fountain = true,
        .cycle_lanes = true},
       99763},
      {"lisbon_downtown",
       "narrow streets on a hillside: tiled and painted houses of four to six storeys under roofs of clay tiles, calçada, tram rails and wires, squares with cafés",
       {.plan = TownPlan::kOrganic,
        .style = TownStyle::kAzulejo,
        .relief = TownRelief::kSlope,
        .paving = TownPaving::kCalcada,
        .width = 380,
        .depth = 340,
        .climb = 40,
        .least_floors = 3,
        .most_floors = 6,
        .street = 8.3,
        .block = 52,
        .built = 0.97,
        .trees = 0.6,
        .traffic = 0.6,
        .squares = 2,
        .parks = 1,
        .church = true,
        .cafes = true,
        .arches = true,
        .wires = true},
       90751},
      {"rome",
       "ochre houses over cobbled lanes with arches, squares with a fountain, a market and café terraces, ruins of temples, umbrella pines and cypresses",
       {.plan = TownPlan::kOrganic,
        .style = TownStyle::kOchre,
        .relief = TownRelief::kRolling,
        .paving = TownPaving::kCobbles,
        .width = 380,
        .depth = 340,
        .climb = 9,
        .least_floors = 3,
        .most_floors = 5,
        .street = 8.2,
        .block = 60,
        .built = 0.96,
        .trees = 0.9,
        .traffic = 0.5,
        .squares = 3,
        .parks = 1,
        .church = true,
        .market = true,
        .cafes = true,
        .ruins = true,
        .arches = true,
        .fountain = true},
       105057},
      {"roof",
       "a terrace of 70 x 58 m on a roof, with boards, beds of plants, pergola, tables, machines and water tanks, in a city of brick and towers to the horizon",
       {.plan = TownPlan::kGrid,
        .style = TownStyle::kBrick,
        .width = 420,
        .depth = 380,
        .least_floors = 7,
        .most_floors = 15,
        .street = 20,
        .block = 92,
        .built = 0.98,
        .traffic = 1.1,
        .squares = 0,
        .parks = 1,
        .towers = true,
        .terrace = true},
       121508},
      {"rural_cabins",
       "cabins of timber with porches along dirt tracks through a forest of conifers, a lake with a jetty and rowing boats, hills to the horizon",
       {.plan = TownPlan::kScattered,
        .style = TownStyle::kTimber,
        .relief = TownRelief::kRolling,
        .water = TownWater::kLake,
        .paving = TownPaving::kDirt,
        .country = TownCountry::kForest,
        .width = 300,
        .depth = 300,
        .climb = 11,
        .least_floors = 1,
        .most_floors = 2,
        .street = 9,
        .block = 62,
        .built = 0.8,
        .trees = 1,
        .traffic = 0,
        .squares = 0,
        .parks = 1,
        .harbour = true},
       120708},
      {"town", "a town of your own measures: the key `town` of a world file, or `airsim360 world make` from words", {}, 80000},
  }};
  return towns;
}

const Named& Find(std::string_view name) {
  return *std::find_if(Towns().begin(), Towns().end(), [&](const Named& town) { return town.name == name; });
}

// Categories of seed 0 beyond those that all towns have.
constexpr std::string_view kEveryTown[] = {"construction/building",
                                           "construction/building/roof",
                                           "furniture/seating/bench/wood",
                                           "ground/dirt",
                                           "ground/kerb",
                                           "ground/path/park_walkway",
                                           "ground/road",
                                           "ground/terrain/landscape",
                                           "sky",
                                           "vegetation/plant",
                                           "vegetation/shrub/bush",
                                           "vegetation/tree/broadleaf/generic",
                                           "vegetation/tree/broadleaf/narrowleaf"};
constexpr std::string_view kDowntownCategories[] = {"construction/awning",
                                                    "construction/building/backdrop",
                                                    "construction/fountain",
                                                    "construction/rooftop/air_conditioner",
                                                    "construction/rooftop/antenna",
                                                    "construction/rooftop/ventilation_tube",
                                                    "construction/rooftop/water_tank",
                                                    "construction/statue",
                                                    "furniture/lighting/street_light",
                                                    "furniture/planter/green_pot",
                                                    "furniture/seating/chair",
                                                    "furniture/shade/umbrella",
                                                    "furniture/table/dining_table",
                                                    "furniture/utility/fire_hydrant",
                                                    "furniture/waste/trash_can",
                                                    "ground/bike_lane",
                                                    "ground/crosswalk",
                                                    "ground/grass",
                                                    "ground/lane_marking",
                                                    "ground/manhole",
                                                    "ground/pavement/modular",
                                                    "ground/sidewalk",
                                                    "signage/poster_stand",
                                                    "signage/shop_sign",
                                                    "signage/traffic_sign",
                                                    "traffic/control/traffic_light",
                                                    "vehicle/bicycle",
                                                    "vehicle/car",
                                                    "vehicle/van"};
constexpr std::string_view kLisbonCategories[] = {"construction/awning",
                                                  "construction/balcony",
                                                  "construction/building/backdrop",
                                                  "construction/building/part",
                                                  "construction/statue",
                                                  "furniture/lighting/lamp_post",
                                                  "furniture/planter/green_pot",
                                                  "furniture/seating/chair",
                                                  "furniture/shade/umbrella",
                                                  "furniture/table/dining_table",
                                                  "furniture/utility/fire_hydrant",
                                                  "furniture/utility/wire",
                                                  "furniture/waste/trash_can",
                                                  "ground/grass",
                                                  "ground/manhole",
                                                  "ground/pavement/modular",
                                                  "ground/rail",
                                                  "ground/sidewalk",
                                                  "signage/poster_stand",
                                                  "signage/shop_sign",
                                                  "signage/traffic_sign",
                                                  "vehicle/car",
                                                  "vehicle/tram",
                                                  "vehicle/van"};
constexpr std::string_view kRomeCategories[] = {"construction/awning",
                                                "construction/balcony",
                                                "construction/building/backdrop",
                                                "construction/building/part",
                                                "construction/column",
                                                "construction/fountain",
                                                "construction/rooftop/air_conditioner",
                                                "construction/rooftop/antenna",
                                                "construction/rooftop/ventilation_tube",
                                                "construction/rooftop/water_tank",
                                                "construction/stairs",
                                                "construction/statue",
                                                "construction/wall",
                                                "furniture/lighting/lamp_post",
                                                "furniture/planter/green_pot",
                                                "furniture/seating/chair",
                                                "furniture/shade/tarp",
                                                "furniture/shade/tarp_post",
                                                "furniture/shade/umbrella",
                                                "furniture/table/dining_table",
                                                "furniture/utility/fire_hydrant",
                                                "furniture/vending/food_stall",
                                                "furniture/waste/trash_can",
                                                "ground/grass",
                                                "ground/manhole",
                                                "ground/pavement/modular",
                                                "ground/sidewalk",
                                                "nature/rock",
                                                "signage/poster_stand",
                                                "signage/shop_sign",
                                                "signage/traffic_sign",
                                                "vegetation/tree/conifer/cypress",
                                                "vegetation/tree/conifer/pine",
                                                "vehicle/car",
                                                "vehicle/van",
                                                "water/lake"};
constexpr std::string_view kRoofCategories[] = {"barrier/fence",
                                                "barrier/railing/rail",
                                                "construction/awning",
                                                "construction/building/backdrop",
                                                "construction/building/part",
                                                "construction/rooftop/air_conditioner",
                                                "construction/rooftop/antenna",
                                                "construction/rooftop/ventilation_tube",
                                                "construction/rooftop/water_tank",
                                                "construction/wall",
                                                "furniture/lighting/lamp_post/type_b",
                                                "furniture/lighting/street_light",
                                                "furniture/planter/green_pot",
                                                "furniture/planter/pot",
                                                "furniture/seating/chair",
                                                "furniture/shade/tarp_post",
                                                "furniture/shade/umbrella",
                                                "furniture/table",
                                                "furniture/table/dining_table",
                                                "furniture/utility/fire_hydrant",
                                                "furniture/waste/trash_can",
                                                "ground/crosswalk",
                                                "ground/floor",
                                                "ground/grass",
                                                "ground/gravel",
                                                "ground/lane_marking",
                                                "ground/manhole",
                                                "ground/pavement/modular",
                                                "ground/sidewalk",
                                                "signage/shop_sign",
                                                "signage/traffic_sign",
                                                "traffic/control/traffic_light",
                                                "vegetation/flower",
                                                "vehicle/car",
                                                "vehicle/van",
                                                "water/lake"};
constexpr std::string_view kCabinCategories[] = {"construction/balcony",
                                                 "construction/bridge",
                                                 "construction/building/part",
                                                 "construction/wall",
                                                 "furniture/misc",
                                                 "nature/mountain",
                                                 "nature/rock",
                                                 "vegetation/grass_tuft",
                                                 "vegetation/tree/conifer/pine",
                                                 "vehicle/boat",
                                                 "water/lake"};

std::span<const std::string_view> CategoriesOf(std::string_view name) {
  if (name == "downtown_city") return kDowntownCategories;
  if (name == "lisbon_downtown") return kLisbonCategories;
  if (name == "rome") return kRomeCategories;
  if (name == "roof") return kRoofCategories;
  if (name == "rural_cabins") return kCabinCategories;
  return {};
}

WorldInfo InfoOf(std::string_view name) {
  const Named& town = Find(name);
  WorldInfo info{std::string(name), "outdoor", town.area_m2, {std::begin(kEveryTown), std::end(kEveryTown)}, town.description};
  for (std::string_view category : CategoriesOf(name)) info.categories.emplace_back(category);
  std::sort(info.categories.begin(), info.categories.end());
  return info;
}

std::shared_ptr<const Scene> Build(std::string_view name, const WorldOptions& options) {
  return BuildTownScene(std::string(name), NamedTown(name), options);
}

}  // namespace

const TownSpec& NamedTown(std::string_view name) { return Find(name).spec; }

std::shared_ptr<const Scene> BuildDowntownCity(const WorldOptions& options) { return Build("downtown_city", options); }
WorldInfo DowntownCityInfo() { return InfoOf("downtown_city"); }
std::shared_ptr<const Scene> BuildLisbonDowntown(const WorldOptions& options) { return Build("lisbon_downtown", options); }
WorldInfo LisbonDowntownInfo() { return InfoOf("lisbon_downtown"); }
std::shared_ptr<const Scene> BuildRome(const WorldOptions& options) { return Build("rome", options); }
WorldInfo RomeInfo() { return InfoOf("rome"); }
std::shared_ptr<const Scene> BuildRoof(const WorldOptions& options) { return Build("roof", options); }
WorldInfo RoofInfo() { return InfoOf("roof"); }
std::shared_ptr<const Scene> BuildRuralCabins(const WorldOptions& options) { return Build("rural_cabins", options); }
WorldInfo RuralCabinsInfo() { return InfoOf("rural_cabins"); }
std::shared_ptr<const Scene> BuildTown(const WorldOptions& options) { return BuildTownScene("town", options.town, options); }
WorldInfo TownInfo() { return InfoOf("town"); }

}  // namespace airsim360::internal

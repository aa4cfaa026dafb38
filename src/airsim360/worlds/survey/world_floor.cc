#include "airsim360/worlds/survey/world_floor.h"

#include <array>
#include <set>

#include "airsim360/worlds/building/massing.h"
#include "airsim360/worlds/new_york_city/manhattan.h"

namespace airsim360 {
namespace {

// Categories that the AirSim360 paper lists for its scenes of these names.
constexpr std::array kNewYork = {
    "traffic/barrier/concrete_block", "furniture/misc", "traffic/temporary/cone", "barrier/fence/metal_fence",
    "construction/pillar", "furniture/lighting/street_light", "furniture/waste/trash_can", "furniture/mail/post_box",
    "furniture/shade/umbrella", "furniture/table", "furniture/seating/chair", "furniture/planter/green_pot",
    "traffic/bollard/road_column", "signage/billboard", "construction/awning", "construction/scaffolding",
    "signage/flag/usa", "vegetation/plant", "construction/rooftop/ventilation_tube", "construction/building",
    "furniture/vending/hotdog_cart", "ground/road", "ground/sidewalk", "ground/dirt", "sky"};
constexpr std::array kDowntown = {
    "barrier/fence/wood_fence", "barrier/railing/pillar", "barrier/railing/rail", "construction/awning",
    "construction/building", "construction/building/roof", "furniture/lighting/lamp_post", "furniture/lighting/street_light",
    "furniture/planter/pot", "furniture/seating/bench/wood", "furniture/seating/chair", "furniture/shade/tarp",
    "furniture/shade/tarp_post", "furniture/shade/umbrella", "furniture/table/dining_table", "furniture/vending/food_cart",
    "furniture/waste/recycle_bin", "ground/path/park_walkway", "ground/pavement/modular", "ground/road",
    "ground/terrain/landscape", "nature/mountain", "nature/rock", "signage/poster_stand", "traffic/bollard/car_pillar",
    "vegetation/tree/broadleaf/generic", "vegetation/tree/broadleaf/narrowleaf", "vegetation/tree/conifer/pine", "sky"};

// Those with three entities or more (there is one sky).
template <size_t N>
double Present(const std::array<const char*, N>& categories, const WorldSurvey& survey) {
  double present = 0;
  for (const std::string path : categories) {
    const auto it = survey.categories.find(path);
    present += it != survey.categories.end() && it->second >= (path == "sky" ? 1 : 3);
  }
  return present;
}

double Styles(const std::vector<BuildingPlan>& buildings, const GroundRect& reach) {
  std::set<FacadeStyle> styles;
  for (const BuildingPlan& plan : buildings)
    if (reach.Contains(plan.bounds().center())) styles.insert(plan.style);
  return static_cast<double>(styles.size());
}

struct Floor {
  double area, inside, backdrop, styles, lamps, cars, manholes, instances, triangles, trees, species, meshes, road, pavement,
      categories, entities;
};

}  // namespace

std::vector<FloorRow> StructuralFloor(std::string_view world, const WorldSurvey& s) {
  const bool new_york = world == "new_york_city";
  if (!new_york && world != "downtown_west") return {};
  const Floor floor = new_york ? Floor{44800, 20, 60, 8, 80, 130, 35, 20e3, 50e6, 60, 2, 6, 700, 1500, 25, 3000}
                               : Floor{60000, 27, 60, 5, 100, 60, 30, 27e3, 60e6, 150, 3, 9, 1000, 1900, 29, 3000};
  const StreetPlan plan = new_york ? PlanNewYorkCity() : PlanDowntownWest();
  const double styles = Styles(new_york ? internal::PlanManhattan(plan, {}).buildings : PlanBuildings(plan, 0), plan.reach());
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
           new_york ? Present(kNewYork, s) : Present(kDowntown, s)},
          {"entities", floor.entities, static_cast<double>(s.counts.entities)}};
}

}  // namespace airsim360

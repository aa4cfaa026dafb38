#include "airsim360/dataset/export/paper_classes.h"

#include <algorithm>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

struct Row {
  const char* world;
  const char* name;
  const char* path;
};

// Spellings are the paper's, "Buidlingawning" too.
constexpr Row kRows[] = {
    {"city_park", "Building", "construction/building"},
    {"city_park", "Rock", "nature/rock"},
    {"city_park", "AmurCork", "vegetation/tree/broadleaf/amur_cork"},
    {"city_park", "Bush", "vegetation/shrub/bush"},
    {"city_park", "Elm", "vegetation/tree/broadleaf/elm"},
    {"city_park", "Ivy", "vegetation/climber/ivy"},
    {"city_park", "Maple", "vegetation/tree/broadleaf/maple"},
    {"city_park", "WeepingWillow", "vegetation/tree/broadleaf/weeping_willow"},
    {"city_park", "PlayGround", "furniture/recreation/playground"},
    {"city_park", "Bench", "furniture/seating/bench"},
    {"city_park", "LampPost", "furniture/lighting/lamp_post"},
    {"city_park", "FoodStalls", "furniture/vending/food_stall"},
    {"city_park", "Cafechair", "furniture/seating/chair"},
    {"city_park", "Roadblock", "traffic/barrier/road_block"},
    {"city_park", "Trashcan", "furniture/waste/trash_can"},
    {"city_park", "Trafficbarrel", "traffic/temporary/traffic_barrel"},
    {"city_park", "Circlefence", "barrier/fence/circle_fence"},
    {"city_park", "Trafficlight", "traffic/control/traffic_light"},
    {"city_park", "Water Plane", "water/water_plane"},
    {"city_park", "Road", "ground/road"},
    {"city_park", "Cafetable", "furniture/table/cafe_table"},
    {"city_park", "Umbrella", "furniture/shade/umbrella"},
    {"city_park", "Pool Sidewalk", "ground/sidewalk/pool_edge"},
    {"city_park", "Sky", "sky"},
    {"city_park", "Landscape", "ground/terrain/landscape"},
    {"downtown_west", "Building", "construction/building"},
    {"downtown_west", "Awning", "construction/awning"},
    {"downtown_west", "Roof", "construction/building/roof"},
    {"downtown_west", "Tree Generic", "vegetation/tree/broadleaf/generic"},
    {"downtown_west", "Tree Narrowleaf", "vegetation/tree/broadleaf/narrowleaf"},
    {"downtown_west", "Tree Pine", "vegetation/tree/conifer/pine"},
    {"downtown_west", "Prop Dining Table", "furniture/table/dining_table"},
    {"downtown_west", "Umbrella", "furniture/shade/umbrella"},
    {"downtown_west", "Prop Dining Chair", "furniture/seating/chair"},
    {"downtown_west", "Pot", "furniture/planter/pot"},
    {"downtown_west", "Car Pillar", "traffic/bollard/car_pillar"},
    {"downtown_west", "Recycle Bin", "furniture/waste/recycle_bin"},
    {"downtown_west", "Food Cart", "furniture/vending/food_cart"},
    {"downtown_west", "Bench Wood", "furniture/seating/bench/wood"},
    {"downtown_west", "Poster Stand", "signage/poster_stand"},
    {"downtown_west", "Ground Mod", "ground/pavement/modular"},
    {"downtown_west", "Road", "ground/road"},
    {"downtown_west", "Lightpost Light Post", "furniture/lighting/lamp_post"},
    {"downtown_west", "Tarppost", "furniture/shade/tarp_post"},
    {"downtown_west", "Light Streetlight Complete", "furniture/lighting/street_light"},
    {"downtown_west", "Tarponly", "furniture/shade/tarp"},
    {"downtown_west", "Ground Park Walkway", "ground/path/park_walkway"},
    {"downtown_west", "Rock Rock", "nature/rock"},
    {"downtown_west", "Background Mountains", "nature/mountain"},
    {"downtown_west", "Wood Fence Wood Fence", "barrier/fence/wood_fence"},
    {"downtown_west", "Prop Park Railing Rail", "barrier/railing/rail"},
    {"downtown_west", "Prop Park Railing Pillar", "barrier/railing/pillar"},
    {"downtown_west", "Sky", "sky"},
    {"downtown_west", "Landscape", "ground/terrain/landscape"},
    {"sf_city", "Building", "construction/building"},
    {"sf_city", "Sidewalk", "ground/sidewalk"},
    {"sf_city", "Road", "ground/road"},
    {"sf_city", "Bus", "vehicle/bus"},
    {"sf_city", "Fence", "barrier/fence"},
    {"sf_city", "Cone", "traffic/temporary/cone"},
    {"sf_city", "Hydrant", "furniture/utility/fire_hydrant"},
    {"sf_city", "Parkingmeter", "furniture/utility/parking_meter"},
    {"sf_city", "Stopstation", "furniture/transit/bus_stop"},
    {"sf_city", "Elecbox", "furniture/utility/electric_box"},
    {"sf_city", "Trash", "furniture/waste/trash"},
    {"sf_city", "Traffictube", "traffic/temporary/tube"},
    {"sf_city", "Barrier", "traffic/barrier/barrier"},
    {"sf_city", "Alamppost", "furniture/lighting/lamp_post/type_a"},
    {"sf_city", "Blamppost", "furniture/lighting/lamp_post/type_b"},
    {"sf_city", "Lake", "water/lake"},
    {"sf_city", "Bollardrope", "barrier/rope_bollard"},
    {"sf_city", "Barricademetal", "traffic/barrier/metal_barricade"},
    {"sf_city", "Tree", "vegetation/tree/broadleaf/generic"},
    {"sf_city", "Sky", "sky"},
    {"new_york_city", "Concreteblock", "traffic/barrier/concrete_block"},
    {"new_york_city", "Streetprops", "furniture/misc"},
    {"new_york_city", "Plasticcone", "traffic/temporary/cone"},
    {"new_york_city", "Metalfence", "barrier/fence/metal_fence"},
    {"new_york_city", "Pillar", "construction/pillar"},
    {"new_york_city", "Lamp", "furniture/lighting/street_light"},
    {"new_york_city", "Trashcan", "furniture/waste/trash_can"},
    {"new_york_city", "Postbox", "furniture/mail/post_box"},
    {"new_york_city", "Umbrella", "furniture/shade/umbrella"},
    {"new_york_city", "Table", "furniture/table"},
    {"new_york_city", "Chair", "furniture/seating/chair"},
    {"new_york_city", "Greenpot", "furniture/planter/green_pot"},
    {"new_york_city", "Roadcolumn", "traffic/bollard/road_column"},
    {"new_york_city", "Adplane", "signage/billboard"},
    {"new_york_city", "Buidlingawning", "construction/awning"},
    {"new_york_city", "Scaffolding", "construction/scaffolding"},
    {"new_york_city", "Usaflag", "signage/flag/usa"},
    {"new_york_city", "Plant", "vegetation/plant"},
    {"new_york_city", "Ventilationtube", "construction/rooftop/ventilation_tube"},
    {"new_york_city", "Building", "construction/building"},
    {"new_york_city", "Hotdogpot", "furniture/vending/hotdog_cart"},
    {"new_york_city", "Road", "ground/road"},
    {"new_york_city", "Sidewalk", "ground/sidewalk"},
    {"new_york_city", "Grounddirt", "ground/dirt"},
    {"new_york_city", "Sky", "sky"},
};

// Parts that we label apart and the paper's scenes do not: the surface that a part belongs to, the first one that the
// scene has. Meshes of the paper's roads carry their markings.
struct Part {
  const char *part, *whole;
};
constexpr Part kParts[] = {{"ground/lane_marking", "ground/road"},
                           {"ground/crosswalk", "ground/road"},
                           {"ground/bike_lane", "ground/road"},
                           {"ground/manhole", "ground/road"},
                           {"ground/parking", "ground/road"},
                           {"ground/kerb", "ground/sidewalk"},
                           {"ground/kerb", "ground/pavement/modular"},
                           {"ground/kerb", "ground/road"},
                           {"ground/sidewalk", "ground/pavement/modular"},
                           {"ground/pavement", "ground/sidewalk"},
                           {"ground/grass", "ground/terrain/landscape"},
                           {"ground/dirt", "ground/terrain/landscape"},
                           {"ground/gravel", "ground/terrain/landscape"},
                           {"ground/sand", "ground/terrain/landscape"}};

struct SceneNames {
  const char *world, *record, *list;
};
constexpr SceneNames kScenes[] = {{"city_park", "CityPark", "citypark"},
                                  {"downtown_west", "DowntownWest", "dtw"},
                                  {"sf_city", "SFCity", "sf"},
                                  {"new_york_city", "NYC", "nyc"}};

std::string ParentPath(const std::string& path) {
  const size_t slash = path.rfind('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash);
}

SceneClasses OwnClasses(const std::string& world, const NativeDataset& data) {
  // A world may be a path.
  std::string name = std::filesystem::path(world).stem().string();
  std::ranges::replace_if(
      name, [](char c) { return c == '/' || c == ' '; }, '_');
  SceneClasses classes{.record = name, .list = name, .names = {}, .id_of = {}};
  for (const auto& [id, category] : data.categories()) {
    if (id > 255)
      throw InputError("--format omni360: '" + category.path + "' has the id " + std::to_string(id) +
                       ", the format has one byte: worlds with custom labels do not fit");
    classes.names.resize(id);
    classes.names[id - 1] = category.path;
    classes.id_of[id] = static_cast<uint8_t>(id);
  }
  return classes;
}

using Classes = std::map<std::string, uint8_t>;

// That of the nearest ancestor of `path`, itself included; 0 if none has one.
uint8_t ClassOfAncestor(const Classes& of_path, std::string path) {
  for (; !path.empty(); path = ParentPath(path))
    if (const auto found = of_path.find(path); found != of_path.end()) return found->second;
  return 0;
}

uint8_t ClassOfWhole(const Classes& of_path, const std::string& path) {
  for (const Part& part : kParts) {
    const bool within = path == part.part || path.starts_with(std::string(part.part) + "/");
    const auto whole = of_path.find(part.whole);
    if (within && whole != of_path.end()) return whole->second;
  }
  return 0;
}

}  // namespace

uint8_t SceneClasses::IdOf(CategoryId category) const {
  const auto found = id_of.find(category);
  return found == id_of.end() ? 0 : found->second;
}

SceneClasses ClassesOf(const std::string& world, const NativeDataset& data) {
  const auto scene = std::ranges::find(kScenes, world, [](const SceneNames& s) { return std::string(s.world); });
  if (scene == std::end(kScenes)) return OwnClasses(world, data);
  SceneClasses classes{.record = scene->record, .list = scene->list, .names = {}, .id_of = {}};
  Classes of_path;
  for (const Row& row : kRows) {
    if (world != row.world) continue;
    classes.names.push_back(row.name);
    of_path.emplace(row.path, static_cast<uint8_t>(classes.names.size()));
  }
  for (const auto& [id, category] : data.categories()) {
    uint8_t found = ClassOfAncestor(of_path, category.path);
    if (found == 0) found = ClassOfWhole(of_path, category.path);
    if (found != 0) classes.id_of[id] = found;
  }
  return classes;
}

}  // namespace airsim360::internal

// The built-in category tree: our own data, from the categories of the AirSim360 paper's four scenes plus
// what Cityscapes, COCO, ADE20K and indoor worlds need. Append only: the id of a row is its position plus
// one.
#include "airsim360/scene/semantics.h"

#include <algorithm>
#include <array>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/nearest_name.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

struct Row {
  const char* path;
  bool thing;
  int ade20k, cityscapes, coco;
};

// clang-format off
constexpr Row kRows[] = {
    {"animal", true, -1, -1, -1},
    {"animal/bird", true, 126, -1, 16},
    {"animal/cat", true, 126, -1, 17},
    {"animal/dog", true, 126, -1, 18},
    {"animal/horse", true, 126, -1, 19},
    {"barrier", true, -1, -1, -1},
    {"barrier/fence", true, 32, 13, 185},
    {"barrier/fence/circle_fence", true, 32, 13, 185},
    {"barrier/fence/metal_fence", true, 32, 13, 185},
    {"barrier/fence/wood_fence", true, 32, 13, 185},
    {"barrier/railing", true, -1, -1, -1},
    {"barrier/railing/pillar", true, 42, 13, 185},
    {"barrier/railing/rail", true, 38, 13, 185},
    {"barrier/rope_bollard", true, 93, 17, -1},
    {"barrier/wall", true, -1, -1, -1},
    {"barrier/wall/guard_rail", true, 95, 14, 185},
    {"construction", true, -1, -1, -1},
    {"construction/awning", true, 86, 11, 197},
    {"construction/balcony", true, 38, 11, 197},
    {"construction/bridge", true, 61, 15, 95},
    {"construction/building", true, 1, 11, 197},
    {"construction/building/roof", true, 1, 11, 151},
    {"construction/ceiling", true, 5, -1, 186},
    {"construction/chimney", true, 1, 11, 197},
    {"construction/column", true, 42, 11, 197},
    {"construction/door", true, 14, 11, 112},
    {"construction/escalator", true, 96, -1, 161},
    {"construction/fountain", true, 104, 4, -1},
    {"construction/house", true, 25, 11, 128},
    {"construction/phone_booth", true, 88, 4, -1},
    {"construction/pillar", true, 42, 11, 197},
    {"construction/rooftop", true, -1, -1, -1},
    {"construction/rooftop/air_conditioner", true, 1, 11, 197},
    {"construction/rooftop/antenna", true, 1, 11, 197},
    {"construction/rooftop/solar_panel", true, 1, 11, 197},
    {"construction/rooftop/ventilation_tube", true, -1, 11, 197},
    {"construction/rooftop/water_tank", true, 1, 11, 197},
    {"construction/scaffolding", true, -1, 4, -1},
    {"construction/stairs", true, 53, -1, 161},
    {"construction/statue", true, 132, 4, -1},
    {"construction/tower", true, 84, 11, 197},
    {"construction/tunnel", true, -1, 16, -1},
    {"construction/wall", true, 0, 12, 199},
    {"construction/window", true, 8, 11, 181},
    {"furniture", true, -1, -1, -1},
    {"furniture/bathtub", true, 37, -1, -1},
    {"furniture/bed", true, 7, -1, 65},
    {"furniture/book", true, 67, -1, 84},
    {"furniture/box", true, 41, 4, -1},
    {"furniture/cabinet", true, 10, -1, 188},
    {"furniture/curtain", true, 18, -1, 109},
    {"furniture/desk", true, 33, -1, 69},
    {"furniture/electronics", true, -1, -1, -1},
    {"furniture/electronics/computer", true, 74, -1, 73},
    {"furniture/electronics/refrigerator", true, 50, -1, 82},
    {"furniture/electronics/television", true, 89, -1, 72},
    {"furniture/kitchen", true, -1, -1, -1},
    {"furniture/kitchen/microwave", true, 124, -1, 78},
    {"furniture/kitchen/oven", true, 118, -1, 79},
    {"furniture/lighting", true, -1, -1, -1},
    {"furniture/lighting/lamp", true, 36, -1, 130},
    {"furniture/lighting/lamp_post", true, 87, 17, 130},
    {"furniture/lighting/lamp_post/type_a", true, 87, 17, 130},
    {"furniture/lighting/lamp_post/type_b", true, 87, 17, 130},
    {"furniture/lighting/street_light", true, 87, 17, 130},
    {"furniture/mail", true, -1, -1, -1},
    {"furniture/mail/post_box", true, 41, 4, -1},
    {"furniture/mirror", true, 27, -1, 133},
    {"furniture/misc", true, -1, 4, -1},
    {"furniture/painting", true, 22, -1, -1},
    {"furniture/planter", true, -1, -1, -1},
    {"furniture/planter/green_pot", true, 125, 4, 64},
    {"furniture/planter/pot", true, 125, 4, 64},
    {"furniture/recreation", true, -1, -1, -1},
    {"furniture/recreation/playground", true, 108, 4, -1},
    {"furniture/rug", true, 28, -1, 200},
    {"furniture/seating", true, -1, -1, -1},
    {"furniture/seating/bench", true, 69, 4, 15},
    {"furniture/seating/bench/wood", true, 69, 4, 15},
    {"furniture/seating/chair", true, 19, 4, 62},
    {"furniture/shade", true, -1, -1, -1},
    {"furniture/shade/tarp", true, 106, 4, 166},
    {"furniture/shade/tarp_post", true, 93, 17, -1},
    {"furniture/shade/umbrella", true, 106, 4, 28},
    {"furniture/shelf", true, 24, -1, 156},
    {"furniture/sink", true, 47, -1, 81},
    {"furniture/sofa", true, 23, -1, 63},
    {"furniture/table", true, 15, 4, 189},
    {"furniture/table/cafe_table", true, 15, 4, 189},
    {"furniture/table/dining_table", true, 15, 4, 67},
    {"furniture/toilet", true, 65, -1, 70},
    {"furniture/transit", true, -1, -1, -1},
    {"furniture/transit/bus_stop", true, 88, 4, -1},
    {"furniture/utility", true, -1, -1, -1},
    {"furniture/utility/electric_box", true, 41, 4, -1},
    {"furniture/utility/fire_hydrant", true, -1, 4, 11},
    {"furniture/utility/parking_meter", true, -1, 4, 14},
    {"furniture/vase", true, 135, -1, 86},
    {"furniture/vending", true, -1, -1, -1},
    {"furniture/vending/food_cart", true, 88, 5, -1},
    {"furniture/vending/food_stall", true, 88, 4, -1},
    {"furniture/vending/hotdog_cart", true, 88, 5, -1},
    {"furniture/waste", true, -1, -1, -1},
    {"furniture/waste/recycle_bin", true, 138, 4, -1},
    {"furniture/waste/trash", true, 138, 4, -1},
    {"furniture/waste/trash_can", true, 138, 4, -1},
    {"ground", false, -1, -1, -1},
    {"ground/bike_lane", false, 6, 7, 149},
    {"ground/crosswalk", false, 6, 7, 149},
    {"ground/dirt", false, 13, 22, 194},
    {"ground/floor", false, 3, -1, 190},
    {"ground/grass", false, 9, 22, 193},
    {"ground/gravel", false, 13, 22, 125},
    {"ground/kerb", false, 11, 8, 191},
    {"ground/lane_marking", false, 6, 7, 149},
    {"ground/manhole", false, 6, 7, 149},
    {"ground/parking", false, 6, 9, 149},
    {"ground/path", false, -1, -1, -1},
    {"ground/path/park_walkway", false, 52, 8, 191},
    {"ground/pavement", false, -1, -1, -1},
    {"ground/pavement/modular", false, 11, 8, 191},
    {"ground/road", false, 6, 7, 149},
    {"ground/sand", false, 46, 22, 154},
    {"ground/sidewalk", false, 11, 8, 191},
    {"ground/sidewalk/pool_edge", false, 11, 8, 191},
    {"ground/terrain", false, -1, -1, -1},
    {"ground/terrain/landscape", false, 9, 22, 193},
    {"human", true, -1, -1, -1},
    {"human/person", true, 12, 24, 1},
    {"human/rider", true, 12, 25, 1},
    {"nature", true, -1, -1, -1},
    {"nature/hill", true, 68, 22, 192},
    {"nature/mountain", false, 16, 22, 192},
    {"nature/rock", true, 34, 22, 198},
    {"nature/terrain", true, 13, 22, 194},
    {"object", true, -1, -1, -1},
    {"signage", true, -1, -1, -1},
    {"signage/billboard", true, 43, 4, 92},
    {"signage/flag", true, 149, 4, 92},
    {"signage/flag/usa", true, 149, 4, 92},
    {"signage/poster", true, 100, 4, 92},
    {"signage/poster_stand", true, 100, 4, 92},
    {"signage/shop_sign", true, 43, 4, 92},
    {"signage/traffic_sign", true, 43, 20, 13},
    {"sky", false, 2, 23, 187},
    {"traffic", true, -1, -1, -1},
    {"traffic/barrier", true, -1, -1, -1},
    {"traffic/barrier/barrier", true, 32, 14, 185},
    {"traffic/barrier/concrete_block", true, -1, 14, 199},
    {"traffic/barrier/metal_barricade", true, 32, 13, 185},
    {"traffic/barrier/road_block", true, 32, 14, 185},
    {"traffic/bollard", true, -1, -1, -1},
    {"traffic/bollard/car_pillar", true, 93, 17, -1},
    {"traffic/bollard/road_column", true, 93, 17, -1},
    {"traffic/control", true, -1, -1, -1},
    {"traffic/control/parking_meter", true, -1, 4, 14},
    {"traffic/control/traffic_light", true, 136, 19, 10},
    {"traffic/temporary", true, -1, -1, -1},
    {"traffic/temporary/cone", true, -1, 5, -1},
    {"traffic/temporary/traffic_barrel", true, 111, 4, -1},
    {"traffic/temporary/tube", true, -1, 17, -1},
    {"uav", true, -1, -1, -1},
    {"uav/other", true, 90, -1, 5},
    {"uav/self", true, 90, -1, 5},
    {"vegetation", true, -1, -1, -1},
    {"vegetation/climber", true, -1, -1, -1},
    {"vegetation/climber/ivy", true, 17, 21, 184},
    {"vegetation/flower", true, 66, 21, 119},
    {"vegetation/grass_tuft", true, 9, 21, 193},
    {"vegetation/hedge", true, 17, 21, 184},
    {"vegetation/plant", true, 17, 21, 64},
    {"vegetation/shrub", true, -1, -1, -1},
    {"vegetation/shrub/bush", true, 17, 21, 184},
    {"vegetation/tree", true, -1, -1, -1},
    {"vegetation/tree/broadleaf", true, -1, -1, -1},
    {"vegetation/tree/broadleaf/amur_cork", true, 4, 21, 184},
    {"vegetation/tree/broadleaf/elm", true, 4, 21, 184},
    {"vegetation/tree/broadleaf/generic", true, 4, 21, 184},
    {"vegetation/tree/broadleaf/maple", true, 4, 21, 184},
    {"vegetation/tree/broadleaf/narrowleaf", true, 4, 21, 184},
    {"vegetation/tree/broadleaf/weeping_willow", true, 4, 21, 184},
    {"vegetation/tree/conifer", true, -1, -1, -1},
    {"vegetation/tree/conifer/pine", true, 4, 21, 184},
    {"vegetation/tree/palm", true, 72, 21, 184},
    {"vehicle", true, -1, -1, -1},
    {"vehicle/bicycle", true, 127, 33, 2},
    {"vehicle/boat", true, 76, -1, 9},
    {"vehicle/bus", true, 80, 28, 6},
    {"vehicle/car", true, 20, 26, 3},
    {"vehicle/food_truck", true, 83, 27, 8},
    {"vehicle/motorcycle", true, 116, 32, 4},
    {"vehicle/trailer", true, -1, 30, 8},
    {"vehicle/tram", true, -1, 31, 7},
    {"vehicle/truck", true, 83, 27, 8},
    {"vehicle/van", true, 102, 26, 3},
    {"water", false, -1, -1, -1},
    {"water/lake", false, 128, 0, 178},
    {"water/pool", false, 109, 0, 178},
    {"water/puddle", false, 21, 0, 178},
    {"water/river", false, 60, 0, 148},
    {"water/sea", false, 26, 0, 155},
    {"water/water_plane", false, 21, 0, 178},
    // Appended later, in order of arrival.
    {"vehicle/airplane", true, 90, -1, 5},
    {"vehicle/helicopter", true, 90, -1, -1},
    {"vehicle/train", true, -1, 31, 7},
    {"furniture/recreation/ferris_wheel", true, -1, 4, -1},
    {"construction/windmill", true, 84, 11, 197},
    {"construction/well", true, -1, 4, -1},
    {"object/phone", true, -1, 5, 77},
    {"object/bag", true, 115, 5, 31},
    {"object/umbrella", true, -1, 5, 28},
    {"object/stroller", true, -1, 5, -1},
    {"construction/building/backdrop", true, 1, 11, 197},
    {"construction/building/part", true, 1, 11, 197},
    {"construction/mast", true, 93, 17, -1},
    {"ground/rail", false, -1, 10, 147},
    {"furniture/utility/camera", true, -1, 5, -1},
    {"furniture/vending/machine", true, -1, 4, -1},
    {"furniture/utility/wire", true, -1, -1, -1},
    {"vegetation/tree/conifer/cypress", true, 4, 21, 184},
    {"furniture/seating/armchair", true, 30, -1, 62},
    {"furniture/seating/office_chair", true, 75, -1, 62},
    {"furniture/wardrobe", true, 35, -1, 188},
    {"furniture/chest_of_drawers", true, 44, -1, 188},
    {"furniture/table/coffee_table", true, 64, -1, 189},
    {"furniture/bookcase", true, 62, -1, 156},
    {"furniture/counter", true, 45, -1, 107},
    {"furniture/kitchen/stove", true, 71, -1, 79},
    {"furniture/kitchen/tableware", true, 142, -1, 51},
    {"furniture/shower", true, 145, -1, -1},
    {"furniture/electronics/washing_machine", true, 107, -1, -1},
    {"furniture/electronics/monitor", true, 143, -1, 72},
    {"furniture/lighting/ceiling_light", true, 82, -1, 130},
    {"furniture/clothes", true, 92, -1, -1},
    {"furniture/coat_rack", true, -1, -1, -1},
    {"furniture/whiteboard", true, 144, -1, -1},
    {"furniture/partition", true, 58, -1, -1},
    {"furniture/radiator", true, 146, -1, -1},
    {"furniture/rack", true, 24, -1, 156},
    {"furniture/pallet", true, -1, -1, -1},
    {"construction/door/lift_door", true, 14, -1, 112},
    {"construction/service", true, -1, -1, -1},
    {"construction/service/duct", true, -1, -1, -1},
    {"construction/service/pipe", true, -1, -1, -1},
    {"construction/service/air_vent", true, -1, -1, -1},
    {"construction/service/fire_extinguisher", true, -1, -1, -1},
    {"construction/service/sprinkler", true, -1, -1, -1},
    {"signage/exit_sign", true, 43, -1, 92},
    {"traffic/control/barrier_gate", true, -1, 14, 185},
    {"vehicle/forklift", true, -1, -1, -1},
};
// clang-format on
static_assert(std::size(kRows) < kFirstCustomId);

bool IsValidPath(std::string_view path) {
  if (path.empty() || path.size() > 200 || path.front() == '/' || path.back() == '/') return false;
  if (path.find("//") != std::string_view::npos || std::count(path.begin(), path.end(), '/') > 7) return false;
  return std::all_of(path.begin(), path.end(),
                     [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '/'; });
}

}  // namespace

SemanticTree::SemanticTree() {
  for (size_t i = 0; i < std::size(kRows); ++i) {
    const Row& row = kRows[i];
    const auto id = static_cast<CategoryId>(i + 1);
    categories_[id] = {id, row.path, kVoid, row.thing, row.ade20k, row.cityscapes, row.coco};
    ids_.emplace(row.path, id);
  }
  for (auto& [id, category] : categories_) {
    const size_t slash = category.path.rfind('/');
    if (slash != std::string::npos) category.parent = ids_.at(category.path.substr(0, slash));
  }
}

std::optional<CategoryId> SemanticTree::Find(std::string_view path) const {
  const auto it = ids_.find(path);
  return it == ids_.end() ? std::nullopt : std::optional(it->second);
}

CategoryId SemanticTree::At(std::string_view path) const {
  if (const auto id = Find(path)) return *id;
  std::vector<std::string> paths;
  for (const auto& [known, id] : ids_) paths.push_back(known);
  throw InputError("unknown category '" + std::string(path.substr(0, 200)) + "'" + DidYouMean(path, paths));
}

const Category& SemanticTree::operator[](CategoryId id) const {
  const auto it = categories_.find(id);
  if (it == categories_.end()) throw InputError("unknown category id " + std::to_string(id));
  return it->second;
}

// The id depends on the path alone, unless another path has it (1 in 65,000 pairs, so some of a few hundred
// paths): then it is the next free one.
CategoryId SemanticTree::FreeId(std::string_view path) const {
  constexpr uint64_t kIds = 65536 - kFirstCustomId;
  const uint64_t place = HashName(path) % kIds;
  for (uint64_t k = 0; k < kIds; ++k) {
    const auto id = static_cast<CategoryId>(kFirstCustomId + (place + k) % kIds);
    if (!categories_.contains(id)) return id;
  }
  throw InputError("category path '" + std::string(path) + "': all " + std::to_string(kIds) + " ids of custom categories are taken");
}

std::map<CategoryId, CategoryId> SemanticTree::SettleIds() {
  // All custom categories leave, then come back in order of path.
  std::vector<Category> custom;
  for (const auto& [path, id] : ids_)
    if (id >= kFirstCustomId) custom.push_back(std::move(categories_[id]));
  std::erase_if(categories_, [](const auto& entry) { return entry.first >= kFirstCustomId; });
  std::map<CategoryId, CategoryId> changed;
  for (Category& category : custom) {
    const CategoryId id = FreeId(category.path);
    if (id != category.id) changed[category.id] = id;
    category.id = id;
    // An ancestor is before all below it: its id is the new one.
    const size_t slash = category.path.rfind('/');
    if (slash != std::string::npos) category.parent = ids_.at(category.path.substr(0, slash));
    ids_.at(category.path) = id;
    categories_[id] = std::move(category);
  }
  return changed;
}

CategoryId SemanticTree::Add(std::string_view path, bool thing) {
  if (const auto id = Find(path)) return *id;
  if (!IsValidPath(path)) {
    throw InputError("malformed category path '" + std::string(path.substr(0, 200)) +
                     "': use parts of a-z, 0-9 and _ joined by '/', for example 'vehicle/car'");
  }
  const size_t slash = path.rfind('/');
  const CategoryId parent = slash == std::string_view::npos ? kVoid : Add(path.substr(0, slash), thing);

  const CategoryId id = FreeId(path);
  Category category{id, std::string(path), parent, thing};
  for (CategoryId up = parent; up != kVoid; up = categories_[up].parent) {
    if (category.ade20k < 0) category.ade20k = categories_[up].ade20k;
    if (category.cityscapes < 0) category.cityscapes = categories_[up].cityscapes;
    if (category.coco < 0) category.coco = categories_[up].coco;
  }
  categories_[id] = std::move(category);
  ids_.emplace(path, id);
  return id;
}

}  // namespace airsim360

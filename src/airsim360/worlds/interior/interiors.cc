// The buildings that are built in, by their measures, and any other.
#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <utility>

#include "airsim360/worlds/built_in.h"
#include "airsim360/worlds/interior/furnisher.h"
#include "airsim360/worlds/interior/interior.h"
#include "airsim360/worlds/interior/surroundings.h"

namespace airsim360::internal {
namespace {

struct Named {
  std::string_view name;
  const char* description;
  BuildingSpec spec;
};

const std::array<Named, 6>& Buildings() {
  static const std::array<Named, 6> buildings{{
      {"apartment",
       "a flat of twelve rooms along a corridor, furnished and lived in, with windows to a street and a garden",
       {.use = BuildingUse::kApartment}},
      {"office",
       "a floor of offices: desks in rows, glazed rooms, meeting rooms, two corridors around a core of lifts, stairs and pantry",
       {.use = BuildingUse::kOffice}},
      {"warehouse",
       "a hall 12 m high with pallet racks of up to 10 m, docks, fork-lift trucks and a strip of offices",
       {.use = BuildingUse::kWarehouse}},
      {"mall",
       "a shopping mall on two levels around a glazed hall with escalators and a bridge: shops, a supermarket, a food court",
       {.use = BuildingUse::kMall}},
      {"car_park",
       "three decks of parked cars with ramps between them, open to daylight above their parapets",
       {.use = BuildingUse::kCarPark}},
      {"building", "a building of your own measures: the key `building` of a world file", {}},
  }};
  return buildings;
}

const Named& Find(std::string_view name) {
  return *std::find_if(Buildings().begin(), Buildings().end(), [&](const Named& b) { return b.name == name; });
}

// Categories of seed 0: those of all five, and the rest of each.
constexpr std::string_view kEveryBuilding[] = {"construction/building",
                                               "construction/building/roof",
                                               "construction/ceiling",
                                               "construction/door",
                                               "construction/service",
                                               "construction/wall",
                                               "furniture/lighting/ceiling_light",
                                               "furniture/lighting/street_light",
                                               "furniture/waste/trash_can",
                                               "ground/floor",
                                               "ground/lane_marking",
                                               "ground/path/park_walkway",
                                               "ground/pavement/modular",
                                               "ground/road",
                                               "ground/sidewalk",
                                               "ground/terrain/landscape",
                                               "sky",
                                               "vegetation/tree/broadleaf/generic",
                                               "vegetation/tree/broadleaf/maple",
                                               "vegetation/tree/broadleaf/narrowleaf",
                                               "vehicle/car"};
constexpr std::string_view kApartmentCategories[] = {"construction/service/air_vent",
                                                     "construction/window",
                                                     "furniture/bathtub",
                                                     "furniture/bed",
                                                     "furniture/book",
                                                     "furniture/bookcase",
                                                     "furniture/box",
                                                     "furniture/cabinet",
                                                     "furniture/chest_of_drawers",
                                                     "furniture/clothes",
                                                     "furniture/coat_rack",
                                                     "furniture/counter",
                                                     "furniture/curtain",
                                                     "furniture/desk",
                                                     "furniture/electronics",
                                                     "furniture/electronics/computer",
                                                     "furniture/electronics/monitor",
                                                     "furniture/electronics/refrigerator",
                                                     "furniture/electronics/television",
                                                     "furniture/electronics/washing_machine",
                                                     "furniture/kitchen/stove",
                                                     "furniture/kitchen/tableware",
                                                     "furniture/lighting/lamp",
                                                     "furniture/mirror",
                                                     "furniture/misc",
                                                     "furniture/painting",
                                                     "furniture/planter/pot",
                                                     "furniture/radiator",
                                                     "furniture/rug",
                                                     "furniture/seating/chair",
                                                     "furniture/seating/office_chair",
                                                     "furniture/shower",
                                                     "furniture/sink",
                                                     "furniture/sofa",
                                                     "furniture/table/dining_table",
                                                     "furniture/toilet",
                                                     "furniture/wardrobe",
                                                     "ground/grass",
                                                     "vegetation/flower",
                                                     "vegetation/hedge",
                                                     "vegetation/shrub/bush"};
constexpr std::string_view kOfficeCategories[] = {"construction/service/air_vent",
                                                  "construction/service/fire_extinguisher",
                                                  "construction/service/sprinkler",
                                                  "construction/window",
                                                  "furniture/book",
                                                  "furniture/bookcase",
                                                  "furniture/box",
                                                  "furniture/cabinet",
                                                  "furniture/chest_of_drawers",
                                                  "furniture/coat_rack",
                                                  "furniture/counter",
                                                  "furniture/desk",
                                                  "furniture/electronics",
                                                  "furniture/electronics/computer",
                                                  "furniture/electronics/monitor",
                                                  "furniture/electronics/refrigerator",
                                                  "furniture/electronics/television",
                                                  "furniture/kitchen/tableware",
                                                  "furniture/lighting/lamp",
                                                  "furniture/mirror",
                                                  "furniture/misc",
                                                  "furniture/painting",
                                                  "furniture/partition",
                                                  "furniture/planter/pot",
                                                  "furniture/seating/chair",
                                                  "furniture/seating/office_chair",
                                                  "furniture/sink",
                                                  "furniture/sofa",
                                                  "furniture/table",
                                                  "furniture/table/dining_table",
                                                  "furniture/toilet",
                                                  "furniture/vending/machine",
                                                  "furniture/whiteboard",
                                                  "ground/grass",
                                                  "object/phone",
                                                  "signage/exit_sign",
                                                  "vegetation/flower",
                                                  "vegetation/hedge",
                                                  "vegetation/shrub/bush"};
constexpr std::string_view kWarehouseCategories[] = {"construction/column",
                                                     "construction/service/air_vent",
                                                     "construction/service/duct",
                                                     "construction/service/fire_extinguisher",
                                                     "construction/service/sprinkler",
                                                     "construction/window",
                                                     "furniture/book",
                                                     "furniture/bookcase",
                                                     "furniture/box",
                                                     "furniture/cabinet",
                                                     "furniture/chest_of_drawers",
                                                     "furniture/coat_rack",
                                                     "furniture/counter",
                                                     "furniture/desk",
                                                     "furniture/electronics",
                                                     "furniture/electronics/computer",
                                                     "furniture/electronics/monitor",
                                                     "furniture/electronics/refrigerator",
                                                     "furniture/electronics/television",
                                                     "furniture/kitchen/tableware",
                                                     "furniture/mirror",
                                                     "furniture/misc",
                                                     "furniture/painting",
                                                     "furniture/pallet",
                                                     "furniture/planter/pot",
                                                     "furniture/rack",
                                                     "furniture/seating/chair",
                                                     "furniture/seating/office_chair",
                                                     "furniture/sink",
                                                     "furniture/table",
                                                     "furniture/table/dining_table",
                                                     "furniture/toilet",
                                                     "furniture/utility/electric_box",
                                                     "furniture/vending/machine",
                                                     "furniture/whiteboard",
                                                     "ground/pavement",
                                                     "object/phone",
                                                     "signage/exit_sign",
                                                     "traffic/barrier/barrier",
                                                     "vehicle/forklift"};
constexpr std::string_view kMallCategories[] = {"barrier/railing/rail",
                                                "construction/column",
                                                "construction/escalator",
                                                "construction/service/air_vent",
                                                "construction/service/fire_extinguisher",
                                                "construction/service/sprinkler",
                                                "construction/stairs",
                                                "construction/window",
                                                "furniture/bookcase",
                                                "furniture/box",
                                                "furniture/clothes",
                                                "furniture/counter",
                                                "furniture/electronics/computer",
                                                "furniture/electronics/monitor",
                                                "furniture/electronics/refrigerator",
                                                "furniture/electronics/television",
                                                "furniture/kitchen/tableware",
                                                "furniture/lighting/lamp",
                                                "furniture/mirror",
                                                "furniture/painting",
                                                "furniture/planter/pot",
                                                "furniture/seating/armchair",
                                                "furniture/seating/bench",
                                                "furniture/seating/chair",
                                                "furniture/shelf",
                                                "furniture/sink",
                                                "furniture/sofa",
                                                "furniture/table",
                                                "furniture/table/dining_table",
                                                "furniture/toilet",
                                                "furniture/vending/food_stall",
                                                "furniture/vending/machine",
                                                "ground/grass",
                                                "signage/exit_sign",
                                                "vegetation/flower",
                                                "vegetation/hedge",
                                                "vegetation/shrub/bush"};
constexpr std::string_view kCarParkCategories[] = {"barrier/wall",
                                                   "construction/column",
                                                   "construction/service/duct",
                                                   "construction/service/fire_extinguisher",
                                                   "construction/service/sprinkler",
                                                   "construction/stairs",
                                                   "ground/parking",
                                                   "ground/pavement",
                                                   "signage/exit_sign",
                                                   "signage/traffic_sign",
                                                   "traffic/barrier/concrete_block",
                                                   "traffic/control/parking_meter",
                                                   "traffic/temporary/cone",
                                                   "vegetation/flower",
                                                   "vegetation/hedge",
                                                   "vegetation/shrub/bush"};

std::span<const std::string_view> CategoriesOf(std::string_view name) {
  if (name == "apartment") return kApartmentCategories;
  if (name == "office") return kOfficeCategories;
  if (name == "warehouse") return kWarehouseCategories;
  if (name == "mall") return kMallCategories;
  if (name == "car_park") return kCarParkCategories;
  return {};
}

// A first viewpoint: in the middle of the room that the building is about, at 1.5 m.
Vec3f SpawnOf(const InteriorPlan& plan) {
  using T = RoomType;
  constexpr T kRooms[] = {T::kLivingRoom, T::kOpenOffice, T::kWarehouseHall, T::kAtrium, T::kParkingDeck};
  for (const T type : kRooms) {
    for (const PlanRoom& room : plan.rooms) {
      if (room.type != type || !room.has_floor) continue;
      Vec2f p = room.clear.center();
      if (type == T::kWarehouseHall) p.y = room.clear.y0 + 8.8f;
      if (type == T::kParkingDeck) p.y = room.clear.y0 + 8.2f;
      if (type == T::kAtrium) p = {room.clear.x0 + 2.5f, room.clear.y0 + 2};
      if (type == T::kLivingRoom) p.y = room.clear.y1 - 1.2f;
      return {p.x, p.y, room.floor_z + 1.5f};
    }
  }
  return {plan.outline.center().x, plan.outline.center().y, 1.5f};
}

std::shared_ptr<const Scene> Build(std::string_view name, const BuildingSpec& spec, const WorldOptions& options) {
  const InteriorPlan plan = PlanBuilding(spec, options.seed);
  SceneBuilder builder{std::string(name)};
  builder.AddSky();
  builder.environment().sun_azimuth_deg = 195;
  builder.environment().sun_elevation_deg = 36;
  const Finishes finishes(builder);
  InteriorPen shell(builder, finishes), outside(builder, finishes);
  Furnisher furnisher(builder, options.models, options.seed, spec.furnished);
  BuildShell(plan, shell);
  BuildStairs(plan, shell);
  BuildStructure(plan, shell);
  shell.Done("building");
  InstallServices(plan, furnisher);
  FurnishRooms(plan, furnisher);
  BuildSurroundings(plan, outside, furnisher);
  outside.Done("surroundings");
  builder.SetSpawn(SpawnOf(plan));
  return builder.Build();
}

WorldInfo Info(std::string_view name) {
  const Named& b = Find(name);
  std::vector<std::string> categories(std::begin(kEveryBuilding), std::end(kEveryBuilding));
  for (const std::string_view category : CategoriesOf(name)) categories.emplace_back(category);
  std::sort(categories.begin(), categories.end());
  return {std::string(b.name), "indoor", PlanBuilding(b.spec, 0).area_m2(), std::move(categories), b.description};
}
std::shared_ptr<const Scene> BuildNamed(std::string_view name, const WorldOptions& options) {
  return Build(name, Find(name).spec, options);
}

// The clear opening: frames and leaves left out.
RoomDoor DoorOf(const InteriorPlan& plan, const PlanWall& wall, const PlanOpening& o, const std::vector<uint32_t>& ids) {
  const float frame = o.kind == OpeningKind::kPassage ? 0.0f : 0.045f, middle = wall.from + (o.from + o.to) / 2, height = o.head - frame;
  const auto id = [&](int room) { return room < 0 ? 0u : ids[static_cast<size_t>(room)]; };
  RoomDoor door{.id = static_cast<uint32_t>(o.lock),
                .kind = OpeningKindName(o.kind),
                .open = o.kind == OpeningKind::kPassage ? 1.0 : static_cast<double>(o.open)};
  const float z = plan.StoreyZ(wall.storey) + height / 2;
  door.center = wall.along_x ? Vec3f{middle, wall.at, z} : Vec3f{wall.at, middle, z};
  door.through = wall.along_x ? Vec2f{0, 1} : Vec2f{1, 0};
  door.width = o.to - o.from - 2 * frame;
  door.height = height;
  door.rooms[0] = id(wall.low), door.rooms[1] = id(wall.high);
  return door;
}

}  // namespace

std::optional<BuildingRooms> RoomsOfBuilding(std::string_view name, const WorldOptions& options) {
  const auto found = std::find_if(Buildings().begin(), Buildings().end(), [&](const Named& b) { return b.name == name; });
  if (found == Buildings().end()) return std::nullopt;
  const InteriorPlan plan = PlanBuilding(name == "building" ? options.building : found->spec, options.seed);
  BuildingRooms all;
  std::vector<uint32_t> ids;
  for (const PlanRoom& room : plan.rooms) {
    // What is open to the storey below is part of the room there.
    ids.push_back(room.has_floor ? static_cast<uint32_t>(all.rooms.size() + 1) : 0);
    if (!room.has_floor) continue;
    const PlanRect r = room.clear;
    all.rooms.push_back({ids.back(),
                         room.name,
                         RoomTypeName(room.type),
                         room.storey,
                         {{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}},
                         room.floor_z,
                         room.ceiling_z,
                         static_cast<double>(r.area())});
  }
  for (const PlanWall& wall : plan.walls)
    for (const PlanOpening& o : wall.openings)
      if (IsDoor(o.kind) || o.kind == OpeningKind::kPassage) all.doors.push_back(DoorOf(plan, wall, o, ids));
  return all;
}

std::shared_ptr<const Scene> BuildApartment(const WorldOptions& options) { return BuildNamed("apartment", options); }
WorldInfo ApartmentInfo() { return Info("apartment"); }
std::shared_ptr<const Scene> BuildOffice(const WorldOptions& options) { return BuildNamed("office", options); }
WorldInfo OfficeInfo() { return Info("office"); }
std::shared_ptr<const Scene> BuildWarehouse(const WorldOptions& options) { return BuildNamed("warehouse", options); }
WorldInfo WarehouseInfo() { return Info("warehouse"); }
std::shared_ptr<const Scene> BuildMall(const WorldOptions& options) { return BuildNamed("mall", options); }
WorldInfo MallInfo() { return Info("mall"); }
std::shared_ptr<const Scene> BuildCarPark(const WorldOptions& options) { return BuildNamed("car_park", options); }
WorldInfo CarParkInfo() { return Info("car_park"); }
std::shared_ptr<const Scene> BuildBuilding(const WorldOptions& options) { return Build("building", options.building, options); }
WorldInfo BuildingInfo() { return Info("building"); }

}  // namespace airsim360::internal

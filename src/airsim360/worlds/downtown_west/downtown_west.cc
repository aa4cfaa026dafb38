// downtown_west: a downtown of European and American make around a plaza and a park, people-free.
#include <algorithm>

#include "airsim360/worlds/built_in.h"
#include "airsim360/worlds/props/placed_models.h"
#include "airsim360/worlds/town/buildings.h"
#include "airsim360/worlds/town/district.h"
#include "airsim360/worlds/town/street_lanes.h"

namespace airsim360 {

StreetPlan PlanDowntownWest() {
  StreetPlan plan;
  plan.bike_lane_row = 2;
  plan.north_south = {{-277, 6}, {-165, 6}, {-57, 5.6f}, {53, 7}, {165, 6}, {277, 6}};
  plan.east_west = {{-273, 6}, {-161, 6}, {-53, 7}, {57, 5.6f}, {165, 6}, {277, 6}};
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 5; ++column) {
      const StreetLine &west = plan.north_south[column], &east = plan.north_south[column + 1];
      const StreetLine &south = plan.east_west[row], &north = plan.east_west[row + 1];
      Block block;
      block.column = column;
      block.row = row;
      block.kerb = {west.center + west.half_width, south.center + south.half_width, east.center - east.half_width,
                    north.center - north.half_width};
      const bool core = column >= 1 && column <= 3 && row >= 1 && row <= 3;
      if (!core) block.kind = BlockKind::kBackdrop;
      if (column == 2 && row == 2) block.kind = BlockKind::kPlaza;
      if (column == 3 && row == 2) block.kind = BlockKind::kPark;
      plan.blocks.push_back(block);
    }
  }
  return plan;
}

}  // namespace airsim360

namespace airsim360::internal {
std::shared_ptr<const Scene> BuildDowntownWest(const WorldOptions& options) { return BuildDowntownWest(options, nullptr); }

std::shared_ptr<const Scene> BuildDowntownWest(const WorldOptions& options, std::vector<Placement>* placements) {
  SceneBuilder builder("downtown_west");
  builder.AddSky();
  builder.environment() = {.sun_azimuth_deg = 222, .sun_elevation_deg = 44, .turbidity = 2.6, .cloud_cover = 0.35};
  const Surfaces surfaces = AddSurfaces(builder);
  const StreetPlan plan = PlanDowntownWest();
  PropShelf shelf(builder, options.models, options.seed);
  Occupancy occupancy;
  Placer placer(shelf, occupancy, options.seed);
  Ground ground(builder, surfaces);
  District district{builder, surfaces, plan, ground, placer, options.seed};

  // Streets and pavements, then what fills the blocks.
  const std::vector<StreetStretch> streets = LayStreets(ground, plan, options.seed);
  builder.SetRoads(std::make_shared<const RoadNetwork>(RoadsOf(plan)));
  for (const Block& block : plan.blocks) {
    const bool open = block.kind == BlockKind::kPlaza || block.kind == BlockKind::kPark;
    LayPavement(ground, block, open ? Surface::kSlabsWarm : Surface::kSlabs, "ground/pavement/modular", block.kind != BlockKind::kBackdrop);
    if (block.kind == BlockKind::kPlaza) {
      PlaceDowntownLandmarks(district, block);
      BuildPlaza(district, block);
    }
    if (block.kind == BlockKind::kPark) BuildPark(district, block);
    if (!open) BuildYard(district, block);
  }
  std::vector<BuildingPlan> buildings = PlanBuildings(plan, options.seed);
  MarkDowntownLandmarks(plan, buildings);
  BuildBuildings(district, buildings);
  HangDowntownSigns(district, buildings);
  FurnishPavements(district);
  FurnishStreets(district, streets);
  ground.Finish("ground");
  BuildBackdrop(district);
  ground.Finish("backdrop");

  AddPlacedModels(builder, shelf, options.props);
  // Over the plaza, the fountain ahead to the east.
  const auto plaza = std::find_if(plan.blocks.begin(), plan.blocks.end(), [](const Block& b) { return b.kind == BlockKind::kPlaza; });
  const Vec2f c = plaza->inner().center();
  builder.SetSpawn({c.x - 16.5f, c.y - 3, 6.5f});
  if (placements) *placements = placer.placements();
  return builder.Build();
}

// What is there, by semantic path.
constexpr const char* kCategories[] = {
    "barrier/fence/wood_fence",
    "barrier/railing/pillar",
    "barrier/railing/rail",
    "construction/awning",
    "construction/balcony",
    "construction/bridge",
    "construction/building",
    "construction/building/roof",
    "construction/fountain",
    "construction/phone_booth",
    "construction/rooftop/air_conditioner",
    "construction/rooftop/antenna",
    "construction/rooftop/ventilation_tube",
    "construction/rooftop/water_tank",
    "construction/stairs",
    "construction/wall",
    "furniture/curtain",
    "furniture/lighting/lamp_post",
    "furniture/lighting/street_light",
    "furniture/mail/post_box",
    "furniture/planter/pot",
    "furniture/seating/bench/wood",
    "furniture/seating/chair",
    "furniture/shade/tarp",
    "furniture/shade/tarp_post",
    "furniture/shade/umbrella",
    "furniture/table/dining_table",
    "furniture/transit/bus_stop",
    "furniture/utility/electric_box",
    "furniture/utility/fire_hydrant",
    "furniture/utility/parking_meter",
    "furniture/vending/food_cart",
    "furniture/vending/food_stall",
    "furniture/waste/recycle_bin",
    "furniture/waste/trash_can",
    "ground/bike_lane",
    "ground/crosswalk",
    "ground/kerb",
    "ground/lane_marking",
    "ground/manhole",
    "ground/path/park_walkway",
    "ground/pavement/modular",
    "ground/road",
    "ground/terrain/landscape",
    "nature/mountain",
    "nature/rock",
    "signage/billboard",
    "signage/flag/usa",
    "signage/poster_stand",
    "signage/shop_sign",
    "signage/traffic_sign",
    "sky",
    "traffic/barrier/barrier",
    "traffic/bollard/car_pillar",
    "traffic/control/traffic_light",
    "vegetation/flower",
    "vegetation/hedge",
    "vegetation/plant",
    "vegetation/shrub/bush",
    "vegetation/tree/broadleaf/generic",
    "vegetation/tree/broadleaf/maple",
    "vegetation/tree/broadleaf/narrowleaf",
    "vegetation/tree/conifer/pine",
    "vehicle/bicycle",
    "vehicle/bus",
    "vehicle/car",
    "vehicle/food_truck",
    "vehicle/van",
    "water/water_plane",
};

WorldInfo DowntownWestInfo() {
  const StreetPlan plan = PlanDowntownWest();
  return {"downtown_west",
          "outdoor",
          FreeGroundArea(plan, PlanBuildings(plan, 0)),
          {std::begin(kCategories), std::end(kCategories)},
          "A downtown of seven built blocks around a plaza with market, café terrace and fountain, and a "
          "park with a lake, island and red bridge; "
          "far city and mountains to the horizon; no people."};
}

}  // namespace airsim360::internal

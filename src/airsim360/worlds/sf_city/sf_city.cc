// sf_city: row houses on steep hills above a boulevard of towers, a bay; people-free.
#include "airsim360/worlds/built_in.h"
#include "airsim360/worlds/props/placed_models.h"
#include "airsim360/worlds/sf_city/city.h"
#include "airsim360/worlds/town/street_lanes.h"

namespace airsim360::internal {
namespace {

std::shared_ptr<const RoadNetwork> RoadsOnHills(const StreetPlan& plan, const Hills& hills) {
  auto roads = std::make_shared<RoadNetwork>(RoadsOf(plan));
  for (Lane& lane : roads->lanes)
    for (Vec3f& p : lane.points) p = hills.drape().At(p);
  for (Junction& junction : roads->junctions) junction.center = hills.drape().At(junction.center);
  return roads;
}

// What is there, by semantic path.
constexpr const char* kCategories[] = {
    "barrier/fence",
    "barrier/fence/metal_fence",
    "barrier/fence/wood_fence",
    "barrier/rope_bollard",
    "construction/awning",
    "construction/balcony",
    "construction/bridge",
    "construction/building",
    "construction/building/roof",
    "construction/fountain",
    "construction/mast",
    "construction/rooftop/air_conditioner",
    "construction/rooftop/antenna",
    "construction/rooftop/ventilation_tube",
    "construction/rooftop/water_tank",
    "construction/stairs",
    "furniture/lighting/lamp_post",
    "furniture/lighting/lamp_post/type_a",
    "furniture/lighting/lamp_post/type_b",
    "furniture/lighting/street_light",
    "furniture/mail/post_box",
    "furniture/misc",
    "furniture/planter/green_pot",
    "furniture/planter/pot",
    "furniture/recreation/playground",
    "furniture/seating/bench/wood",
    "furniture/seating/chair",
    "furniture/shade/umbrella",
    "furniture/table",
    "furniture/transit/bus_stop",
    "furniture/utility/electric_box",
    "furniture/utility/fire_hydrant",
    "furniture/utility/parking_meter",
    "furniture/utility/wire",
    "furniture/waste/recycle_bin",
    "furniture/waste/trash",
    "furniture/waste/trash_can",
    "ground/crosswalk",
    "ground/dirt",
    "ground/grass",
    "ground/kerb",
    "ground/lane_marking",
    "ground/manhole",
    "ground/path/park_walkway",
    "ground/rail",
    "ground/road",
    "ground/sidewalk",
    "ground/terrain/landscape",
    "nature/mountain",
    "nature/rock",
    "signage/poster_stand",
    "signage/shop_sign",
    "signage/traffic_sign",
    "sky",
    "traffic/barrier/barrier",
    "traffic/barrier/metal_barricade",
    "traffic/bollard/road_column",
    "traffic/control/traffic_light",
    "traffic/temporary/cone",
    "traffic/temporary/tube",
    "vegetation/flower",
    "vegetation/plant",
    "vegetation/shrub/bush",
    "vegetation/tree/broadleaf/generic",
    "vegetation/tree/broadleaf/narrowleaf",
    "vegetation/tree/conifer/pine",
    "vehicle/bicycle",
    "vehicle/bus",
    "vehicle/car",
    "vehicle/tram",
    "vehicle/van",
    "water/lake",
};

}  // namespace

std::shared_ptr<const Scene> BuildSfCity(const WorldOptions& options) { return BuildSfCity(options, nullptr); }

std::shared_ptr<const Scene> BuildSfCity(const WorldOptions& options, std::vector<Placement>* placements) {
  SceneBuilder builder("sf_city");
  builder.AddSky();
  builder.environment() = {.sun_azimuth_deg = 218, .sun_elevation_deg = 52, .turbidity = 2.4, .cloud_cover = 0.22};
  const Surfaces surfaces = AddSurfaces(builder);
  const StreetPlan plan = PlanSfCity();
  const Hills hills(plan);
  SlopeLay lay(hills);
  PropShelf shelf(builder, options.models, options.seed);
  shelf.SetLay([&lay](std::string_view kind, const AffineTransform& placed) { return lay(kind, placed); });
  Occupancy occupancy;
  Placer placer(shelf, occupancy, options.seed);
  Ground ground(builder, surfaces), far(builder, surfaces);
  ground.SetLay([&hills](const Mesh& flat) { return hills.drape().Lay(flat); });
  District district{builder, surfaces, plan, ground, placer, options.seed};
  const SfPlan city = PlanSfBuildings(plan, hills, options.seed);

  // Ground, buildings, what hangs over the streets, then what stands where there is room.
  const std::vector<StreetStretch> streets = LayStreets(ground, plan, options.seed);
  builder.SetRoads(RoadsOnHills(plan, hills));
  for (const Block& block : plan.blocks) LayPavement(ground, block, Surface::kSlabs, "ground/sidewalk", block.kind != BlockKind::kBackdrop);
  BuildSfBuildings(district, hills, city, lay);
  LayCableCarLine(district, hills);
  HangSfWires(district, hills);
  for (const Block& block : plan.blocks) {
    if (block.kind == BlockKind::kPark) BuildLakePark(district, block);
    if (block.kind == BlockKind::kPlaza) BuildHillPark(district, hills, block);
  }
  FurnishSfPavements(district, hills, city);
  FurnishSfStreets(district, hills, streets);
  LayOpenGround(district, city);
  LaySfYards(district, city);
  ground.Finish("ground");
  BuildFarSf(district, far, hills);
  ground.Finish("backdrop");
  far.Finish("far city");

  AddPlacedModels(builder, shelf, options.props);
  // Over the boulevard between the towers, looking up it towards the hills.
  builder.SetSpawn({-1.5f, -150, 9}, 100);
  if (placements) *placements = placer.placements();
  return builder.Build();
}

WorldInfo SfCityInfo() {
  const StreetPlan plan = PlanSfCity();
  return {
      "sf_city",
      "outdoor",
      FreeSfGround(plan, PlanSfBuildings(plan, Hills(plan), 0)),
      {std::begin(kCategories), std::end(kCategories)},
      "Hills with streets of up to 31 % between rows of bay-windowed houses with stoops and garages, cable cars and overhead wires, a boulevard of "
      "towers, a park with a lake and one on a slope, a bay with a bridge; no people."};
}

}  // namespace airsim360::internal

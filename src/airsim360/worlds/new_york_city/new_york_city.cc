// new_york_city: a crossing of avenues and streets in Midtown, with a park, people-free.
#include <algorithm>

#include "airsim360/worlds/built_in.h"
#include "airsim360/worlds/new_york_city/city.h"
#include "airsim360/worlds/props/placed_models.h"
#include "airsim360/worlds/town/buildings.h"
#include "airsim360/worlds/town/street_lanes.h"

namespace airsim360 {

StreetPlan PlanNewYorkCity() {
  StreetPlan plan;
  for (int i = -2; i <= 3; ++i) {
    const float at = static_cast<float>(i);
    plan.north_south.push_back({132 * at, 13, i == 0 ? StreetKind::kBoulevard : StreetKind::kAvenue});
    plan.east_west.push_back({84 * at, 6.5f});
  }
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 5; ++column) {
      const auto c = static_cast<size_t>(column), r = static_cast<size_t>(row);
      Block block;
      block.column = column;
      block.row = row;
      block.kerb = {plan.north_south[c].center + 13, plan.east_west[r].center + 6.5f, plan.north_south[c + 1].center - 13,
                    plan.east_west[r + 1].center - 6.5f};
      const bool core = column >= 1 && column <= 3 && row >= 1 && row <= 3;
      if (!core) block.kind = BlockKind::kBackdrop;
      if (column == 3 && row == 2) block.kind = BlockKind::kPark;
      plan.blocks.push_back(block);
    }
  }
  return plan;
}

}  // namespace airsim360

namespace airsim360::internal {

std::shared_ptr<const Scene> BuildNewYorkCity(const WorldOptions& options) { return BuildNewYorkCity(options, nullptr); }

std::shared_ptr<const Scene> BuildNewYorkCity(const WorldOptions& options, std::vector<Placement>* placements) {
  const Period& period = PeriodOf(options.city.style);
  SceneBuilder builder(period.world);
  builder.AddSky();
  builder.environment() = {.sun_azimuth_deg = 256, .sun_elevation_deg = 66, .turbidity = 2.6, .cloud_cover = 0.3};
  Surfaces surfaces = AddSurfaces(builder, period.shop_signs);
  for (const auto& [surface, by] : period.surfaces) surfaces = surfaces.With(surface, surfaces[by]);
  for (const Coat& coat : period.coats) {
    Material material = builder.material(surfaces[coat.of]);
    material.name = coat.name;
    material.base_color = material.base_color * coat.color;
    material.roughness = coat.roughness;
    material.clear_coat = coat.glaze;
    surfaces = surfaces.With(coat.surface, builder.AddMaterial(std::move(material)));
  }
  StreetPlan plan = PlanNewYorkCity();
  plan.paint = period.paint;
  PropShelf shelf(builder, options.models, options.seed);
  for (const auto& [kind, by] : period.props) shelf.Replace(kind, by);
  Occupancy occupancy;
  Placer placer(shelf, occupancy, options.seed);
  Ground ground(builder, surfaces);
  District district{builder, surfaces, plan, ground, placer, options.seed};
  const Density density{options.city.traffic, options.city.trees, options.city.furniture};
  Manhattan city =
      PlanManhattan(plan, {options.seed, static_cast<float>(options.city.height), StylesOf(options.city.styles), options.city.style});

  if (options.city.billboards) {
    MarkMurals(city, plan.reach(), options.seed);
    PartBoardsFromFireEscapes(city, options.seed);
  }

  // Ground, buildings, then what hangs on them and stands between them; the unique things first.
  const std::vector<StreetStretch> streets = LayStreets(ground, plan, options.seed);
  builder.SetRoads(std::make_shared<const RoadNetwork>(RoadsOf(plan)));
  for (const Block& block : plan.blocks) LayPavement(ground, block, Surface::kSlabs, "ground/sidewalk", block.kind != BlockKind::kBackdrop);
  BuildBuildings(district, city.buildings, {.fire_escapes = true, .escape_wall = period.escape_wall, .coolers = period.coolers});
  if (period.aerials) RaiseAerials(district, city);
  HangSigns(district, city, options.city.billboards);
  PlaceLandmarks(district, city);
  if (period.subway_stairs) PlaceSubwayStairs(district);
  LayMedians(district, streets);
  BuildOpenLots(district, city);
  LayBackYards(district, city);
  for (const Block& block : plan.blocks)
    if (block.kind == BlockKind::kPark) BuildLakePark(district, block);
  FurnishNewYorkPavements(district, city, period, density);
  FurnishNewYorkStreets(district, streets, density);
  ground.Finish("ground");
  BuildFarManhattan(district, period, density);
  ground.Finish("backdrop");

  AddPlacedModels(builder, shelf, options.props);
  // High over the crossing, looking up the boulevard.
  builder.SetSpawn({-2, -4, 36}, 62);
  if (placements) *placements = placer.placements();
  return builder.Build();
}

// What is there, by semantic path.
constexpr const char* kCategories[] = {
    "barrier/fence/metal_fence",
    "barrier/fence/wood_fence",
    "construction/awning",
    "construction/bridge",
    "construction/building",
    "construction/building/roof",
    "construction/fountain",
    "construction/phone_booth",
    "construction/pillar",
    "construction/rooftop/air_conditioner",
    "construction/rooftop/antenna",
    "construction/rooftop/ventilation_tube",
    "construction/rooftop/water_tank",
    "construction/scaffolding",
    "furniture/curtain",
    "furniture/lighting/lamp_post",
    "furniture/lighting/street_light",
    "furniture/mail/post_box",
    "furniture/misc",
    "furniture/planter/green_pot",
    "furniture/seating/bench/wood",
    "furniture/seating/chair",
    "furniture/shade/umbrella",
    "furniture/table",
    "furniture/transit/bus_stop",
    "furniture/utility/electric_box",
    "furniture/utility/fire_hydrant",
    "furniture/utility/parking_meter",
    "furniture/vending/hotdog_cart",
    "furniture/waste/trash_can",
    "ground/bike_lane",
    "ground/crosswalk",
    "ground/dirt",
    "ground/grass",
    "ground/kerb",
    "ground/lane_marking",
    "ground/manhole",
    "ground/path/park_walkway",
    "ground/road",
    "ground/sidewalk",
    "ground/terrain/landscape",
    "nature/rock",
    "signage/billboard",
    "signage/flag/usa",
    "signage/poster_stand",
    "signage/shop_sign",
    "signage/traffic_sign",
    "sky",
    "traffic/barrier/barrier",
    "traffic/barrier/concrete_block",
    "traffic/bollard/road_column",
    "traffic/control/traffic_light",
    "traffic/temporary/cone",
    "vegetation/flower",
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
    "water/lake",
    "water/river",
};

std::shared_ptr<const Scene> BuildNewYorkCity1950s(const WorldOptions& options) {
  WorldOptions old = options;
  old.city.style = CityStyle::k1950s;
  return BuildNewYorkCity(old);
}

WorldInfo NewYorkCity1950sInfo() {
  std::vector<std::string> categories(std::begin(kCategories), std::end(kCategories));
  std::erase(categories, "construction/rooftop/air_conditioner");
  std::erase(categories, "ground/bike_lane");
  categories.emplace_back("construction/stairs");
  std::sort(categories.begin(), categories.end());
  const StreetPlan plan = PlanNewYorkCity();
  return {PeriodOf(CityStyle::k1950s).world, "outdoor", FreeGroundArea(plan, PlanManhattan(plan, {.style = CityStyle::k1950s}).buildings),
          categories,
          "The streets of new_york_city in the 1950s: towers of stone and brick, tenements with fire escapes, water tanks and "
          "television aerials, painted boards and neon, bishop's-crook lamps, two-lamp signals, subway stairs, chromed cars and checker "
          "cabs; no people."};
}

WorldInfo NewYorkCityInfo() {
  const StreetPlan plan = PlanNewYorkCity();
  return {"new_york_city",
          "outdoor",
          FreeGroundArea(plan, PlanManhattan(plan, {}).buildings),
          {std::begin(kCategories), std::end(kCategories)},
          "Nine blocks of Midtown around a crossing of a planted boulevard: towers with setbacks, walk-ups "
          "with fire "
          "escapes, brownstones, billboards, cabs, a park with lake, island and red bridge; skyline to the "
          "horizon; "
          "no people."};
}

}  // namespace airsim360::internal

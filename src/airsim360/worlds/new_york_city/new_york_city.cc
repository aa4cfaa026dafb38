// new_york_city: a crossing of avenues and streets in Midtown, with a park, people-free.
#include "airsim360/worlds/buildings.h"
#include "airsim360/worlds/built_in.h"
#include "airsim360/worlds/new_york_city/city.h"

namespace airsim360::internal {

std::shared_ptr<const Scene> BuildNewYorkCity(const WorldOptions& options) { return BuildNewYorkCity(options, nullptr); }

std::shared_ptr<const Scene> BuildNewYorkCity(const WorldOptions& options, std::vector<Placement>* placements) {
  SceneBuilder builder("new_york_city");
  builder.AddSky();
  builder.environment() = {.sun_azimuth_deg = 213, .sun_elevation_deg = 50, .turbidity = 2.6, .cloud_cover = 0.3};
  const Surfaces surfaces = AddSurfaces(builder);
  const StreetPlan plan = PlanNewYorkCity();
  PropShelf shelf(builder, options.models, options.seed);
  Occupancy occupancy;
  Placer placer(shelf, occupancy, options.seed);
  Ground ground(builder, surfaces);
  District district{builder, surfaces, plan, ground, placer, options.seed};
  const Manhattan city = PlanManhattan(plan, {.seed = options.seed});

  // Ground, buildings, then what hangs on them and stands between them; the unique things first.
  const std::vector<StreetStretch> streets = LayStreets(ground, plan, options.seed);
  for (const Block& block : plan.blocks) LayPavement(ground, block, Surface::kSlabs, "ground/sidewalk");
  BuildBuildings(district, city.buildings, true);
  HangSigns(district, city);
  PlaceLandmarks(district, city);
  LayMedians(district, streets);
  BuildOpenLots(district, city);
  for (const Block& block : plan.blocks)
    if (block.kind == BlockKind::kPark) BuildLakePark(district, block);
  FurnishNewYorkPavements(district, city);
  FurnishNewYorkStreets(district, streets);
  ground.Finish("ground");
  BuildFarManhattan(district);
  ground.Finish("backdrop");

  // High over the crossing, looking up the boulevard.
  builder.SetSpawn({-2, -4, 36}, 62);
  if (placements) *placements = placer.placements();
  return builder.Build();
}

WorldInfo NewYorkCityInfo() {
  const StreetPlan plan = PlanNewYorkCity();
  return {"new_york_city",
          "outdoor",
          FreeGroundArea(plan, PlanManhattan(plan, {}).buildings),
          {},
          "Nine blocks of Midtown around a crossing of a planted boulevard: towers with setbacks, walk-ups with fire "
          "escapes, brownstones, billboards, cabs, a park with lake, island and red bridge; skyline to the horizon; "
          "no people."};
}

}  // namespace airsim360::internal

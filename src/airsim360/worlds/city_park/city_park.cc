// city_park: a road bends through a park with lawns, groves, a lake and hills; woods to the horizon.
#include <cmath>
#include <numbers>

#include "airsim360/worlds/built_in.h"
#include "airsim360/worlds/city_park/park.h"

namespace airsim360::internal {
namespace park {

AffineTransform PlaceTilted(Vec3f p, Vec3f up, float yaw, float scale) {
  const Vec3f t = Normalized(Vec3f{1, 0, 0} - up * up.x), b = Cross(up, t);
  const float c = std::cos(yaw) * scale, s = std::sin(yaw) * scale;
  return {Mat3f::FromColumns(t * c + b * s, b * c - t * s, up * scale), p};
}

}  // namespace park

std::shared_ptr<const Scene> BuildCityPark(const WorldOptions& options) { return BuildCityPark(options, nullptr); }

std::shared_ptr<const Scene> BuildCityPark(const WorldOptions& options, std::vector<Placement>* placements) {
  using namespace park;
  SceneBuilder builder("city_park");
  builder.AddSky();
  Environment& environment = builder.environment();
  environment.sun_azimuth_deg = 128;
  environment.sun_elevation_deg = 33;
  environment.turbidity = 2.6;
  environment.cloud_cover = 0.4;
  environment.cirrus_cover = 0.35;

  const Layout layout;
  const Surfaces surfaces = AddSurfaces(builder);
  const ParkMaterials materials = AddParkMaterials(builder, layout);
  const Lawns lawns(builder, layout);
  PropShelf shelf(builder, options.models, options.seed);
  Occupancy occupancy;
  Placer placer(shelf, occupancy, options.seed);
  Park park{builder, surfaces, materials, layout, lawns, occupancy, placer, options.seed};

  LayTerrain(park);
  LayRoads(park);
  LayPathsAndWater(park);
  BuildHouses(park);
  FurnishPark(park);
  const std::vector<Vec2f> trees = PlantTrees(park);
  GrowLawns(park, trees);

  // Over the bend of the road, looking north over the lawn to the lake.
  builder.SetSpawn({0, 0, 8.5f}, 90);
  if (placements) *placements = placer.placements();
  return builder.Build();
}

WorldInfo CityParkInfo() {
  return {"city_park",
          "outdoor",
          std::numbers::pi * park::kParkRadius * park::kParkRadius,
          {"barrier/fence/circle_fence",
           "construction/building",
           "construction/building/roof",
           "furniture/lighting/lamp_post",
           "furniture/lighting/lamp_post/type_b",
           "furniture/recreation/playground",
           "furniture/seating/bench",
           "furniture/seating/bench/wood",
           "furniture/seating/chair",
           "furniture/shade/umbrella",
           "furniture/table",
           "furniture/table/cafe_table",
           "furniture/vending/food_stall",
           "furniture/waste/trash_can",
           "ground/crosswalk",
           "ground/dirt",
           "ground/kerb",
           "ground/lane_marking",
           "ground/manhole",
           "ground/path/park_walkway",
           "ground/road",
           "ground/sidewalk",
           "ground/sidewalk/pool_edge",
           "ground/terrain/landscape",
           "nature/hill",
           "nature/rock",
           "signage/traffic_sign",
           "sky",
           "traffic/barrier/road_block",
           "traffic/control/traffic_light",
           "traffic/temporary/traffic_barrel",
           "vegetation/climber/ivy",
           "vegetation/flower",
           "vegetation/grass_tuft",
           "vegetation/plant",
           "vegetation/shrub/bush",
           "vegetation/tree/broadleaf/amur_cork",
           "vegetation/tree/broadleaf/elm",
           "vegetation/tree/broadleaf/maple",
           "vegetation/tree/broadleaf/narrowleaf",
           "vegetation/tree/broadleaf/weeping_willow",
           "vegetation/tree/conifer/pine",
           "vehicle/car",
           "vehicle/van",
           "water/water_plane"},
          "A park of 85 hectares: a road bends past lawns, groves, a lake and hills; woods and houses to the "
          "horizon; no people."};
}

}  // namespace airsim360::internal

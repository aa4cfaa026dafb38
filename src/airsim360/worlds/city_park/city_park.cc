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
          {},
          "A park of 85 hectares: a road bends past lawns, groves, a lake and hills; woods and houses to the "
          "horizon; no people."};
}

}  // namespace airsim360::internal

// What the builders of city_park share, and the builders of its parts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/worlds/city_park/layout.h"
#include "airsim360/worlds/city_park/materials.h"
#include "airsim360/worlds/props/placer.h"
#include "airsim360/worlds/texture/surfaces.h"

namespace airsim360::internal::park {

/// The pieces that roads, paths and the lake cut the park's ground into, each an entity: a raster of 1 m.
class Lawns {
 public:
  Lawns(SceneBuilder& builder, const Layout& layout);
  /// The lawn at a point or the nearest one within a few metres; else the country around.
  EntityId At(Vec2f p) const;
  /// True on lawns: not on or beside roads and paths, not in the lake.
  bool IsLawn(Vec2f p) const;
  /// Number of raster cells on lawns, the same as their area in square metres.
  double area() const { return area_; }

 private:
  int Cell(Vec2f p) const;
  std::vector<uint16_t> piece_;  // 0 = none
  std::vector<EntityId> entities_;
  std::vector<EntityId> country_;
  EntityId lake_bed_ = kNoEntity;
  const Layout& layout_;
  double area_ = 0;
};

struct Park {
  SceneBuilder& builder;
  const Surfaces& surfaces;
  const ParkMaterials& materials;
  const Layout& layout;
  const Lawns& lawns;
  Occupancy& occupancy;
  Placer& placer;
  uint64_t seed;

  EntityId AddEntity(std::string name, std::string_view path) { return builder.AddEntity(std::move(name), builder.tree().At(path)); }
  Vec3f OnGround(Vec2f p, float sink = 0) const { return {p.x, p.y, layout.Ground(p) - sink}; }
};

/// Upright on a slope: z along `up`, turned by `yaw` about it.
AffineTransform PlaceTilted(Vec3f p, Vec3f up, float yaw, float scale);

/// Ground to the horizon, finer near the water, kerbs and paths. Returns its number of triangles.
size_t LayTerrain(Park& park);
/// Carriageways, markings, kerbs, beds of mulch, pavements, junctions.
void LayRoads(Park& park);
/// Gravel paths, the lake, the paved edge at its landing.
void LayPathsAndWater(Park& park);
/// Lamps, benches, bins, signs, cars, picnic places, playground, café, houses.
void FurnishPark(Park& park);
void BuildHouses(Park& park);
/// Trees to the horizon, shrubs, rocks. Returns the positions of trees near the spawn, for their litter.
std::vector<Vec2f> PlantTrees(Park& park);
/// Blades, clover, tufts, reeds, fallen leaves, mulch chips.
void GrowLawns(Park& park, const std::vector<Vec2f>& trees);

}  // namespace airsim360::internal::park

// What the builders of an OpenStreetMap world share.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "airsim360/worlds/kit/mesh_builder.h"
#include "airsim360/worlds/osm/buildings/osm_building_plans.h"
#include "airsim360/worlds/osm/data/line_index.h"
#include "airsim360/worlds/osm/map_dress.h"
#include "airsim360/worlds/osm/osm_relief.h"
#include "airsim360/worlds/osm/osm_world.h"
#include "airsim360/worlds/props/placer.h"
#include "airsim360/worlds/props/props.h"
#include "airsim360/worlds/texture/surfaces.h"

namespace airsim360::internal {

/// Copies of surfaces in other colours, each made once.
class Tints {
 public:
  explicit Tints(SceneBuilder& builder) : builder_(builder) {}
  /// `base` with the mean albedo `colour` where its picture has the mean albedo `mean`.
  MaterialId Get(MaterialId base, Vec3f colour, float mean, float metallic = 0, float roughness = 0);

 private:
  SceneBuilder& builder_;
  std::map<std::tuple<MaterialId, int, int, int, int>, MaterialId> made_;
};

/// Texture coordinates of a place on the ground.
using GroundUv = std::function<Vec2f(Vec2d)>;
inline Vec2f PlainUv(Vec2d p) { return {static_cast<float>(p.x), static_cast<float>(-p.y)}; }

inline constexpr double kClip = 30;  ///< metres around the extract that the ground reaches
inline OsmBox GroundBox(const OsmData& data) {
  const OsmBox& e = data.extent;
  return {e.x0 - kClip, e.y0 - kClip, e.x1 + kClip, e.y1 + kClip};
}

struct OsmScene {
  SceneBuilder& builder;
  const Surfaces& surfaces;
  PropShelf& shelf;
  Occupancy& occupancy;
  Tints& tints;
  const OsmData& data;
  const std::vector<OsmArea>& areas;
  const Patches& sea;  ///< within GroundBox
  Relief relief;
  OsmOptions options;
  Vec2d focus;  ///< where the viewer starts; detail falls with the distance from it
  bool europe = false;
  const MapDress* dress = nullptr;  ///< of drawn towns; real maps have none

  double Far(Vec2d p) const { return std::hypot(p.x - focus.x, p.y - focus.y); }
  Vec3f On(Vec2d p, double lift = 0) const {
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(relief.At(p) + lift)};
  }
  /// A triangle of the plane (counter-clockwise) `lift` over the ground, bent with it.
  void Drape(MeshBuilder& mesh, Vec2d a, Vec2d b, Vec2d c, double lift, const GroundUv& uv) const;
  /// A prop of its own entity `name`, category of its kind.
  EntityId Put(const std::string& name, std::string_view kind, Vec3f p_W, double yaw, float scale = 1, uint32_t variant = 0,
               Vec3f tint = {1, 1, 1});
};

inline Vec2f ToFloat(Vec2d p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }

inline constexpr double kLawnReach = 75;  ///< metres around the focus in which lawns have blades

struct RoadGraph;
/// What a building's volumes lie among: for party walls and street fronts.
struct Neighbours {
  struct Other {
    const OsmVolume* volume;
    size_t building;
  };
  std::vector<Other> volumes;
  BoxIndex boxes;
  LineIndex roads;                                         ///< centre lines; owner = index into graph->segments
  LineIndex shops;                                         ///< places of shops and cafés
  std::shared_ptr<const RoadGraph> graph;                  ///< set by BuildOsmGround
  std::vector<std::pair<EntityId, Patches>> lawns, woods;  ///< near the focus, set by BuildOsmGround
  struct Yard {
    std::string name;
    Patches patches;  ///< what is free of the block, houses included
    enum class Kind { kCourt, kGarden, kMeadow } kind;
  };
  std::vector<Yard> yards;  ///< the rest of each block, set by BuildOsmGround
};

/// Walls, roofs and roof clutter of all buildings, as merged meshes by place. Returns their entities, in order.
std::vector<EntityId> BuildOsmBuildings(OsmScene& scene, const std::vector<OsmBuilding>& buildings, const Neighbours& near);

/// The roof of a volume, and its walls above the eaves (as `walls`); `base` is the z of its foot.
void BuildOsmRoof(MeshBuilder& mesh, const OsmVolume& volume, double base, EntityId walls, EntityId roof, MaterialId wall,
                  MaterialId cover);
/// The world of a map that has been read or drawn. `dress`: what a drawn town has beyond its map.
std::shared_ptr<const Scene> BuildMapScene(const std::string& name, const OsmData& data, const OsmOptions& options,
                                           const std::string& attribution, OsmReport* report = nullptr, MapDress* dress = nullptr);
/// What a roof is made of.
MaterialId RoofCover(OsmScene& scene, const OsmVolume& volume, const OsmTags& building, uint64_t seed);

/// Is this area open country, which ends at the coast whatever its outline says (a park, a wood, a reserve)?
bool IsOpenCountry(const OsmTags& tags);

/// Streets, pavements, paths, areas and the ground between, as entities without overlap.
void BuildOsmGround(OsmScene& scene, const std::vector<OsmBuilding>& buildings, Neighbours& near);
/// Trees, lamps, benches, fences … of the map, and where the map has none of a kind, some by rule.
void BuildOsmProps(OsmScene& scene, const Neighbours& near);

}  // namespace airsim360::internal

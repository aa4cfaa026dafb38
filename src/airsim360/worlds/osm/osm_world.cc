#include "airsim360/worlds/osm/osm_world.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/worlds/osm/osm_lanes.h"
#include "airsim360/worlds/osm/osm_scene.h"
#include "airsim360/worlds/osm/osm_sea.h"
#include "airsim360/worlds/osm/osm_streets.h"

namespace airsim360 {
namespace internal {

MaterialId Tints::Get(MaterialId base, Vec3f colour, float mean, float metallic, float roughness) {
  const auto level = [](float x) { return static_cast<int>(std::lround(x * 255)); };
  const auto key = std::tuple(base, level(colour.x), level(colour.y), level(colour.z), level(metallic));
  const auto it = made_.find(key);
  if (it != made_.end()) return it->second;
  Material material = builder_.material(base);
  material.name += " " + std::to_string(made_.size() + 1);
  material.base_color = colour * (1 / mean);
  if (metallic > 0) material.metallic = metallic;
  if (roughness > 0) {
    material.roughness = roughness;
    material.metallic_roughness_texture = kNoTexture;
    material.base_color_texture = kNoTexture;
    material.base_color = colour;
  }
  return made_[key] = builder_.AddMaterial(std::move(material));
}

void OsmScene::Drape(MeshBuilder& mesh, Vec2d a, Vec2d b, Vec2d c, double lift, const GroundUv& uv) const {
  for (const std::vector<Vec2d>& piece : relief.Split(a, b, c))
    for (size_t i = 1; i + 1 < piece.size(); ++i)
      mesh.Triangle(On(piece[0], lift), On(piece[i], lift), On(piece[i + 1], lift), uv(piece[0]), uv(piece[i]), uv(piece[i + 1]));
}

EntityId OsmScene::Put(const std::string& name, std::string_view kind, Vec3f p_W, double yaw, float scale, uint32_t variant, Vec3f tint) {
  const PropKind& row = FindPropKind(kind);
  const EntityId entity = builder.AddEntity(name, builder.tree().At(row.category));
  shelf.PlaceAs(entity, kind, PlaceUpright(p_W, static_cast<float>(yaw), scale), variant % static_cast<uint32_t>(row.variants), tint);
  return entity;
}

namespace {

Relief ReliefOf(const OsmData& data, const OsmOptions& options) {
  if (!options.heights) return {};
  // The map and a kilometre around it.
  const GeoFrame frame(data.origin);
  const OsmBox& e = data.extent;
  const GeoPoint low = frame.ToGeodetic({e.x0 - 1000, e.y0 - 1000, 0}), high = frame.ToGeodetic({e.x1 + 1000, e.y1 + 1000, 0});
  return Relief(options.heights({low.longitude_deg, low.latitude_deg, high.longitude_deg, high.latitude_deg}), data.origin,
                e.width() * e.depth());
}

// A word about multipolygons that do not close although nothing is cut off.
void WarnOfBroken(const std::string& name, const std::vector<OsmArea>& areas) {
  constexpr int kMostNamed = 5;
  const auto broken = std::count_if(areas.begin(), areas.end(), [](const OsmArea& area) { return area.broken; });
  int named = 0;
  for (const OsmArea& area : areas)
    if (area.broken && ++named <= kMostNamed) LogWarning(name + ": " + area.id + ": its ways do not close; only what closes is shown");
  if (broken > kMostNamed) LogWarning(name + ": " + std::to_string(broken - kMostNamed) + " more relations do not close");
}

// Open country ends where the sea begins; bays and straits are there where it is.
void EndAtTheCoast(std::vector<OsmArea>& areas, const Patches& sea) {
  if (sea.empty()) return;
  for (OsmArea& area : areas) {
    const bool bay = area.tags->Is("natural", "bay") || area.tags->Is("natural", "strait");
    if (area.patches.empty() || !(bay || IsOpenCountry(*area.tags))) continue;
    area.patches = bay ? Intersect(area.patches, sea) : Subtract(area.patches, sea);
  }
}

// Where to begin: over the street nearest to the middle, looking along it.
void ChooseSpawn(OsmScene& scene, const Neighbours& near) {
  const LineIndex::Near road = near.roads.Find(scene.focus, 400);
  if (road.owner == UINT32_MAX) {
    scene.builder.SetSpawn(scene.On(scene.focus, 12));
    return;
  }
  const Vec2d along = road.direction;
  scene.builder.SetSpawn(scene.On(road.point, 4.5), static_cast<float>(std::atan2(along.y, along.x) * 180 / M_PI));
}

// A map whose streets make no sense as lanes is still a world; only nobody drives in it.
void SetLanes(const std::string& name, RoadNetwork roads, SceneBuilder& builder) {
  if (roads.lanes.empty()) return;
  try {
    CheckRoads(roads);
  } catch (const InputError& error) {
    return LogWarning(name + ": no traffic can drive here: " + error.what());
  }
  builder.SetRoads(std::make_shared<const RoadNetwork>(std::move(roads)));
}

// What stands where, for party walls, fronts and free places. Points into `buildings`.
Neighbours NeighboursOf(const OsmData& data, const std::vector<OsmBuilding>& buildings) {
  Neighbours near;
  for (size_t i = 0; i < buildings.size(); ++i)
    for (const OsmVolume& volume : buildings[i].volumes) {
      Bounds2d box;
      for (const Patch& patch : volume.footprint)
        for (Vec2d p : patch.outer) box.Add(p);
      if (volume.footprint.empty()) continue;
      near.boxes.Add(box, static_cast<uint32_t>(near.volumes.size()));
      near.volumes.push_back({&volume, i});
    }
  for (const OsmNode& node : data.nodes) {
    const std::string_view amenity = node.tags.Get("amenity");
    if (node.tags.Has("shop") || amenity == "cafe" || amenity == "restaurant" || amenity == "fast_food" || amenity == "bar" ||
        amenity == "pub" || amenity == "bank" || amenity == "pharmacy")
      near.shops.Add(node.p, node.p, 0);
  }
  return near;
}

}  // namespace

std::shared_ptr<const Scene> BuildMapScene(const std::string& name, const OsmData& data, const OsmOptions& options,
                                           const std::string& attribution, OsmReport* report, MapDress* dress) {
  SceneBuilder builder(std::filesystem::path(name).filename().string());
  builder.AddSky();
  builder.environment() = {.sun_azimuth_deg = 215, .sun_elevation_deg = 46, .turbidity = 2.8, .cloud_cover = 0.35};
  if (!attribution.empty()) builder.AddAttribution(attribution);
  Surfaces surfaces = AddSurfaces(builder);
  if (dress && dress->paint) dress->paint(builder, surfaces, *dress);
  PropShelf shelf(builder, options.models, options.seed);
  Occupancy occupancy;
  Tints tints(builder);
  std::vector<OsmArea> areas = FindAreas(data);
  const Sea sea = FindSea(data, GroundBox(data));
  for (const std::string& fault : sea.faults) LogWarning(name + ": " + fault);
  EndAtTheCoast(areas, sea.water);
  WarnOfBroken(name, areas);
  const Vec2d middle{(data.extent.x0 + data.extent.x1) / 2, (data.extent.y0 + data.extent.y1) / 2};
  OsmScene scene{builder,   surfaces,  shelf,
                 occupancy, tints,     data,
                 areas,     sea.water, ReliefOf(data, options),
                 options,   middle,    data.origin.longitude_deg > -30,
                 dress};
  const std::vector<OsmBuilding> buildings = PlanOsmBuildings(data, areas);

  Neighbours near = NeighboursOf(data, buildings);
  BuildOsmGround(scene, buildings, near);
  SetLanes(name, OsmLanes(scene, *near.graph), builder);
  const std::vector<EntityId> entities = BuildOsmBuildings(scene, buildings, near);
  BuildOsmProps(scene, near);
  ChooseSpawn(scene, near);
  if (dress && dress->finish) dress->finish(scene, buildings, near);
  auto built = builder.Build();
  if (report) {
    static constexpr const char* kSources[] = {"tag", "levels", "guess"};
    GeoPoint origin = data.origin;
    origin.altitude = scene.relief.zero();
    *report = {origin, data.extent.width(), data.extent.depth(), {}};
    for (size_t i = 0; i < buildings.size(); ++i) {
      const OsmBuilding& building = buildings[i];
      report->buildings.push_back({building.id, entities[i], building.height, kSources[static_cast<int>(building.source)],
                                   Area(building.outline), building.orphan});
    }
  }
  return built;
}

}  // namespace internal

bool IsOsmFile(const std::filesystem::path& file) { return internal::IsOsmName(file.string()); }

std::shared_ptr<const Scene> BuildOsmWorld(const std::string& name, std::span<const std::byte> bytes, const OsmOptions& options,
                                           OsmReport* report) {
  return internal::BuildMapScene(name, internal::ReadOsm(name, bytes, {}, options.cut), options,
                                 "map data (c) OpenStreetMap contributors, Open Database License 1.0 (openstreetmap.org/copyright)",
                                 report);
}

std::shared_ptr<const Scene> BuildOsmWorld(const std::filesystem::path& file, const OsmOptions& options, OsmReport* report) {
  return BuildOsmWorld(file.string(), ReadFile(file, internal::OsmLimits().max_bytes), options, report);
}

GeoPoint OriginOfOsmWorld(const std::filesystem::path& file, const std::optional<MapCut>& cut) {
  return internal::ReadOsm(file.string(), ReadFile(file, internal::OsmLimits().max_bytes), {}, cut).origin;
}

}  // namespace airsim360

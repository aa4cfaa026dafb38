// The ground of a map: every spot belongs to one entity. Pieces are laid in order of rank, each cut by what was
// laid before it: junctions, carriageways, pavements, paths, then areas from small to large, then the rest of
// each block.
#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/osm/osm_country.h"
#include "airsim360/worlds/osm/osm_streets.h"

namespace airsim360::internal {
namespace {

// u across (0 in the middle), v along the line: for wheel tracks.
GroundUv StreetUv(std::vector<Vec2d> line) {
  return [line = std::move(line)](Vec2d p) {
    double best = 1e18, s = 0;
    Vec2f uv{};
    for (size_t i = 0; i + 1 < line.size(); ++i) {
      const Vec2d v = line[i + 1] - line[i], w = p - line[i];
      const double length = std::max(std::hypot(v.x, v.y), 1e-9);
      const double t = std::clamp((w.x * v.x + w.y * v.y) / length, 0.0, length);
      const double dx = w.x - v.x / length * t, dy = w.y - v.y / length * t, d = std::hypot(dx, dy);
      if (d < best) {
        best = d;
        const double side = v.x * w.y - v.y * w.x > 0 ? 1 : -1;
        uv = {static_cast<float>(side * d), static_cast<float>(s + t)};
      }
      s += length;
    }
    return uv;
  };
}

// What an area of the map is made of.
struct AreaKind {
  std::string_view key, value, category;
  Surface surface;
};
constexpr AreaKind kAreaKinds[] = {
    {"natural", "water", "water/lake", Surface::kWater},
    {"waterway", "riverbank", "water/river", Surface::kWater},
    {"waterway", "dock", "water/lake", Surface::kWater},
    {"landuse", "reservoir", "water/lake", Surface::kWater},
    {"landuse", "basin", "water/lake", Surface::kWater},
    {"natural", "bay", "water/sea", Surface::kWater},
    {"natural", "strait", "water/sea", Surface::kWater},
    {"leisure", "swimming_pool", "water/pool", Surface::kWater},
    {"amenity", "fountain", "water/pool", Surface::kWater},
    {"leisure", "playground", "ground/sand", Surface::kPath},
    {"leisure", "pitch", "ground/grass", Surface::kLawn},
    {"leisure", "garden", "ground/grass", Surface::kLawn},
    {"landuse", "grass", "ground/grass", Surface::kLawn},
    {"landuse", "village_green", "ground/grass", Surface::kLawn},
    {"landuse", "flowerbed", "ground/dirt", Surface::kSoil},
    {"natural", "grassland", "ground/grass", Surface::kLawn},
    {"natural", "scrub", "ground/terrain/landscape", Surface::kLawn},
    {"natural", "wood", "ground/terrain/landscape", Surface::kForestFloor},
    {"natural", "sand", "ground/sand", Surface::kPath},
    {"natural", "beach", "ground/sand", Surface::kPath},
    {"natural", "heath", "ground/terrain/landscape", Surface::kLawn},
    {"amenity", "parking", "ground/parking", Surface::kAsphaltOld},
    {"amenity", "bicycle_parking", "ground/pavement/modular", Surface::kSlabs},
    {"highway", "pedestrian", "ground/pavement/modular", Surface::kPlazaStone},
    {"highway", "footway", "ground/pavement/modular", Surface::kSlabs},
    {"highway", "service", "ground/parking", Surface::kAsphaltOld},
    {"highway", "rest_area", "ground/parking", Surface::kAsphaltOld},
    {"area:highway", "footway", "ground/sidewalk", Surface::kSlabs},
    {"place", "square", "ground/pavement/modular", Surface::kPlazaStone},
    {"man_made", "pier", "ground/pavement/modular", Surface::kSlabsWarm},
    {"man_made", "breakwater", "ground/gravel", Surface::kPath},
    {"man_made", "groyne", "ground/gravel", Surface::kPath},
    {"landuse", "meadow", "ground/grass", Surface::kLawn},
    {"landuse", "recreation_ground", "ground/grass", Surface::kLawn},
    {"landuse", "cemetery", "ground/grass", Surface::kLawn},
    {"landuse", "forest", "ground/terrain/landscape", Surface::kForestFloor},
    {"landuse", "orchard", "ground/terrain/landscape", Surface::kLawn},
    {"landuse", "farmland", "ground/dirt", Surface::kSoil},
    {"landuse", "allotments", "ground/terrain/landscape", Surface::kLawn},
    {"landuse", "construction", "ground/dirt", Surface::kSoil},
    {"landuse", "brownfield", "ground/dirt", Surface::kSoil},
    {"landuse", "greenfield", "ground/terrain/landscape", Surface::kLawn},
    {"landuse", "railway", "ground/gravel", Surface::kPath},
    {"leisure", "common", "ground/terrain/landscape", Surface::kLawn},
    {"leisure", "park", "ground/terrain/landscape", Surface::kLawn},
    {"leisure", "dog_park", "ground/terrain/landscape", Surface::kLawn},
    {"leisure", "golf_course", "ground/grass", Surface::kLawn},
    {"leisure", "nature_reserve", "ground/terrain/landscape", Surface::kLawn},
    {"tourism", "zoo", "ground/terrain/landscape", Surface::kLawn},
};

const AreaKind* KindOf(const OsmTags& tags) {
  for (const AreaKind& kind : kAreaKinds) {
    if (tags.Get(kind.key) != kind.value) continue;
    // Rings that are lines: a path around a lawn is no square.
    if (kind.key == "highway" && !tags.Is("area", "yes")) continue;
    return &kind;
  }
  return nullptr;
}

Surface PathSurface(const OsmTags& tags) {
  const std::string_view surface = tags.Get("surface"), highway = tags.Get("highway");
  for (const char* name : {"asphalt", "concrete"})
    if (surface == name) return Surface::kAsphaltOld;
  for (const char* name : {"paved", "paving_stones", "concrete:plates", "bricks", "brick"})
    if (surface == name) return Surface::kSlabs;
  for (const char* name : {"cobblestone", "sett", "unhewn_cobblestone", "cobblestone:flattened"})
    if (surface == name) return Surface::kPlazaStone;
  if (surface == "ground" || surface == "dirt" || surface == "earth" || surface == "mud") return Surface::kSoil;
  if (surface == "grass") return Surface::kLawn;
  if (!surface.empty()) return Surface::kPath;
  if (highway == "cycleway") return Surface::kBikeLane;
  if (tags.Is("footway", "sidewalk") || highway == "pedestrian" || highway == "steps") return Surface::kSlabs;
  return highway == "path" || highway == "track" || highway == "bridleway" ? Surface::kPath : Surface::kSlabs;
}

Surface RoadSurface(const RoadSegment& segment, uint64_t seed) {
  const std::string_view surface = segment.way->tags.Get("surface");
  for (const char* name : {"cobblestone", "sett", "paving_stones", "cobblestone:flattened", "unhewn_cobblestone"})
    if (surface == name) return Surface::kPlazaStone;
  for (const char* name : {"gravel", "unpaved", "compacted", "fine_gravel"})
    if (surface == name) return Surface::kPath;
  for (const char* name : {"ground", "dirt", "earth"})
    if (surface == name) return Surface::kSoil;
  if (segment.rank >= 6) return Surface::kAsphaltOld;
  return RngStream(seed, segment.id).Chance(0.3) ? Surface::kCarriagewayOld : Surface::kCarriageway;
}

struct PathKind {
  std::string_view highway, category;
  double width;
};
// In the order in which they are laid: steps lie in what leads to them.
constexpr PathKind kPaths[] = {
    {"steps", "construction/stairs", 2.4},        {"pedestrian", "ground/pavement/modular", 6}, {"cycleway", "ground/bike_lane", 2.2},
    {"footway", "ground/path/park_walkway", 2.4}, {"path", "ground/path/park_walkway", 1.8},    {"track", "ground/dirt", 2.6},
    {"bridleway", "ground/path/park_walkway", 2}, {"corridor", "ground/sidewalk", 2},
};

void LayPaths(OsmScene& scene, GroundBuilder& ground) {
  for (const PathKind& kind : kPaths) {
    for (const OsmWay& way : scene.data.ways) {
      if (!way.tags.Is("highway", kind.highway) || way.line.size() < 2) continue;
      if (Underground(way.tags) || OnBridge(way.tags) || way.tags.Is("area", "yes")) continue;
      const double width = ParseOsmLength(way.tags.Get("width"), 40).value_or(kind.width);
      const bool walk = way.tags.Is("footway", "sidewalk") || way.tags.Is("footway", "crossing");
      ground.Lay(OsmId("way", way.id) + (way.tags.Has("name") ? " " + std::string(way.tags.Get("name")) : ""),
                 walk ? "ground/sidewalk" : kind.category, PathSurface(way.tags), Band(way.line, width / 2, width / 2), 0);
    }
  }
}

// Piers and breakwaters that are lines.
void LayPiers(OsmScene& scene, GroundBuilder& ground) {
  for (const OsmWay& way : scene.data.ways) {
    if (way.closed() || way.line.size() < 2) continue;
    const AreaKind* kind = way.tags.Has("man_made") ? KindOf(way.tags) : nullptr;
    if (!kind || kind->key != "man_made") continue;
    const double width = ParseOsmLength(way.tags.Get("width"), 60).value_or(kind->value == "pier" ? 2.5 : 5);
    ground.Lay(OsmId("way", way.id) + (way.tags.Has("name") ? " " + std::string(way.tags.Get("name")) : ""), kind->category, kind->surface,
               Band(way.line, width / 2, width / 2), 0);
  }
}

// The side of a piece of water, and the stones on it.
void LayBank(OsmScene& scene, GroundBuilder& ground, size_t piece, const std::string& id) {
  ground.mesh().SetEntity(scene.builder.AddEntity(id + "/bank", scene.builder.tree().At("construction/wall")));
  ground.mesh().SetMaterial(scene.surfaces[Surface::kLimestone]);
  ground.Rim(piece, kWaterDrop, 0.3);
}

// Areas, and the sea below them all; its entity, kNoEntity where there is none.
EntityId LayAreas(OsmScene& scene, GroundBuilder& ground) {
  std::vector<const OsmArea*> areas;
  for (const OsmArea& area : scene.areas)
    if (!area.patches.empty() && !area.tags->Has("building") && !area.tags->Has("building:part") && KindOf(*area.tags))
      areas.push_back(&area);
  std::stable_sort(areas.begin(), areas.end(), [](const OsmArea* a, const OsmArea* b) { return a->area < b->area; });
  std::vector<std::pair<size_t, std::string>> waters;  // without banks yet
  for (const OsmArea* area : areas) {
    const AreaKind& kind = *KindOf(*area->tags);
    const bool water = kind.surface == Surface::kWater;
    const std::string name = area->id + (area->tags->Has("name") ? " " + std::string(area->tags->Get("name")) : "");
    const size_t before = ground.pieces().size();
    ground.Lay(name, kind.category, kind.surface, area->patches, water ? -kWaterDrop : 0, PlainUv, water);
    if (!water || ground.pieces().size() == before) continue;
    // Waters that may open into the sea have their banks when it is there.
    if (scene.sea.empty())
      LayBank(scene, ground, before, area->id);
    else
      waters.emplace_back(before, area->id);
  }
  EntityId sea = kNoEntity;
  if (!scene.sea.empty()) {
    const Bounds2d box = BoundsOf(ground.clip()[0].outer);
    const double cell = std::max({100.0, (box.max.x - box.min.x) / 64, (box.max.y - box.min.y) / 64});
    waters.emplace_back(ground.pieces().size(), "sea");
    sea = ground.Lay("sea", "water/sea", Surface::kWater, scene.sea, -kWaterDrop, PlainUv, true, cell);
    if (sea == kNoEntity) {  // bays and piers cover it
      waters.pop_back();
      sea = scene.builder.AddEntity("sea", scene.builder.tree().At("water/sea"));
    }
  }
  for (const auto& water : waters) LayBank(scene, ground, water.first, water.second);
  return sea;
}

// Plots of a block where a garden is rather than a court.
Patches GardensOf(const Patch& block) {
  constexpr double kPlot = 17;
  const Bounds2d box = BoundsOf(block.outer);
  Patches plots;
  if ((box.max.x - box.min.x) * (box.max.y - box.min.y) > 4e6) return {};
  for (double y = std::floor(box.min.y / kPlot); y * kPlot < box.max.y; ++y)
    for (double x = std::floor(box.min.x / kPlot); x * kPlot < box.max.x; ++x) {
      if (MixBits(static_cast<uint64_t>(static_cast<int64_t>(x) * 100'003 + static_cast<int64_t>(y))) % 8 >= 5) continue;
      const Vec2d a{x * kPlot, y * kPlot};
      plots.push_back({{a, {a.x + kPlot, a.y}, {a.x + kPlot, a.y + kPlot}, {a.x, a.y + kPlot}}, {}});
    }
  return plots.empty() ? Patches{} : Intersect(Patches{block}, Unite(plots));
}

// What is left: one entity a block, paved where it is built up, else green.
std::vector<Neighbours::Yard> LayRest(GroundBuilder& ground, const std::vector<OsmBuilding>& buildings, bool fill) {
  Patches taken;
  for (const GroundPiece& piece : ground.pieces()) taken.insert(taken.end(), piece.patches.begin(), piece.patches.end());
  const Patches blocks = Subtract(ground.clip(), taken);
  std::vector<std::pair<Vec2d, double>> houses;
  for (const OsmBuilding& building : buildings)
    for (const OsmVolume& volume : building.volumes)
      if (volume.bottom < 1)
        for (const Patch& patch : volume.footprint) {
          const Bounds2d box = BoundsOf(patch.outer);
          houses.emplace_back((box.min + box.max) * 0.5, Area(patch));
        }
  int number = 0;
  std::vector<Neighbours::Yard> yards;
  for (const Patch& block : blocks) {
    const Bounds2d box = BoundsOf(block.outer);
    double built = 0;
    for (const auto& house : houses)
      if (box.Contains(house.first) && Inside(block, house.first)) built += house.second;
    const bool paved = built > 0.28 * Area(block);
    const std::string name = (paved ? "yard " : "green ") + std::to_string(++number);
    using Kind = Neighbours::Yard::Kind;
    if (paved && fill && ground.Lay(name + "/gardens", "ground/grass", Surface::kLawn, GardensOf(block), 0) != kNoEntity)
      yards.push_back({name + "/gardens", ground.last().patches, Kind::kGarden});
    if (ground.Lay(name, paved ? "ground/pavement/modular" : "ground/terrain/landscape", paved ? Surface::kAsphaltOld : Surface::kLawn,
                   {block}, 0) != kNoEntity)
      yards.push_back({name, ground.last().patches, paved ? Kind::kCourt : Kind::kMeadow});
  }
  return yards;
}

}  // namespace

bool IsOpenCountry(const OsmTags& tags) {
  const AreaKind* kind = KindOf(tags);
  return kind && kind->value != "pitch" &&
         (kind->category == "ground/terrain/landscape" || kind->category == "ground/grass" || kind->category == "ground/dirt");
}

namespace {

LineIndex WallsAtTheGround(const std::vector<OsmBuilding>& buildings) {
  LineIndex walls;
  for (size_t i = 0; i < buildings.size(); ++i)
    for (const OsmVolume& volume : buildings[i].volumes) {
      if (volume.bottom > 3 || volume.canopy) continue;
      for (const Patch& patch : volume.footprint) walls.AddRing(patch.outer, static_cast<uint32_t>(i));
    }
  return walls;
}

// Junctions, then the segments between them; side streets give way to main ones. Then the kerbs of all.
std::vector<Patch> LayRoads(OsmScene& scene, RoadGraph& graph, GroundBuilder& ground, Neighbours& near) {
  std::vector<Patch> junctions(graph.nodes.size());
  for (size_t i = 0; i < graph.nodes.size(); ++i) {
    junctions[i] = JunctionOf(graph, i);
    if (!junctions[i].outer.empty())
      ground.Lay(OsmId("node", graph.nodes[i].id) + "/junction", "ground/road", Surface::kAsphalt, Unite(Patches{junctions[i]}), -kRoadDrop,
                 PlainUv, true);
  }
  std::vector<size_t> order(graph.segments.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return graph.segments[a].rank < graph.segments[b].rank; });
  for (size_t i : order) {
    const RoadSegment& segment = graph.segments[i];
    // Ends without a junction overlap a little, so that widths that differ leave no gap.
    Patches band = Band(segment.line, segment.half, segment.half);
    const std::string_view name = segment.way->tags.Get("name");
    ground.Lay(segment.id + (name.empty() ? "" : " " + std::string(name)), "ground/road", RoadSurface(segment, scene.options.seed), band,
               -kRoadDrop, StreetUv(segment.line), true);
    for (size_t k = 0; k + 1 < segment.line.size(); ++k) near.roads.Add(segment.line[k], segment.line[k + 1], static_cast<uint32_t>(i));
  }
  const size_t carriageways = ground.pieces().size();
  for (size_t i = 0; i < carriageways; ++i) {
    ground.mesh().SetEntity(scene.builder.AddEntity(ground.pieces()[i].id + "/kerb", scene.builder.tree().At("ground/kerb")));
    ground.mesh().SetMaterial(scene.surfaces[Surface::kKerb]);
    ground.Rim(i, kRoadDrop, 0.15);
  }
  return junctions;
}

// Pavements on both sides, then around the corners.
void LayPavements(const RoadGraph& graph, const std::vector<Patch>& junctions, GroundBuilder& ground) {
  for (const RoadSegment& segment : graph.segments) {
    for (int side = 0; side < 2; ++side) {
      if (segment.pavement[side] < 0.5) continue;
      const double outer = segment.half + segment.pavement[side];
      ground.Lay(segment.id + (side == 0 ? "/pavement_left" : "/pavement_right"), "ground/sidewalk", Surface::kSlabs,
                 side == 0 ? Band(segment.line, outer, -segment.half) : Band(segment.line, -segment.half, outer), 0);
    }
  }
  for (size_t i = 0; i < graph.nodes.size(); ++i) {
    double width = 0;
    for (const auto& arm : graph.nodes[i].arms)
      width = std::max({width, graph.segments[arm.first].pavement[0], graph.segments[arm.first].pavement[1]});
    if (junctions[i].outer.empty() || width < 0.5) continue;
    Ring ring = junctions[i].outer;
    ring.push_back(Ring::value_type(ring[0]));
    ring.push_back(Ring::value_type(ring[1]));
    ground.Lay(OsmId("node", graph.nodes[i].id) + "/pavement", "ground/sidewalk", Surface::kSlabs, Band(ring, 0, std::min(width, 4.5)), 0);
  }
}

// Buildings cover so much of the extent that a town goes on around it.
bool IsTown(const OsmScene& scene, const std::vector<OsmBuilding>& buildings) {
  double built = 0;
  for (const OsmBuilding& building : buildings) built += Area(building.outline);
  return built > 0.2 * scene.data.extent.width() * scene.data.extent.depth() && (!scene.dress || scene.dress->town_around);
}

}  // namespace

void BuildOsmGround(OsmScene& scene, const std::vector<OsmBuilding>& buildings, Neighbours& near) {
  RoadGraph graph = PlanRoads(scene.data, WallsAtTheGround(buildings));
  GroundBuilder ground(scene);
  const std::vector<Patch> junctions = LayRoads(scene, graph, ground, near);
  LayPavements(graph, junctions, ground);
  LayPaths(scene, ground);
  LayPiers(scene, ground);
  const EntityId sea = LayAreas(scene, ground);
  near.yards = LayRest(ground, buildings, scene.options.fill);
  for (const RoadSegment& segment : graph.segments) PaintSegment(scene, ground.mesh(), graph, segment, -kRoadDrop);
  PaintCrossings(scene, ground.mesh(), graph, -kRoadDrop);
  BuildBridges(scene, ground.mesh());
  near.lawns = ground.Near(Surface::kLawn);
  near.woods = ground.Near(Surface::kForestFloor);
  const bool town = IsTown(scene, buildings);
  const std::vector<EdgeStretch> edge = EdgeOf(scene, ground, town);
  LayCountry(scene, ground, edge, town, sea);
  if (town && scene.options.fill) RaiseBackdrop(scene, ground.mesh(), buildings, edge);
  ground.Finish("ground");
  near.graph = std::make_shared<RoadGraph>(std::move(graph));
}

}  // namespace airsim360::internal

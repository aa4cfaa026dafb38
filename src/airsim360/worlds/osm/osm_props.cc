// Trees, lamps, furniture, barriers of a map; and by rule what the map has none of.
#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/district.h"
#include "airsim360/worlds/osm/osm_streets.h"

namespace airsim360::internal {
namespace {

constexpr double kTau = 2 * M_PI;
constexpr int kMostPlanted = 12000;  // trees by rule in one world

struct NodeKind {
  std::string_view key, value, kind;
  bool kerbside;  // stands at the kerb and looks to the street
};
constexpr NodeKind kNodes[] = {
    {"highway", "street_lamp", "street_light", true},
    {"amenity", "bench", "bench_wood", false},
    {"amenity", "waste_basket", "trash_can", false},
    {"amenity", "waste_disposal", "trash_can", false},
    {"amenity", "recycling", "recycle_bin", false},
    {"amenity", "grit_bin", "electric_box", false},
    {"emergency", "fire_hydrant", "fire_hydrant", true},
    {"amenity", "fire_hydrant", "fire_hydrant", true},
    {"amenity", "post_box", "mailbox", true},
    {"highway", "bus_stop", "bus_stop", true},
    {"highway", "stop", "traffic_sign", true},
    {"highway", "give_way", "traffic_sign", true},
    {"traffic_sign", "*", "traffic_sign", true},
    {"highway", "speed_camera", "electric_box", true},
    {"man_made", "street_cabinet", "electric_box", true},
    {"amenity", "fountain", "fountain", false},
    {"advertising", "*", "poster_stand", false},
    {"tourism", "information", "poster_stand", false},
    {"amenity", "vending_machine", "parking_meter", true},
    {"barrier", "bollard", "car_pillar", false},
    {"barrier", "block", "road_block", false},
    {"leisure", "picnic_table", "picnic_table", false},
    {"natural", "stone", "rock", false},
    {"natural", "rock", "rock", false},
    {"playground", "*", "playground", false},
    {"man_made", "manhole", "manhole", false},
    {"man_made", "water_tower", "water_tank", false},
    {"man_made", "antenna", "antenna", false},
    {"amenity", "fast_food", "", false},
};

class Dresser {
 public:
  Dresser(OsmScene& scene, const Neighbours& near) : scene_(scene), near_(near) {
    for (size_t i = 0; i < scene.data.ways.size(); ++i) {
      const OsmWay& way = scene.data.ways[i];
      if (!way.tags.Has("highway")) continue;
      for (size_t k = 0; k + 1 < way.line.size(); ++k) paths_.Add(way.line[k], way.line[k + 1], static_cast<uint32_t>(i));
    }
  }

  void Nodes() {
    for (const OsmNode& node : scene_.data.nodes) {
      if (node.tags.Is("natural", "tree")) {
        Tree(OsmId("node", node.id), node.p, &node.tags);
        ++trees_;
      } else if (node.tags.Is("highway", "traffic_signals")) {
        Signals(node);
      } else if (node.tags.Is("amenity", "bicycle_parking")) {
        Bicycles(node);
      } else if (node.tags.Is("man_made", "flagpole")) {
        Pole(node);
      } else if (node.tags.Is("historic", "memorial") || node.tags.Is("historic", "monument") || node.tags.Is("tourism", "artwork")) {
        Statue(node);
      } else {
        Simple(node);
      }
    }
  }

  void Ways() {
    for (const OsmWay& way : scene_.data.ways) {
      if (way.line.size() < 2) continue;
      if (way.tags.Is("natural", "tree_row")) {
        const double length = LengthOf(way.line);
        int number = 0;
        for (double s = 0; s <= length && number < 2000; s += 8)
          Tree(OsmId("way", way.id) + "/tree " + std::to_string(++number), PointAt(way.line, s).p, &way.tags);
        ++trees_;
      }
      if (way.tags.Has("barrier")) Barrier(way);
      if (way.tags.Is("railway", "rail") || way.tags.Is("railway", "tram") || way.tags.Is("railway", "light_rail")) Rails(way);
    }
  }

  void Areas() {
    for (const OsmArea& area : scene_.areas) {
      if (area.patches.empty()) continue;
      const OsmTags& tags = *area.tags;
      const Vec2d middle = (area.bounds.min + area.bounds.max) * 0.5;
      if (tags.Is("natural", "wood") || tags.Is("landuse", "forest")) Plant(area, 46, 0);
      if (tags.Is("natural", "scrub")) Shrubs(area);
      if (tags.Is("landuse", "orchard")) Plant(area, 36, 0);
      if (scene_.options.fill && (tags.Is("leisure", "park") || tags.Is("leisure", "garden") || tags.Is("leisure", "common"))) Plant(area, 150, 2);
      if (tags.Is("leisure", "playground")) Playground(area);
      if (tags.Is("amenity", "parking") && scene_.options.fill) Parked(area);
      // Furniture that is mapped as an area.
      for (const NodeKind& row : kNodes)
        if (!row.kind.empty() && (row.key == "amenity" || row.key == "highway") && tags.Get(row.key) == row.value && row.value != "fountain")
          scene_.Put(area.id, row.kind, scene_.On(middle), 0, 1, 0);
    }
  }

  // Along the streets: lamps and trees where the map has none at all, cars at the kerb, manholes.
  void Fill() {
    const bool lamps = HasAny("highway", "street_lamp"), bins = HasAny("amenity", "waste_basket"),
               hydrants = HasAny("emergency", "fire_hydrant");
    for (const RoadSegment& segment : near_.graph->segments) {
      const double length = segment.Length(), s0 = segment.start + 6, s1 = length - segment.end - 6;
      if (segment.rank == 0 || segment.rank > 5 || s1 - s0 < 8 || segment.half < 2.6) continue;
      if (scene_.Far(segment.line[0]) > 900 && scene_.Far(segment.line.back()) > 900) continue;
      RngStream rng(scene_.options.seed, "street " + segment.id);
      for (int side : {1, -1}) {
        const double pavement = segment.pavement[side > 0 ? 0 : 1];
        // Staggered, so that the nearest lamp is 19 to 20 m away, over the street.
        const double across = 2 * (segment.half + 0.55), stagger = std::sqrt(std::max(19.7 * 19.7 - across * across, 150.0));
        if (!lamps && pavement > 1.2) Row(segment, s0 + (side > 0 ? 0 : stagger), s1, 2 * stagger, side, 0.55, "street_light", rng);
        if (trees_ == 0 && pavement > 2.6 && rng.Chance(0.8)) TreeRow(segment, s0 + 5, s1, side, rng);
        if (pavement > 2.2) {
          if (!bins) Row(segment, s0 + rng.Uniform(4, 60), s1, 80, side, 0.7, "trash_can", rng);
          if (!hydrants) Row(segment, s0 + rng.Uniform(4, 90), s1, 110, side, 0.55, "fire_hydrant", rng);
          Row(segment, s0 + rng.Uniform(4, 70), s1, 70, side, 0.5, "traffic_sign", rng);
        }
        if (segment.rank >= 2 && segment.rank <= 4 && segment.half > 3.6) Cars(segment, s0 + 3, s1 - 3, side, rng);
      }
      for (double s = s0 + rng.Uniform(0, 30); s < s1; s += rng.Uniform(30, 60)) {
        const LinePoint at = PointAt(segment.line, s);
        const Vec2d p = at.p + Vec2d{-at.along.y, at.along.x} * rng.Uniform(-1, 1);
        if (!Here(p)) continue;
        scene_.Put(segment.id + "/manhole", "manhole", scene_.On(p, -0.127), rng.Uniform(0, kTau), 1, rng.Index(2));
      }
    }
  }

  // Blades of grass on the lawns around the first viewpoint.
  void Grass(const std::vector<std::pair<EntityId, Patches>>& lawns) {
    RngStream rng(scene_.options.seed, "grass");
    const double reach = 42;
    for (int i = 0; i < 9000; ++i) {
      const double a = rng.Uniform(0, kTau), r = reach * std::sqrt(rng.Uniform());
      const Vec2d p = scene_.focus + Vec2d{std::cos(a), std::sin(a)} * r;
      const auto yaw = static_cast<float>(rng.Uniform(0, kTau)), scale = static_cast<float>(rng.Uniform(0.7, 1.3));
      const auto variant = rng.Index(16);
      for (const auto& lawn : lawns)
        for (const Patch& patch : lawn.second)
          if (BoundsOf(patch.outer).Contains(p) && Inside(patch, p))
            scene_.shelf.PlaceAs(lawn.first, "grass_tuft", PlaceUpright(scene_.On(p), yaw, scale), variant);
    }
  }

 private:
  bool Here(Vec2d p) const { return scene_.data.extent.Contains(p, 24); }
  bool HasAny(std::string_view key, std::string_view value) const {
    return std::any_of(scene_.data.nodes.begin(), scene_.data.nodes.end(), [&](const OsmNode& node) { return node.tags.Is(key, value); });
  }
  bool OnRoad(Vec2d p, double margin) const {
    const LineIndex::Near road = near_.roads.Find(p, 16);
    return road.owner != UINT32_MAX && road.distance < near_.graph->segments[road.owner].half + margin;
  }
  bool InBuilding(Vec2d p) const {
    for (uint32_t i : near_.boxes.Find(p)) {
      if (near_.volumes[i].volume->bottom > 3) continue;
      for (const Patch& patch : near_.volumes[i].volume->footprint)
        if (Inside(patch, p) || DistanceToRing(patch.outer, p) < 0.6) return true;
    }
    return false;
  }
  // Off the carriageway, beside its kerb; the second value looks to the street.
  std::pair<Vec2d, Vec2d> Beside(Vec2d p, double gap) const {
    const LineIndex::Near road = near_.roads.Find(p, 24);
    if (road.owner == UINT32_MAX) return {p, {0, -1}};
    Vec2d away = p - road.point;
    double d = std::hypot(away.x, away.y);
    if (d < 0.3) {
      // On the centre line: to the right of it.
      away = {road.direction.y, -road.direction.x};
      d = 0;
    } else {
      away = away * (1 / d);
    }
    const double need = near_.graph->segments[road.owner].half + gap;
    return {d < need ? road.point + away * need : p, away * -1.0};
  }
  static double Yaw(Vec2d front) { return FacingYaw(ToFloat(front)); }

  void Tree(const std::string& name, Vec2d p, const OsmTags* tags) {
    RngStream rng(scene_.options.seed, name);
    const auto tag = [&](const char* key) { return tags ? tags->Get(key) : std::string_view(); };
    const std::string species = std::string(tag("species")) + std::string(tag("genus")) + std::string(tag("taxon"));
    const auto has = [&](const char* word) { return species.find(word) != std::string::npos; };
    const bool needles = tag("leaf_type") == "needleleaved" || has("Pinus") || has("Picea") || has("Abies") || has("Larix") || has("Taxus");
    const char* kind = needles ? "tree_pine" : has("Populus") || has("Carpinus") || rng.Chance(0.12) ? "tree_narrowleaf" : "tree_generic";
    const double typical = needles ? 13 : 10.5;
    const double height = ParseOsmLength(tag("height"), 60).value_or(typical * rng.Uniform(0.75, 1.2));
    scene_.Put(name, kind, scene_.On(p, -0.03), rng.Uniform(0, kTau), static_cast<float>(std::clamp(height / typical, 0.25, 2.2)),
               rng.Index(6), Vec3f{1, 1, 1} * static_cast<float>(rng.Uniform(0.88, 1.08)));
    scene_.occupancy.Add({ToFloat(p), {0.5f, 0.5f}, 0});
  }

  void Simple(const OsmNode& node) {
    for (const NodeKind& row : kNodes) {
      const bool any = row.value == "*";
      if (row.kind.empty() || (any ? !node.tags.Has(row.key) : !node.tags.Is(row.key, row.value))) continue;
      if (row.kind == "bus_stop" && node.tags.Is("shelter", "no")) {
        Place(node, "traffic_sign", true);
      } else {
        Place(node, row.kind, row.kerbside);
      }
      return;
    }
  }

  void Place(const OsmNode& node, std::string_view kind, bool kerbside) {
    RngStream rng(scene_.options.seed, OsmId("node", node.id));
    const std::string name = OsmId("node", node.id) + (node.tags.Has("name") ? " " + std::string(node.tags.Get("name")) : "");
    auto [p, front] = Beside(node.p, kind == "bus_stop" ? 1.3 : 0.55);
    if (!kerbside && !OnRoad(node.p, 0.2)) p = node.p;
    // Benches look to the nearest path unless the map says where.
    if (!kerbside) {
      const LineIndex::Near path = paths_.Find(p, 20);
      if (path.owner != UINT32_MAX && path.distance > 0.05) front = (path.point - p) * (1 / path.distance);
    }
    double yaw = Yaw(front);
    if (const auto compass = ParseOsmNumber(node.tags.Get("direction"), 0, 360)) yaw = Yaw({std::sin(*compass * M_PI / 180), std::cos(*compass * M_PI / 180)});
    scene_.Put(name, kind, scene_.On(p), yaw, 1, rng.Index(8));
    scene_.occupancy.Add(FootprintOf(kind, ToFloat(p), static_cast<float>(yaw)));
  }

  void Signals(const OsmNode& node) {
    // A mast on the right of every arm that comes in; a signal away from junctions has one.
    int number = 0;
    const std::string name = OsmId("node", node.id);
    for (const RoadNode& junction : near_.graph->nodes) {
      if (junction.id != node.id || junction.arms.size() < 3) continue;
      for (const auto& entry : junction.arms) {
        const RoadSegment& segment = near_.graph->segments[entry.first];
        if (segment.oneway && entry.second) continue;  // nobody comes from there
        const double length = segment.Length(), back = std::min(length, (entry.second ? segment.start : segment.end) + 0.5);
        const LinePoint at = PointAt(segment.line, entry.second ? back : length - back);
        const Vec2d in = entry.second ? at.along * -1.0 : at.along, right{in.y, -in.x};
        const Vec2d p = at.p + right * (segment.half + 0.6);
        ++number;
        scene_.Put(number > 1 ? name + "/" + std::to_string(number) : name, "traffic_light", scene_.On(p), Yaw(in * -1.0), 1, number % 2 ? 0 : 1);
        scene_.occupancy.Add({ToFloat(p), {0.4f, 0.4f}, 0});
      }
    }
    if (number > 0) return;
    const auto [p, front] = Beside(node.p, 0.6);
    const LineIndex::Near road = near_.roads.Find(node.p, 24);
    scene_.Put(name, "traffic_light", scene_.On(p), Yaw(road.owner == UINT32_MAX ? front : road.direction * -1.0), 1, 0);
  }

  void Bicycles(const OsmNode& node) {
    RngStream rng(scene_.options.seed, OsmId("node", node.id));
    const auto [p, front] = Beside(node.p, 0.9);
    const EntityId entity = scene_.builder.AddEntity(OsmId("node", node.id), scene_.builder.tree().At("vehicle/bicycle"));
    const int count = std::clamp(static_cast<int>(ParseOsmNumber(node.tags.Get("capacity"), 1, 500).value_or(4)) / 2, 1, 6);
    const Vec2d along{-front.y, front.x};
    for (int i = 0; i < count; ++i)
      scene_.shelf.PlaceAs(entity, "bicycle", PlaceUpright(scene_.On(p + along * (0.75 * (i - 0.5 * count))), static_cast<float>(Yaw(front) + rng.Uniform(-0.1, 0.1))), rng.Index(3));
    scene_.occupancy.Add({ToFloat(p), {static_cast<float>(0.4 * count), 0.9f}, static_cast<float>(std::atan2(along.y, along.x))});
  }

  void Pole(const OsmNode& node) {
    const double height = ParseOsmLength(node.tags.Get("height"), 120).value_or(9);
    mesh_.SetEntity(scene_.builder.AddEntity(OsmId("node", node.id), scene_.builder.tree().Add("construction/mast")));
    mesh_.SetMaterial(scene_.surfaces[Surface::kMetal]);
    const Vec3f p = scene_.On(node.p);
    mesh_.Tube(p, p + Vec3f{0, 0, static_cast<float>(height)}, 0.09f, 0.05f, 10, false, true);
    mesh_.Sphere(p + Vec3f{0, 0, static_cast<float>(height)}, {0.1f, 0.1f, 0.1f}, 6, 8);
  }

  void Statue(const OsmNode& node) {
    if (InBuilding(node.p)) return;
    const std::string name = OsmId("node", node.id) + (node.tags.Has("name") ? " " + std::string(node.tags.Get("name")) : "");
    mesh_.SetEntity(scene_.builder.AddEntity(name, scene_.builder.tree().At("construction/statue")));
    mesh_.SetMaterial(scene_.surfaces[Surface::kGranite]);
    const Vec3f p = scene_.On(node.p, -0.05);
    mesh_.Box(p + Vec3f{-0.8f, -0.8f, 0}, p + Vec3f{0.8f, 0.8f, 0.3f});
    mesh_.Box(p + Vec3f{-0.55f, -0.55f, 0.3f}, p + Vec3f{0.55f, 0.55f, 1.5f});
    mesh_.SetMaterial(scene_.tints.Get(scene_.surfaces[Surface::kMetal], {0.10f, 0.13f, 0.10f}, 0.42f, 0.6f));
    mesh_.Tube(p + Vec3f{0, 0, 1.5f}, p + Vec3f{0, 0, 2.9f}, 0.34f, 0.2f, 12);
    mesh_.Sphere(p + Vec3f{0, 0, 3.1f}, {0.19f, 0.19f, 0.23f}, 8, 12);
  }

  void Barrier(const OsmWay& way) {
    const std::string_view kind = way.tags.Get("barrier");
    const std::string id = OsmId("way", way.id);
    SemanticTree& tree = scene_.builder.tree();
    if (kind == "wall" || kind == "retaining_wall" || kind == "city_wall") {
      const double height = ParseOsmLength(way.tags.Get("height"), 30).value_or(kind == "city_wall" ? 6 : 1.2), half = kind == "city_wall" ? 0.9 : 0.17;
      mesh_.SetEntity(scene_.builder.AddEntity(id, tree.At("barrier/wall")));
      mesh_.SetMaterial(scene_.surfaces[way.tags.Is("wall", "brick") || way.tags.Is("material", "brick") ? Surface::kBrickRed : Surface::kLimestone]);
      for (const Patch& patch : Band(way.line, half, half)) {
        const auto side = [&](const Ring& ring) {
          for (size_t i = 0; i < ring.size(); ++i) {
            const Vec2d a = ring[i], b = ring[(i + 1) % ring.size()];
            mesh_.Quad(scene_.On(a, -0.3), scene_.On(b, -0.3), scene_.On(b, height), scene_.On(a, height));
          }
        };
        side(patch.outer);
        for (const Ring& hole : patch.holes) side(hole);
        std::vector<Vec2d> points = patch.outer;
        for (const Ring& hole : patch.holes) points.insert(points.end(), hole.begin(), hole.end());
        const std::vector<uint32_t> t = Triangulate(patch);
        for (size_t i = 0; i + 2 < t.size(); i += 3)
          mesh_.Triangle(scene_.On(points[t[i]], height), scene_.On(points[t[i + 1]], height), scene_.On(points[t[i + 2]], height), ToFloat(points[t[i]]), ToFloat(points[t[i + 1]]), ToFloat(points[t[i + 2]]));
      }
      return;
    }
    const bool hedge = kind == "hedge", fence = kind == "fence" || kind == "handrail" || kind == "guard_rail" || kind == "chain" || kind == "railing";
    if (!hedge && !fence) return;
    const std::string_view type = way.tags.Get("fence_type");
    const std::string_view prop = hedge ? "hedge" : type == "wood" || type == "split_rail" || type == "pole" ? "wood_fence" : "rail";
    const PropKind& row = FindPropKind(prop);
    const EntityId entity = scene_.builder.AddEntity(id, tree.At(row.category));
    const double panel = hedge ? 1 : 2;
    RngStream rng(scene_.options.seed, id);
    int left = 6000;
    for (size_t i = 0; i + 1 < way.line.size(); ++i) {
      const Vec2d a = way.line[i], v = way.line[i + 1] - a;
      const double length = std::hypot(v.x, v.y);
      if (length < 0.2) continue;
      const int panels = std::max(1, static_cast<int>(std::lround(length / panel)));
      const double height = ParseOsmLength(way.tags.Get("height"), 8).value_or(0);
      for (int k = 0; k < panels && left-- > 0; ++k) {
        const Vec2d at = a + v * ((k + 0.5) / panels);
        AffineTransform X = PlaceUpright(scene_.On(at), static_cast<float>(std::atan2(v.y, v.x)));
        const auto stretch = static_cast<float>(length / (panel * panels));
        for (auto& r : X.A.m) r[0] *= stretch;
        if (height > 0.3) {
          const auto tall = static_cast<float>(height / 1.15);
          for (auto& r : X.A.m) r[2] *= tall;
        }
        scene_.shelf.PlaceAs(entity, prop, X, rng.Index(static_cast<uint32_t>(row.variants)));
      }
    }
  }

  void Rails(const OsmWay& way) {
    if (Underground(way.tags)) return;
    mesh_.SetEntity(scene_.builder.AddEntity(OsmId("way", way.id) + "/rails", scene_.builder.tree().Add("ground/rail", false)));
    mesh_.SetMaterial(scene_.surfaces[Surface::kMetal]);
    const double z = way.tags.Is("railway", "tram") ? -0.12 : 0.14;
    for (double d : {-0.75, 0.75})
      for (const Patch& patch : Band(way.line, d + 0.035, -d + 0.035)) {
        const std::vector<uint32_t> t = Triangulate(patch);
        for (size_t i = 0; i + 2 < t.size() && patch.holes.empty(); i += 3)
          mesh_.Triangle(scene_.On(patch.outer[t[i]], z), scene_.On(patch.outer[t[i + 1]], z), scene_.On(patch.outer[t[i + 2]], z));
      }
  }

  // About one tree in `each` square metres, apart from each other; `edge` metres off the border.
  void Plant(const OsmArea& area, double each, double edge) {
    if (each > 60) {
      // Parks whose trees are mapped stay as they are.
      for (const OsmNode& node : scene_.data.nodes)
        if (node.tags.Is("natural", "tree") && area.bounds.Contains(node.p) && Inside(area.patches[0], node.p)) return;
    }
    RngStream rng(scene_.options.seed, "plant " + area.id);
    const double cell = std::sqrt(each);
    int number = 0;
    if (std::max(area.bounds.max.x - area.bounds.min.x, area.bounds.max.y - area.bounds.min.y) > 2e5) return;
    for (double y = area.bounds.min.y; y < area.bounds.max.y; y += cell)
      for (double x = area.bounds.min.x; x < area.bounds.max.x; x += cell) {
        const Vec2d p{x + cell * rng.Uniform(0.1, 0.9), y + cell * rng.Uniform(0.1, 0.9)};
        if (planted_ >= kMostPlanted || !scene_.data.extent.Contains(p, 25)) continue;
        const Patch* home = nullptr;
        for (const Patch& patch : area.patches)
          if (Inside(patch, p)) home = &patch;
        if (!home || (edge > 0 && DistanceToRing(home->outer, p) < edge)) continue;
        if (OnRoad(p, 2.2) || InBuilding(p) || paths_.Find(p, 2.4).owner != UINT32_MAX) continue;
        if (!scene_.occupancy.IsFree({ToFloat(p), {1.2f, 1.2f}, 0})) continue;
        Tree(area.id + "/tree " + std::to_string(++number), p, area.tags);
        ++planted_;
      }
  }

  void Shrubs(const OsmArea& area) {
    RngStream rng(scene_.options.seed, "scrub " + area.id);
    if (std::max(area.bounds.max.x - area.bounds.min.x, area.bounds.max.y - area.bounds.min.y) > 3000) return;
    int number = 0;
    for (double y = area.bounds.min.y; y < area.bounds.max.y && number < 400; y += 3)
      for (double x = area.bounds.min.x; x < area.bounds.max.x && number < 400; x += 3) {
        const Vec2d p{x + rng.Uniform(0, 3), y + rng.Uniform(0, 3)};
        if (!Inside(area.patches[0], p) || OnRoad(p, 1) || paths_.Find(p, 1.6).owner != UINT32_MAX) continue;
        scene_.Put(area.id + "/shrub " + std::to_string(++number), "shrub", scene_.On(p, -0.03), rng.Uniform(0, kTau), static_cast<float>(rng.Uniform(0.7, 1.3)), rng.Index(4));
      }
  }

  void Playground(const OsmArea& area) {
    RngStream rng(scene_.options.seed, "playground " + area.id);
    int number = 0;
    for (int tries = 0; tries < 60 && number < 5; ++tries) {
      const Vec2d p{rng.Uniform(area.bounds.min.x, area.bounds.max.x), rng.Uniform(area.bounds.min.y, area.bounds.max.y)};
      const double yaw = rng.Uniform(0, kTau);
      const Footprint place = FootprintOf("playground", ToFloat(p), static_cast<float>(yaw), 1.25f);
      if (!Inside(area.patches[0], p) || DistanceToRing(area.patches[0].outer, p) < 3 || !scene_.occupancy.IsFree(place)) continue;
      scene_.occupancy.Add(place);
      ++number;
      scene_.Put(area.id + "/playground " + std::to_string(number), "playground", scene_.On(p), yaw, 1, static_cast<uint32_t>(number));
    }
  }

  // Cars in rows over a car park.
  void Parked(const OsmArea& area) {
    RngStream rng(scene_.options.seed, "parking " + area.id);
    Vec2d along{1, 0};
    double longest = 0;
    const Ring& ring = area.patches[0].outer;
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vec2d v = ring[(i + 1) % ring.size()] - ring[i];
      if (std::hypot(v.x, v.y) > longest) longest = std::hypot(v.x, v.y), along = v * (1 / longest);
    }
    const Vec2d across{-along.y, along.x}, middle = (area.bounds.min + area.bounds.max) * 0.5;
    const double reach = std::hypot(area.bounds.max.x - area.bounds.min.x, area.bounds.max.y - area.bounds.min.y) / 2;
    if (reach > 400) return;
    int number = 0, row = 0;
    for (double v = -reach; v < reach; v += row % 2 ? 5.2 : 11.4, ++row)
      for (double u = -reach; u < reach && number < 300; u += 2.7) {
        const Vec2d p = middle + along * u + across * v;
        if (!rng.Chance(0.55) || !Inside(area.patches[0], p) || DistanceToRing(ring, p) < 2.9 || InBuilding(p) || OnRoad(p, 2)) continue;
        Car(area.id + "/car " + std::to_string(++number), p, across * (row % 2 ? 1.0 : -1.0), 0, rng);
      }
  }

  void Car(const std::string& name, Vec2d p, Vec2d heading, double lift, RngStream& rng) {
    const char* kind = rng.Chance(0.88) ? "car" : "van";
    const double yaw = Yaw(heading);
    const Footprint place = FootprintOf(kind, ToFloat(p), static_cast<float>(yaw));
    if (!scene_.occupancy.IsFree(place)) return;
    scene_.occupancy.Add(place);
    scene_.Put(name, kind, scene_.On(p, lift), yaw, 1, rng.Index(36));
  }

  void Cars(const RoadSegment& segment, double s0, double s1, int side, RngStream& rng) {
    int number = 0;
    const double full = rng.Uniform(0.35, 0.8);
    for (double s = s0; s < s1; s += 6.1) {
      if (!rng.Chance(full)) continue;
      const LinePoint at = PointAt(segment.line, s);
      const Vec2d left{-at.along.y, at.along.x};
      const Vec2d p = at.p + left * (side * (segment.half - 1.15));
      if (!Here(p) || OnOther(p, segment)) continue;
      const Vec2d heading = at.along * (side > 0 && !segment.oneway ? -1.0 : 1.0);
      Car(segment.id + (side > 0 ? "/car_left " : "/car_right ") + std::to_string(++number), p, heading, -0.13, rng);
    }
  }
  // Is p on the carriageway of another segment?
  bool OnOther(Vec2d p, const RoadSegment& self) const {
    const auto index = static_cast<uint32_t>(&self - near_.graph->segments.data());
    const LineIndex::Near other = near_.roads.Find(p, 14, index);
    return other.owner != UINT32_MAX && other.distance < near_.graph->segments[other.owner].half + 1.5;
  }

  void Row(const RoadSegment& segment, double s0, double s1, double pitch, int side, double gap, const char* kind, RngStream& rng) {
    int number = 0;
    for (double s = s0; s < s1; s += pitch) {
      const LinePoint at = PointAt(segment.line, s);
      const Vec2d left{-at.along.y, at.along.x}, p = at.p + left * (side * (segment.half + gap));
      const Vec2d front = left * -static_cast<double>(side);
      const Footprint place = FootprintOf(kind, ToFloat(p), static_cast<float>(Yaw(front)));
      if (!Here(p) || OnOther(p, segment) || InBuilding(p) || !scene_.occupancy.IsFree(place)) continue;
      scene_.occupancy.Add(place);
      scene_.Put(segment.id + "/" + kind + (side > 0 ? " left " : " right ") + std::to_string(++number), kind, scene_.On(p), Yaw(front), 1, rng.Index(8));
    }
  }

  void TreeRow(const RoadSegment& segment, double s0, double s1, int side, RngStream& rng) {
    int number = 0;
    for (double s = s0; s < s1; s += rng.Uniform(8.0, 9.6)) {
      const LinePoint at = PointAt(segment.line, s);
      const Vec2d p = at.p + Vec2d{-at.along.y, at.along.x} * (side * (segment.half + 1.0));
      const Footprint place{ToFloat(p), {0.7f, 0.7f}, 0};
      if (planted_ >= kMostPlanted || !Here(p) || OnOther(p, segment) || InBuilding(p) || !scene_.occupancy.IsFree(place)) continue;
      scene_.occupancy.Add(place);
      const std::string name = segment.id + (side > 0 ? "/tree left " : "/tree right ") + std::to_string(++number);
      // Crowns keep off the walls.
      const double free = segment.pavement[side > 0 ? 0 : 1];
      scene_.Put(name, rng.Chance(0.3) ? "tree_narrowleaf" : "tree_generic", scene_.On(p, -0.02), rng.Uniform(0, kTau),
                 static_cast<float>(std::clamp(0.42 + 0.1 * free, 0.5, 0.95) * rng.Uniform(0.85, 1.1)), rng.Index(6));
      ++planted_;
    }
  }

  OsmScene& scene_;
  const Neighbours& near_;
  MeshBuilder mesh_;
  LineIndex paths_;
  int trees_ = 0, planted_ = 0;

 public:
  void Finish() {
    if (!mesh_.empty()) scene_.builder.AddInstance({scene_.builder.AddMesh(mesh_.Finish("map objects")), {}, kNoEntity});
  }
};

}  // namespace

void BuildOsmProps(OsmScene& scene, const Neighbours& near) {
  Dresser dresser(scene, near);
  dresser.Nodes();
  dresser.Ways();
  dresser.Areas();
  if (scene.options.fill) dresser.Fill();
  dresser.Grass(near.lawns);
  dresser.Finish();
}

}  // namespace airsim360::internal

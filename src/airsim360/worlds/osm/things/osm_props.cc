// Trees, lamps and furniture that a map has as points.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/osm/osm_dresser.h"

namespace airsim360::internal {
namespace {

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

// "node/227 Church"
std::string NameOf(const OsmNode& node) {
  std::string name = OsmId("node", node.id);
  if (node.tags.Has("name")) name.append(1, ' ').append(node.tags.Get("name"));
  return name;
}

}  // namespace

std::span<const NodeKind> NodeKinds() { return kNodes; }

Dresser::Dresser(OsmScene& scene, const Neighbours& near) : scene_(scene), near_(near) {
  for (size_t i = 0; i < scene.data.ways.size(); ++i) {
    const OsmWay& way = scene.data.ways[i];
    if (!way.tags.Has("highway")) continue;
    for (size_t k = 0; k + 1 < way.line.size(); ++k) paths_.Add(way.line[k], way.line[k + 1], static_cast<uint32_t>(i));
  }
}

void Dresser::Nodes() {
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
    } else if (node.tags.Is("man_made", "surveillance")) {
      Camera(node);
    } else if (node.tags.Is("amenity", "vending_machine")) {
      VendingMachine(node);
    } else if (node.tags.Is("historic", "memorial") || node.tags.Is("historic", "monument") || node.tags.Is("tourism", "artwork")) {
      Statue(node);
    } else {
      Simple(node);
    }
  }
}

void Dresser::Tree(const std::string& name, Vec2d p, const OsmTags* tags) {
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

void Dresser::Simple(const OsmNode& node) {
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

void Dresser::Place(const OsmNode& node, std::string_view kind, bool kerbside) {
  RngStream rng(scene_.options.seed, OsmId("node", node.id));
  const std::string name = NameOf(node);
  auto [p, front] = Beside(node.p, kind == "bus_stop" ? 1.3 : 0.55);
  if (!kerbside && !OnRoad(node.p, 0.2)) p = node.p;
  // Benches look to the nearest path unless the map says where.
  if (!kerbside) {
    const LineIndex::Near path = paths_.Find(p, 20);
    if (path.owner != UINT32_MAX && path.distance > 0.05) front = (path.point - p) * (1 / path.distance);
  }
  double yaw = Yaw(front);
  if (const auto compass = ParseOsmNumber(node.tags.Get("direction"), 0, 360))
    yaw = Yaw({std::sin(*compass * M_PI / 180), std::cos(*compass * M_PI / 180)});
  scene_.Put(name, kind, scene_.On(p), yaw, 1, rng.Index(8));
  scene_.occupancy.Add(FootprintOf(kind, ToFloat(p), static_cast<float>(yaw)));
}

void Dresser::Signals(const OsmNode& node) {
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
      scene_.Put(number > 1 ? name + "/" + std::to_string(number) : name, "traffic_light", scene_.On(p), Yaw(in * -1.0), 1,
                 number % 2 ? 0 : 1);
      scene_.occupancy.Add({ToFloat(p), {0.4f, 0.4f}, 0});
    }
  }
  if (number > 0) return;
  const auto [p, front] = Beside(node.p, 0.6);
  const LineIndex::Near road = near_.roads.Find(node.p, 24);
  scene_.Put(name, "traffic_light", scene_.On(p), Yaw(road.owner == UINT32_MAX ? front : road.direction * -1.0), 1, 0);
}

void Dresser::Bicycles(const OsmNode& node) {
  RngStream rng(scene_.options.seed, OsmId("node", node.id));
  const auto [p, front] = Beside(node.p, 0.9);
  const EntityId entity = scene_.builder.AddEntity(OsmId("node", node.id), scene_.builder.tree().At("vehicle/bicycle"));
  const int count = std::clamp(static_cast<int>(ParseOsmNumber(node.tags.Get("capacity"), 1, 500).value_or(4)) / 2, 1, 6);
  const Vec2d along{-front.y, front.x};
  for (int i = 0; i < count; ++i) {
    const Vec3f at = scene_.On(p + along * (0.75 * (i - 0.5 * count)));
    const auto yaw = static_cast<float>(Yaw(front) + rng.Uniform(-0.1, 0.1));
    scene_.shelf.PlaceAs(entity, "bicycle", PlaceUpright(at, yaw), rng.Index(3));
  }
  scene_.occupancy.Add({ToFloat(p), {static_cast<float>(0.4 * count), 0.9f}, static_cast<float>(std::atan2(along.y, along.x))});
}

void Dresser::Pole(const OsmNode& node) {
  const double height = ParseOsmLength(node.tags.Get("height"), 120).value_or(9);
  mesh_.SetEntity(scene_.builder.AddEntity(OsmId("node", node.id), scene_.builder.tree().At("construction/mast")));
  mesh_.SetMaterial(scene_.surfaces[Surface::kMetal]);
  const Vec3f p = scene_.On(node.p);
  mesh_.Tube(p, p + Vec3f{0, 0, static_cast<float>(height)}, 0.09f, 0.05f, 10, false, true);
  mesh_.Sphere(p + Vec3f{0, 0, static_cast<float>(height)}, {0.1f, 0.1f, 0.1f}, 6, 8);
}

void Dresser::Statue(const OsmNode& node) {
  if (InBuilding(node.p)) return;
  const std::string name = NameOf(node);
  mesh_.SetEntity(scene_.builder.AddEntity(name, scene_.builder.tree().At("construction/statue")));
  mesh_.SetMaterial(scene_.surfaces[Surface::kGranite]);
  const Vec3f p = scene_.On(node.p, -0.05);
  mesh_.Box(p + Vec3f{-0.8f, -0.8f, 0}, p + Vec3f{0.8f, 0.8f, 0.3f});
  mesh_.Box(p + Vec3f{-0.55f, -0.55f, 0.3f}, p + Vec3f{0.55f, 0.55f, 1.5f});
  mesh_.SetMaterial(scene_.tints.Get(scene_.surfaces[Surface::kMetal], {0.10f, 0.13f, 0.10f}, 0.42f, 0.6f));
  mesh_.Tube(p + Vec3f{0, 0, 1.5f}, p + Vec3f{0, 0, 2.9f}, 0.34f, 0.2f, 12);
  mesh_.Sphere(p + Vec3f{0, 0, 3.1f}, {0.19f, 0.19f, 0.23f}, 8, 12);
}

// A camera on a mast, or at the wall of the building that it is mapped at.
void Dresser::Camera(const OsmNode& node) {
  const std::string_view where = node.tags.Get("surveillance");
  if (where == "indoor" || where == "indoors" || where == "interior" || Underground(node.tags)) return;
  const double height = ParseOsmLength(node.tags.Get("height"), 60).value_or(3.6);
  Vec2d at = node.p, front{0, -1};
  if (const LineIndex::Near road = near_.roads.Find(node.p, 60); road.owner != UINT32_MAX && road.distance > 0.3)
    front = (road.point - node.p) * (1 / road.distance);
  const bool wall = InBuilding(node.p, 0.8);
  if (wall) {
    // Out to the nearest face of the wall.
    double best = 3;
    for (double step = 0; step <= 3; step += 0.25)
      for (int i = 0; i < 16; ++i) {
        const Vec2d way{std::cos(i * kTau / 16), std::sin(i * kTau / 16)};
        if (step >= best || InBuilding(node.p + way * step, 0.05)) continue;
        best = step;
        at = node.p + way * step;
        front = way;
      }
  } else if (OnRoad(node.p, 0.2)) {
    std::tie(at, front) = Beside(node.p, 0.55);
  }
  if (const auto compass = ParseOsmNumber(node.tags.Get("camera:direction"), 0, 360))
    front = {std::sin(*compass * M_PI / 180), std::cos(*compass * M_PI / 180)};
  mesh_.SetEntity(scene_.builder.AddEntity(NameOf(node), scene_.builder.tree().Add("furniture/utility/camera")));
  mesh_.SetMaterial(scene_.surfaces[Surface::kMetal]);
  const Vec3f foot = scene_.On(at, -0.02), head = scene_.On(at, height);
  if (!wall) mesh_.Tube(foot, head, 0.06f, 0.045f, 10, false, true);
  mesh_.SetTransform(PlaceUpright(head, static_cast<float>(Yaw(front))));
  mesh_.SetMaterial(scene_.surfaces[Surface::kTrimWhite]);
  // Its front is -y, as of all props.
  mesh_.Box({-0.07f, -0.38f, -0.06f}, {0.07f, 0.06f, 0.08f});
  mesh_.SetTransform({});
  if (!wall) scene_.occupancy.Add({ToFloat(at), {0.3f, 0.3f}, 0});
}

void Dresser::VendingMachine(const OsmNode& node) {
  const std::string_view sells = node.tags.Get("vending");
  if (sells == "parking_tickets" || sells == "excrement_bags") return Place(node, "parking_meter", true);
  if (Underground(node.tags)) return;
  RngStream rng(scene_.options.seed, OsmId("node", node.id));
  auto [p, front] = Beside(node.p, 0.9);
  if (!OnRoad(node.p, 0.2)) p = node.p;
  static constexpr Vec3f kPaints[] = {{0.35f, 0.03f, 0.03f}, {0.04f, 0.09f, 0.28f}, {0.4f, 0.4f, 0.38f}, {0.05f, 0.2f, 0.08f}};
  mesh_.SetEntity(scene_.builder.AddEntity(NameOf(node), scene_.builder.tree().Add("furniture/vending/machine")));
  mesh_.SetMaterial(scene_.tints.Get(scene_.surfaces[Surface::kMetal], kPaints[rng.Index(4)], 0.42f, 0.1f));
  mesh_.SetTransform(PlaceUpright(scene_.On(p, -0.02), static_cast<float>(Yaw(front))));
  mesh_.Box({-0.46f, -0.4f, 0}, {0.46f, 0.4f, 1.85f});
  mesh_.SetMaterial(scene_.surfaces[Surface::kGlassDark]);
  mesh_.Quad({-0.38f, -0.405f, 0.65f}, {0.2f, -0.405f, 0.65f}, {0.2f, -0.405f, 1.75f}, {-0.38f, -0.405f, 1.75f});
  mesh_.SetTransform({});
  scene_.occupancy.Add({ToFloat(p), {0.6f, 0.6f}, 0});
}

bool Dresser::Here(Vec2d p) const { return scene_.data.extent.Contains(p, 24); }

bool Dresser::HasAny(std::string_view key, std::string_view value) const {
  return std::any_of(scene_.data.nodes.begin(), scene_.data.nodes.end(), [&](const OsmNode& node) { return node.tags.Is(key, value); });
}

bool Dresser::OnRoad(Vec2d p, double margin) const {
  const LineIndex::Near road = near_.roads.Find(p, 16);
  return road.owner != UINT32_MAX && road.distance < near_.graph->segments[road.owner].half + margin;
}

bool Dresser::InBuilding(Vec2d p, double margin) const {
  for (uint32_t i : near_.boxes.Find({p - Vec2d{margin, margin}, p + Vec2d{margin, margin}})) {
    if (near_.volumes[i].volume->bottom > 3) continue;
    for (const Patch& patch : near_.volumes[i].volume->footprint)
      if (Inside(patch, p) || DistanceToRing(patch.outer, p) < margin) return true;
  }
  return false;
}

// Off the carriageway, beside its kerb; the second value looks to the street.
std::pair<Vec2d, Vec2d> Dresser::Beside(Vec2d p, double gap) const {
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

void Dresser::Finish() {
  if (!mesh_.empty()) scene_.builder.AddInstance({scene_.builder.AddMesh(mesh_.Finish("map objects")), {}, kNoEntity});
}

void BuildOsmProps(OsmScene& scene, const Neighbours& near) {
  Dresser dresser(scene, near);
  dresser.Nodes();
  dresser.Ways();
  dresser.Areas();
  if (scene.options.fill) {
    dresser.Fill();
    dresser.Yards();
  }
  dresser.Grass(near.lawns);
  dresser.Undergrowth(near.woods);
  dresser.Finish();
}

}  // namespace airsim360::internal

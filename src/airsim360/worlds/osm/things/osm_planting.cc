// What stands on areas of a map: woods, scrub, playgrounds, parked cars, grass.
#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/osm/osm_dresser.h"

namespace airsim360::internal {
namespace {}  // namespace

void Dresser::Areas() {
  for (const OsmArea& area : scene_.areas) {
    if (area.patches.empty()) continue;
    const OsmTags& tags = *area.tags;
    const Vec2d middle = (area.bounds.min + area.bounds.max) * 0.5;
    if (tags.Is("natural", "wood") || tags.Is("landuse", "forest")) Plant(area, 46, 0);
    if (tags.Is("natural", "scrub")) Shrubs(area);
    if (tags.Is("landuse", "orchard")) Plant(area, 36, 0);
    if (scene_.options.fill && !tags.Is("trees", "none") &&
        (tags.Is("leisure", "park") || tags.Is("leisure", "garden") || tags.Is("leisure", "common")))
      Plant(area, 150, 2);
    if (tags.Is("leisure", "playground")) Playground(area);
    if (tags.Is("amenity", "parking") && scene_.options.fill) Parked(area);
    // Furniture that is mapped as an area.
    for (const NodeKind& row : NodeKinds())
      if (!row.kind.empty() && (row.key == "amenity" || row.key == "highway") && tags.Get(row.key) == row.value && row.value != "fountain")
        scene_.Put(area.id, row.kind, scene_.On(middle), 0, 1, 0);
  }
}

// About one tree in `each` square metres, apart from each other; `edge` metres off the border.
void Dresser::Plant(const OsmArea& area, double each, double edge) {
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

void Dresser::Shrubs(const OsmArea& area) {
  RngStream rng(scene_.options.seed, "scrub " + area.id);
  if (std::max(area.bounds.max.x - area.bounds.min.x, area.bounds.max.y - area.bounds.min.y) > 3000) return;
  int number = 0;
  for (double y = area.bounds.min.y; y < area.bounds.max.y && number < 400; y += 3)
    for (double x = area.bounds.min.x; x < area.bounds.max.x && number < 400; x += 3) {
      const Vec2d p{x + rng.Uniform(0, 3), y + rng.Uniform(0, 3)};
      if (!Inside(area.patches[0], p) || OnRoad(p, 1) || paths_.Find(p, 1.6).owner != UINT32_MAX) continue;
      const double turn = rng.Uniform(0, kTau);
      const auto scale = static_cast<float>(rng.Uniform(0.7, 1.3));
      scene_.Put(area.id + "/shrub " + std::to_string(++number), "shrub", scene_.On(p, -0.03), turn, scale, rng.Index(4));
    }
}

void Dresser::Playground(const OsmArea& area) {
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
void Dresser::Parked(const OsmArea& area) {
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

// On flat ground also mown grass, as on the lawns of the procedural towns.
void Dresser::Mow(EntityId lawn, const Patch& patch) {
  RngStream rng(scene_.options.seed, "mown grass", lawn);
  const Bounds2d box = BoundsOf(patch.outer);
  const GroundRect near{static_cast<float>(std::max(box.min.x, scene_.focus.x - kLawnReach)),
                        static_cast<float>(std::max(box.min.y, scene_.focus.y - kLawnReach)),
                        static_cast<float>(std::min(box.max.x, scene_.focus.x + kLawnReach)),
                        static_cast<float>(std::min(box.max.y, scene_.focus.y + kLawnReach))};
  LayMownGrass(scene_.shelf, lawn, near, 0, rng, [&](Vec2f at) {
    const Vec2d p{at.x, at.y};
    if (!Inside(patch, p) || InBuilding(p, 0.3)) return -1.0f;
    double edge = DistanceToRing(patch.outer, p);
    for (const Ring& hole : patch.holes) edge = std::min(edge, DistanceToRing(hole, p));
    return static_cast<float>(edge);
  });
}

// Blades of grass on the lawns around the first viewpoint.
void Dresser::Grass(const std::vector<std::pair<EntityId, Patches>>& lawns) {
  if (scene_.relief.flat())
    for (const auto& lawn : lawns)
      for (const Patch& patch : lawn.second) Mow(lawn.first, patch);
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

void Dresser::Undergrowth(const std::vector<std::pair<EntityId, Patches>>& woods) {
  RngStream rng(scene_.options.seed, "undergrowth");
  for (const auto& [floor, patches] : woods) {
    const EntityId plants = scene_.builder.AddEntity("undergrowth", scene_.builder.tree().At("vegetation/plant"));
    for (int i = 0; i < 5000; ++i) {
      const double a = rng.Uniform(0, kTau), r = 60 * std::sqrt(rng.Uniform()), pick = rng.Uniform();
      const Vec2d p = scene_.focus + Vec2d{std::cos(a), std::sin(a)} * r;
      const auto yaw = static_cast<float>(rng.Uniform(0, kTau)), scale = static_cast<float>(rng.Uniform(0.6, 1.3));
      const uint32_t variant = rng.Index(12);
      const bool inside = std::ranges::any_of(patches, [&](const Patch& patch) { return Inside(patch, p); });
      if (!inside || OnRoad(p, 1) || InBuilding(p) || paths_.Find(p, 1.2).owner != UINT32_MAX) continue;
      const AffineTransform X = PlaceUpright(scene_.On(p, -0.01), yaw, scale);
      if (pick > 0.96) {
        scene_.Put("shrub", "shrub", scene_.On(p, -0.03), static_cast<double>(yaw), scale, variant);
      } else if (pick > 0.65) {
        scene_.shelf.PlaceAs(plants, pick > 0.9 ? "plant" : "fern", X, variant);
      } else {
        scene_.shelf.PlaceAs(floor, pick > 0.45 ? "leaf_litter" : "grass_tuft", X, variant);
      }
    }
  }
}

}  // namespace airsim360::internal

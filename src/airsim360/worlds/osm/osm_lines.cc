// Walls, fences, hedges and rails of a map.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/osm/osm_dresser.h"

namespace airsim360::internal {

void Dresser::Ways() {
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

void Dresser::Barrier(const OsmWay& way) {
  const std::string_view kind = way.tags.Get("barrier");
  const std::string id = OsmId("way", way.id);
  SemanticTree& tree = scene_.builder.tree();
  if (kind == "wall" || kind == "retaining_wall" || kind == "city_wall") {
    const double height = ParseOsmLength(way.tags.Get("height"), 30).value_or(kind == "city_wall" ? 6 : 1.2),
                 half = kind == "city_wall" ? 0.9 : 0.17;
    mesh_.SetEntity(scene_.builder.AddEntity(id, tree.At("barrier/wall")));
    mesh_.SetMaterial(
        scene_.surfaces[way.tags.Is("wall", "brick") || way.tags.Is("material", "brick") ? Surface::kBrickRed : Surface::kLimestone]);
    for (const Patch& patch : Band(way.line, half, half)) {
      const auto side = [&](const Ring& ring) {
        for (size_t i = 0; i < ring.size(); ++i) {
          const std::vector<Vec2d> steps = scene_.relief.Split(ring[i], ring[(i + 1) % ring.size()]);
          for (size_t k = 0; k + 1 < steps.size(); ++k)
            mesh_.Quad(scene_.On(steps[k], -0.3), scene_.On(steps[k + 1], -0.3), scene_.On(steps[k + 1], height),
                       scene_.On(steps[k], height));
        }
      };
      side(patch.outer);
      for (const Ring& hole : patch.holes) side(hole);
      std::vector<Vec2d> points = patch.outer;
      for (const Ring& hole : patch.holes) points.insert(points.end(), hole.begin(), hole.end());
      const std::vector<uint32_t> t = Triangulate(patch);
      for (size_t i = 0; i + 2 < t.size(); i += 3) scene_.Drape(mesh_, points[t[i]], points[t[i + 1]], points[t[i + 2]], height, ToFloat);
    }
    return;
  }
  const bool hedge = kind == "hedge",
             fence = kind == "fence" || kind == "handrail" || kind == "guard_rail" || kind == "chain" || kind == "railing";
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

void Dresser::Rails(const OsmWay& way) {
  if (Underground(way.tags)) return;
  mesh_.SetEntity(scene_.builder.AddEntity(OsmId("way", way.id) + "/rails", scene_.builder.tree().At("ground/rail")));
  mesh_.SetMaterial(scene_.surfaces[Surface::kMetal]);
  const double z = way.tags.Is("railway", "tram") ? -0.12 : 0.14;
  for (double d : {-0.75, 0.75})
    for (const Patch& patch : Band(way.line, d + 0.035, -d + 0.035)) {
      const std::vector<uint32_t> t = Triangulate(patch);
      for (size_t i = 0; i + 2 < t.size() && patch.holes.empty(); i += 3)
        scene_.Drape(mesh_, patch.outer[t[i]], patch.outer[t[i + 1]], patch.outer[t[i + 2]], z, ToFloat);
    }
}

}  // namespace airsim360::internal

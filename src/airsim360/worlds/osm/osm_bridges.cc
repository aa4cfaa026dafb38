// Bridges: a deck over what it crosses, with parapets and piers.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "airsim360/worlds/osm/osm_streets.h"

namespace airsim360::internal {
namespace {

constexpr double kClear = 5.2, kDeck = 0.7, kParapet = 1.0;

bool Crosses(const std::vector<Vec2d>& a, const std::vector<Vec2d>& b) {
  const auto turn = [](Vec2d p, Vec2d q, Vec2d r) { return (q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y); };
  for (size_t i = 0; i + 1 < a.size(); ++i)
    for (size_t k = 0; k + 1 < b.size(); ++k) {
      const bool one = (turn(a[i], a[i + 1], b[k]) > 0) != (turn(a[i], a[i + 1], b[k + 1]) > 0);
      const bool two = (turn(b[k], b[k + 1], a[i]) > 0) != (turn(b[k], b[k + 1], a[i + 1]) > 0);
      if (one && two) return true;
    }
  return false;
}

double WidthOf(const OsmTags& tags) {
  const int rank = RoadRank(tags.Get("highway"));
  if (rank >= 0) {
    const bool oneway = tags.Is("oneway", "yes");
    return 2 * HalfWidthOf(tags, rank, LanesOf(tags, rank, oneway), oneway) + 1;
  }
  return ParseOsmLength(tags.Get("width"), 60).value_or(tags.Has("railway") ? 4.5 : 3);
}

}  // namespace

void BuildBridges(OsmScene& scene, MeshBuilder& mesh) {
  SemanticTree& tree = scene.builder.tree();
  std::vector<const OsmWay*> bridges, others;
  std::map<int64_t, int> ends;
  for (const OsmWay& way : scene.data.ways) {
    if (way.line.size() < 2 || Underground(way.tags)) continue;
    const bool traffic = way.tags.Has("highway") || way.tags.Has("railway");
    if (!traffic || way.tags.Is("area", "yes")) continue;
    bool near = false;
    for (Vec2d p : way.line) near = near || scene.data.extent.Contains(p, 30);
    if (!near) continue;
    if (!OnBridge(way.tags)) {
      others.push_back(&way);
      continue;
    }
    bridges.push_back(&way);
    ++ends[way.nodes.front()];
    ++ends[way.nodes.back()];
  }
  for (const OsmWay* way : bridges) {
    const double length = LengthOf(way->line), half = WidthOf(way->tags) / 2;
    if (length < 1 || length > 20000) continue;
    // Over roads it needs room below, over water a hand's breadth.
    Bounds2d box = BoundsOf(way->line);
    double rise = 0.25;
    for (const OsmWay* other : others)
      if (BoundsOf(other->line).Overlaps(box) && Crosses(way->line, other->line)) rise = kClear;
    rise *= std::clamp(ParseOsmNumber(way->tags.Get("layer"), 1, 5).value_or(1), 1.0, 5.0);
    const bool start = ends[way->nodes.front()] < 2, end = ends[way->nodes.back()] < 2;
    const auto height = [&](double s) {
      double t = 1;
      const double ramp = std::min(length * 0.45, rise * 14);
      if (start) t = std::min(t, s / ramp);
      if (end) t = std::min(t, (length - s) / ramp);
      t = std::clamp(t, 0.0, 1.0);
      return rise * t * t * (3 - 2 * t) + 0.03;
    };
    const EntityId deck = scene.builder.AddEntity(OsmId("way", way->id) + (way->tags.Has("name") ? " " + std::string(way->tags.Get("name")) : ""),
                                                  tree.At(way->tags.Has("railway") ? "ground/gravel" : "ground/road"));
    const EntityId structure = scene.builder.AddEntity(OsmId("way", way->id) + "/bridge", tree.At("construction/bridge"));
    const bool road = RoadRank(way->tags.Get("highway")) >= 0;
    const int steps = std::clamp(static_cast<int>(length / 4), 2, 4000);
    const auto section = [&](int i, double d, double lift) {
      const double s = length * i / steps;
      const LinePoint at = PointAt(way->line, s);
      const Vec2d p = at.p + Vec2d{-at.along.y, at.along.x} * d;
      const Vec3f on = scene.On(at.p, height(s) + lift);
      return Vec3f{static_cast<float>(p.x), static_cast<float>(p.y), on.z};
    };
    double pier = 0;
    for (int i = 0; i < steps; ++i) {
      const double s0 = length * i / steps, s1 = length * (i + 1) / steps;
      if (!scene.data.extent.Contains(PointAt(way->line, s0).p, 40)) continue;
      const auto v0 = static_cast<float>(s0), v1 = static_cast<float>(s1), h = static_cast<float>(half);
      mesh.SetEntity(deck);
      mesh.SetMaterial(scene.surfaces[road ? Surface::kCarriageway : way->tags.Has("railway") ? Surface::kPath : Surface::kSlabs]);
      mesh.QuadUv(section(i, -half, 0), section(i + 1, -half, 0), section(i + 1, half, 0), section(i, half, 0), {-h, v0}, {-h, v1}, {h, v1}, {h, v0});
      mesh.SetEntity(structure);
      mesh.SetMaterial(scene.surfaces[Surface::kConcrete]);
      // Underside, then both parapets: outer face, inner face, top.
      mesh.QuadUv(section(i, half, -kDeck), section(i + 1, half, -kDeck), section(i + 1, -half, -kDeck), section(i, -half, -kDeck), {h, v0}, {h, v1}, {-h, v1}, {-h, v0});
      for (const double side : {-1.0, 1.0}) {
        const double o = side * (half + 0.25), n = side * half;
        const auto face = [&](double d, double low, double high, bool right) {
          if (right)
            mesh.QuadUv(section(i, d, low), section(i + 1, d, low), section(i + 1, d, high), section(i, d, high), {v0, 2}, {v1, 2}, {v1, 0}, {v0, 0});
          else
            mesh.QuadUv(section(i + 1, d, low), section(i, d, low), section(i, d, high), section(i + 1, d, high), {v1, 2}, {v0, 2}, {v0, 0}, {v1, 0});
        };
        face(o, -kDeck, kParapet, side < 0);
        face(n, 0, kParapet, side > 0);
        const double low = std::min(o, n), high = std::max(o, n);
        mesh.QuadUv(section(i, low, kParapet), section(i + 1, low, kParapet), section(i + 1, high, kParapet), section(i, high, kParapet), {0, v0}, {0, v1}, {0.25f, v1}, {0.25f, v0});
      }
      pier += s1 - s0;
      const double z = height(s0);
      if (pier > 22 && z > 3 && i + 1 < steps) {
        pier = 0;
        const Vec3f top = section(i, 0, -kDeck);
        const float ground = scene.On(PointAt(way->line, s0).p, -0.3).z;
        for (double d : {-half * 0.6, half * 0.6}) {
          const Vec3f p = section(i, d, -kDeck);
          mesh.Tube({p.x, p.y, ground}, {p.x, p.y, top.z}, 0.5f, 0.5f, 12, false, false);
        }
      }
      // Closed sides where the ramp lies on the ground.
      if (z < 2.2 && z > 0.1) {
        for (const double side : {-1.0, 1.0}) {
          const double o = side * (half + 0.25), low = -z - 0.3;
          const Vec3f a = section(side < 0 ? i : i + 1, o, low), b = section(side < 0 ? i + 1 : i, o, low);
          const Vec3f c = section(side < 0 ? i + 1 : i, o, -kDeck), d = section(side < 0 ? i : i + 1, o, -kDeck);
          if (c.z > b.z || d.z > a.z) mesh.QuadUv(a, b, c, d, {v0, 2}, {v1, 2}, {v1, 0}, {v0, 0});
        }
      }
    }
  }
}

}  // namespace airsim360::internal

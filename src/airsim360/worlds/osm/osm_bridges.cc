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

/// The ways that cross on bridges near the extent, the other ways, and how many bridges end at a node.
struct Crossings {
  std::vector<const OsmWay*> bridges, others;
  std::map<int64_t, int> ends;
};

Crossings FindCrossings(const OsmScene& scene) {
  Crossings found;
  for (const OsmWay& way : scene.data.ways) {
    if (way.line.size() < 2 || Underground(way.tags)) continue;
    const bool traffic = way.tags.Has("highway") || way.tags.Has("railway");
    if (!traffic || way.tags.Is("area", "yes")) continue;
    bool near = false;
    for (Vec2d p : way.line) near = near || scene.data.extent.Contains(p, 30);
    if (!near) continue;
    if (!OnBridge(way.tags)) {
      found.others.push_back(&way);
      continue;
    }
    found.bridges.push_back(&way);
    ++found.ends[way.nodes.front()];
    ++found.ends[way.nodes.back()];
  }
  return found;
}

/// One bridge, cut into steps of about 4 m.
class BridgeBuilder {
 public:
  BridgeBuilder(OsmScene& scene, MeshBuilder& mesh, const OsmWay& way, const Crossings& crossings)
      : scene_(scene),
        mesh_(mesh),
        way_(way),
        length_(LengthOf(way.line)),
        half_(WidthOf(way.tags) / 2),
        steps_(std::clamp(static_cast<int>(length_ / 4), 2, 4000)),
        start_(crossings.ends.at(way.nodes.front()) < 2),
        end_(crossings.ends.at(way.nodes.back()) < 2),
        rise_(RiseOver(crossings.others)) {}

  void Build() {
    if (length_ < 1 || length_ > 20000) return;
    SemanticTree& tree = scene_.builder.tree();
    const bool rail = way_.tags.Has("railway");
    const std::string name = way_.tags.Has("name") ? " " + std::string(way_.tags.Get("name")) : "";
    deck_ = scene_.builder.AddEntity(OsmId("way", way_.id) + name, tree.At(rail ? "ground/gravel" : "ground/road"));
    structure_ = scene_.builder.AddEntity(OsmId("way", way_.id) + "/bridge", tree.At("construction/bridge"));
    const bool road = RoadRank(way_.tags.Get("highway")) >= 0;
    top_ = road ? Surface::kCarriageway : rail ? Surface::kPath : Surface::kSlabs;
    double pier = 0;
    for (int i = 0; i < steps_; ++i) {
      const double s0 = length_ * i / steps_, s1 = length_ * (i + 1) / steps_;
      if (!scene_.data.extent.Contains(PointAt(way_.line, s0).p, 40)) continue;
      AddDeck(i, static_cast<float>(s0), static_cast<float>(s1));
      for (const double side : {-1.0, 1.0}) AddParapet(i, side, static_cast<float>(s0), static_cast<float>(s1));
      pier += s1 - s0;
      const double z = Height(s0);
      if (pier > 22 && z > 3 && i + 1 < steps_) {
        pier = 0;
        AddPiers(i, s0);
      }
      if (z < 2.2 && z > 0.1) CloseSides(i, z, static_cast<float>(s0), static_cast<float>(s1));
    }
  }

 private:
  // Over roads it needs room below, over water a hand's breadth.
  double RiseOver(const std::vector<const OsmWay*>& others) const {
    const Bounds2d box = BoundsOf(way_.line);
    double rise = 0.25;
    for (const OsmWay* other : others)
      if (BoundsOf(other->line).Overlaps(box) && Crosses(way_.line, other->line)) rise = kClear;
    return rise * std::clamp(ParseOsmNumber(way_.tags.Get("layer"), 1, 5).value_or(1), 1.0, 5.0);
  }

  // Ramps at ends where no other bridge goes on.
  double Height(double s) const {
    double t = 1;
    const double ramp = std::min(length_ * 0.45, rise_ * 14);
    if (start_) t = std::min(t, s / ramp);
    if (end_) t = std::min(t, (length_ - s) / ramp);
    t = std::clamp(t, 0.0, 1.0);
    return rise_ * t * t * (3 - 2 * t) + 0.03;
  }

  // The point of cross section i, d metres to the left of the middle, lifted over the deck.
  Vec3f Section(int i, double d, double lift) const {
    const double s = length_ * i / steps_;
    const LinePoint at = PointAt(way_.line, s);
    const Vec2d p = at.p + Vec2d{-at.along.y, at.along.x} * d;
    const Vec3f on = scene_.On(at.p, Height(s) + lift);
    return Vec3f{static_cast<float>(p.x), static_cast<float>(p.y), on.z};
  }

  void AddDeck(int i, float v0, float v1) {
    const auto h = static_cast<float>(half_);
    mesh_.SetEntity(deck_);
    mesh_.SetMaterial(scene_.surfaces[top_]);
    mesh_.QuadUv(Section(i, -half_, 0), Section(i + 1, -half_, 0), Section(i + 1, half_, 0), Section(i, half_, 0), {-h, v0}, {-h, v1},
                 {h, v1}, {h, v0});
    mesh_.SetEntity(structure_);
    mesh_.SetMaterial(scene_.surfaces[Surface::kConcrete]);
    mesh_.QuadUv(Section(i, half_, -kDeck), Section(i + 1, half_, -kDeck), Section(i + 1, -half_, -kDeck), Section(i, -half_, -kDeck),
                 {h, v0}, {h, v1}, {-h, v1}, {-h, v0});
  }

  // Outer face, inner face, top.
  void AddParapet(int i, double side, float v0, float v1) {
    const double o = side * (half_ + 0.25), n = side * half_;
    const auto face = [&](double d, double low, double high, bool right) {
      if (right)
        mesh_.QuadUv(Section(i, d, low), Section(i + 1, d, low), Section(i + 1, d, high), Section(i, d, high), {v0, 2}, {v1, 2}, {v1, 0},
                     {v0, 0});
      else
        mesh_.QuadUv(Section(i + 1, d, low), Section(i, d, low), Section(i, d, high), Section(i + 1, d, high), {v1, 2}, {v0, 2}, {v0, 0},
                     {v1, 0});
    };
    face(o, -kDeck, kParapet, side < 0);
    face(n, 0, kParapet, side > 0);
    const double low = std::min(o, n), high = std::max(o, n);
    mesh_.QuadUv(Section(i, low, kParapet), Section(i + 1, low, kParapet), Section(i + 1, high, kParapet), Section(i, high, kParapet),
                 {0, v0}, {0, v1}, {0.25f, v1}, {0.25f, v0});
  }

  void AddPiers(int i, double s) {
    const Vec3f top = Section(i, 0, -kDeck);
    const float ground = scene_.On(PointAt(way_.line, s).p, -0.3).z;
    for (double d : {-half_ * 0.6, half_ * 0.6}) {
      const Vec3f p = Section(i, d, -kDeck);
      mesh_.Tube({p.x, p.y, ground}, {p.x, p.y, top.z}, 0.5f, 0.5f, 12, false, false);
    }
  }

  // Where the ramp lies on the ground.
  void CloseSides(int i, double z, float v0, float v1) {
    for (const double side : {-1.0, 1.0}) {
      const double o = side * (half_ + 0.25), low = -z - 0.3;
      const Vec3f a = Section(side < 0 ? i : i + 1, o, low), b = Section(side < 0 ? i + 1 : i, o, low);
      const Vec3f c = Section(side < 0 ? i + 1 : i, o, -kDeck), d = Section(side < 0 ? i : i + 1, o, -kDeck);
      if (c.z > b.z || d.z > a.z) mesh_.QuadUv(a, b, c, d, {v0, 2}, {v1, 2}, {v1, 0}, {v0, 0});
    }
  }

  OsmScene& scene_;
  MeshBuilder& mesh_;
  const OsmWay& way_;
  const double length_, half_;
  const int steps_;
  const bool start_, end_;  // a ramp there
  const double rise_;
  EntityId deck_{}, structure_{};
  Surface top_{};
};

}  // namespace

void BuildBridges(OsmScene& scene, MeshBuilder& mesh) {
  const Crossings crossings = FindCrossings(scene);
  for (const OsmWay* way : crossings.bridges) BridgeBuilder(scene, mesh, *way, crossings).Build();
}

}  // namespace airsim360::internal

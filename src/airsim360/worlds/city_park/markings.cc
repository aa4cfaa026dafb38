// Markings are thin geometry over the asphalt, so that their edges and labels are exact.
#include <cmath>

#include "airsim360/worlds/city_park/road_parts.h"
#include "airsim360/worlds/kit/mesh_builder.h"

namespace airsim360::internal::park {
namespace {

constexpr float kLift = 0.0025f;  // of paint over asphalt

class Painter {
 public:
  Painter(Park& park, const Curve& road, float half) : park_(park), road_(road), half_(half) {
    mesh_.SetMaterial(park.surfaces[Surface::kPaintWhite]);
  }

  // Where a line is interrupted, for instance at junctions.
  struct Gap {
    float s0, s1;
  };

  // A line of width w at distance d over [s0, s1] in pieces of a metre, but not in gaps; an entity a stretch.
  void Line(float d, float w, float s0, float s1, const std::vector<Gap>& gaps) {
    int stretch = -1;
    for (float s = std::ceil(s0); s + 1 <= s1; ++s) {
      if (InGap(s, gaps)) continue;
      if (static_cast<int>(s / kStretch) != stretch) {
        stretch = static_cast<int>(s / kStretch);
        Begin("line", "ground/lane_marking");
      }
      Quad(s, s + 1, d - w / 2, d + w / 2);
    }
  }
  // Dashes of 3 m every 9 m.
  void Dashes(float d, float w, float s0, float s1, const std::vector<Gap>& gaps) {
    int stretch = -1;
    for (float s = std::ceil(s0 / 9) * 9; s + 3 <= s1; s += 9) {
      if (InGap(s, gaps) || InGap(s + 3, gaps)) continue;
      if (static_cast<int>(s / kStretch) != stretch) {
        stretch = static_cast<int>(s / kStretch);
        Begin("dashes", "ground/lane_marking");
      }
      for (int k = 0; k < 3; ++k) Quad(s + static_cast<float>(k), s + static_cast<float>(k) + 1, d - w / 2, d + w / 2);
    }
  }
  // Slanting bars between -d and d, split on the crown.
  void Hatching(float d, float s0, float s1, const std::vector<Gap>& gaps) {
    int stretch = -1;
    for (float s = s0; s + 2 <= s1; s += 1.7f) {
      if (InGap(s, gaps)) continue;
      if (static_cast<int>(s / kStretch) != stretch) {
        stretch = static_cast<int>(s / kStretch);
        Begin("hatching", "ground/lane_marking");
      }
      constexpr float kWidth = 0.24f, kSlant = 0.7f;
      for (float e : {-d, 0.0f}) {
        const auto at = [&](float along, float across) { return At(s - kSlant * across + along, across); };
        const float f = e + d;
        mesh_.QuadUv(at(0, e), at(kWidth, e), at(kWidth, f), at(0, f), {s, e}, {s + kWidth, e}, {s + kWidth, f}, {s, f});
      }
    }
  }
  // A rectangle in road coordinates, split on the crown.
  void Bar(float s0, float s1, float d0, float d1) {
    if (d0 < 0 && d1 > 0) {
      Quad(s0, s1, d0, 0);
      Quad(s0, s1, 0, d1);
    } else {
      Quad(s0, s1, d0, d1);
    }
  }
  void Begin(const char* name, const char* category) { mesh_.SetEntity(park_.AddEntity(name, category)); }
  // Cast iron grate against the kerb.
  void Drain(float s, float hand) {
    Begin("drain", "ground/manhole");
    mesh_.SetMaterial(park_.surfaces[Surface::kIron]);
    const float d = hand * (half_ - 0.24f);
    for (int k = 0; k < 9; ++k) {
      const float q = s + 0.055f * static_cast<float>(k);
      Quad(q, q + 0.035f, d - 0.17f, d + 0.17f);
    }
    for (float e : {-0.185f, 0.170f}) Quad(s - 0.03f, s + 0.505f, d + e, d + e + 0.015f);
    mesh_.SetMaterial(park_.surfaces[Surface::kPaintWhite]);
  }
  void Finish(const char* name) { park_.builder.AddInstance({park_.builder.AddMesh(mesh_.Finish(name)), {}, kNoEntity}); }
  Vec3f At(float s, float d) const {
    const Vec2f p = road_.At(s, d);
    return {p.x, p.y, park_.layout.Base(p) + CarriagewayZ(d, half_) + kLift};
  }

 private:
  static bool InGap(float s, const std::vector<Gap>& gaps) {
    for (const Gap& gap : gaps)
      if (s > gap.s0 && s < gap.s1) return true;
    return false;
  }
  void Quad(float s0, float s1, float d0, float d1) {
    mesh_.QuadUv(At(s0, d0), At(s1, d0), At(s1, d1), At(s0, d1), {s0, d0}, {s1, d0}, {s1, d1}, {s0, d1});
  }

  Park& park_;
  const Curve& road_;
  float half_;
  MeshBuilder mesh_;
};

void MarkMain(Park& park) {
  const Curve& road = park.layout.main();
  Painter paint(park, road, kMainHalf);
  std::vector<Painter::Gap> left, right, middle;
  for (const Junction& junction : park.layout.junctions()) {
    (junction.left ? left : right).push_back({junction.s - 13, junction.s + 12});
    middle.push_back({junction.s - 10, junction.s + 9});
  }
  const float end = road.length();
  paint.Line(6.45f, 0.15f, 0, end, left);
  paint.Line(-6.45f, 0.15f, 0, end, right);
  paint.Line(0.75f, 0.15f, 0, end, middle);
  paint.Line(-0.75f, 0.15f, 0, end, middle);
  paint.Hatching(0.70f, 0, end, middle);
  paint.Dashes(3.6f, 0.13f, 0, end, {});
  paint.Dashes(-3.6f, 0.13f, 0, end, {});
  for (float s = 17; s < end; s += 27) {
    paint.Drain(s, 1);
    paint.Drain(s + 9, -1);
  }
  paint.Finish("markings main");
}

void MarkSide(Park& park, const Curve& road, size_t index) {
  Painter paint(park, road, kSideHalf);
  // Zebra crossing behind the mouth, a stop line before it, then a broken middle line and edges.
  paint.Begin("crosswalk", "ground/crosswalk");
  for (float d = -4.0f; d < 3.7f; d += 0.9f) paint.Bar(18.5f, 21.5f, d, d + 0.45f);
  paint.Begin("stop line", "ground/lane_marking");
  paint.Bar(22.6f, 23.0f, 0.15f, 4.2f);
  const float end = road.length();
  paint.Dashes(0, 0.12f, 26, end, {});
  paint.Line(4.2f, 0.12f, 17, end, {});
  paint.Line(-4.2f, 0.12f, 17, end, {});
  for (float s = 30; s < end; s += 31) paint.Drain(s, static_cast<int>(s) % 2 ? 1.0f : -1.0f);
  paint.Finish(index == 0 ? "markings east" : index == 1 ? "markings west" : "markings north");
}

}  // namespace

void MarkRoads(Park& park) {
  MarkMain(park);
  for (size_t i = 0; i < park.layout.side_roads().size(); ++i) MarkSide(park, park.layout.side_roads()[i], i);
  // Manholes in the lanes.
  RngStream rng(park.seed, "park manholes");
  const auto manhole = [&](const Curve& road, float half, float s, float d) {
    const Vec2f p = road.At(s, d), across = road.At(s, d + 0.4f), along = road.At(s + 0.4f, d);
    const auto z = [&](Vec2f q, float e) { return Vec3f{q.x, q.y, park.layout.Base(q) + CarriagewayZ(e, half)}; };
    const Vec3f a = z(p, d), up = Normalized(Cross(z(along, d) - a, z(across, d + 0.4f) - a));
    const EntityId entity = park.AddEntity("manhole", "ground/manhole");
    park.placer.shelf().PlaceAs(entity, "manhole", PlaceTilted(a, up, static_cast<float>(rng.Uniform(0, 6.28)), 1), rng.Index(2));
  };
  const Curve& main = park.layout.main();
  for (int i = 0; static_cast<float>(i) * 43 + 30 < main.length(); ++i)
    manhole(main, kMainHalf, static_cast<float>(i) * 43 + 21, i % 2 ? 2.3f : -4.6f);
  for (const Curve& side : park.layout.side_roads()) {
    for (float s = 40; s + 10 < side.length(); s += 47) manhole(side, kSideHalf, s, s > 100 ? 1.4f : -1.7f);
  }
}

}  // namespace airsim360::internal::park

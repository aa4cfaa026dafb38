// Roads: crowned carriageways, and beside them strips extruded along the kerb lines, which turn round the
// corners of junctions in one piece.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/city_park/park.h"
#include "airsim360/worlds/city_park/road_parts.h"
#include "airsim360/worlds/kit/mesh_builder.h"

namespace airsim360::internal::park {
namespace {

constexpr float kTurn = 6.0f;     // tangent length of the kerb's arc at junctions
constexpr float kRowStep = 1.0f;  // metres between cross-sections

// One run of surface across the verge: offsets outwards from the kerb's face, heights over the road's edge.
struct VergeStrip {
  float o0, z0, o1, z1;
  enum { kStone, kBed, kSlab } kind;
};
constexpr VergeStrip kVerge[] = {
    {0.00f, 0.00f, 0.02f, 0.14f, VergeStrip::kStone},
    {0.02f, 0.14f, kKerbTop, 0.15f, VergeStrip::kStone},
    {kKerbTop, 0.15f, kKerbTop, 0.09f, VergeStrip::kStone},
    {kKerbTop, 0.11f, 0.95f, 0.135f, VergeStrip::kBed},
    {0.95f, 0.135f, kBedEnd, 0.12f, VergeStrip::kBed},
    {kBedEnd, 0.09f, kBedEnd, 0.17f, VergeStrip::kStone},
    {kBedEnd, 0.17f, kEdgingEnd, 0.17f, VergeStrip::kStone},
    {kEdgingEnd, 0.165f, kPavementEnd, 0.17f, VergeStrip::kSlab},
    {kPavementEnd, 0.17f, kVergeEnd, 0.17f, VergeStrip::kStone},
    {kVergeEnd, 0.17f, kVergeEnd + 0.02f, -0.4f, VergeStrip::kStone},
};

// Where the offset lines of main (distance `d_main` to its left) and side road (`d_side`) cross.
Vec2f Corner(const Curve& main, float d_main, const Curve& side, float d_side) {
  Vec2f p = side.At(std::abs(d_main), d_side);
  for (int i = 0; i < 12; ++i) {
    p = main.At(main.Find(p).s, d_main);
    p = side.At(side.Find(p).s, d_side);
  }
  return p;
}

void AppendArc(std::vector<Vec2f>& line, Vec2f a, Vec2f corner, Vec2f b) {
  // A cubic with the handles of a quarter circle.
  constexpr float kHandle = 0.5523f;
  const Vec2f h0 = a + (corner - a) * kHandle, h1 = b + (corner - b) * kHandle;
  for (int i = 1; i < 12; ++i) {
    const float t = static_cast<float>(i) / 12, u = 1 - t;
    line.push_back(a * (u * u * u) + h0 * (3 * u * u * t) + h1 * (3 * u * t * t) + b * (t * t * t));
  }
}

void AppendRun(std::vector<Vec2f>& line, const Curve& curve, float s0, float s1, float d) {
  const int n = std::max(1, static_cast<int>(std::abs(s1 - s0) / kRowStep));
  for (int i = 0; i <= n; ++i) line.push_back(curve.At(s0 + (s1 - s0) * static_cast<float>(i) / static_cast<float>(n), d));
}

}  // namespace

float CarriagewayZ(float d, float half) {
  // Two slopes a side: 1 % by the middle, 1.7 % towards the gutter.
  const float x = std::abs(d) / half;
  return x < 0.5f ? 0.0129f * half - 0.0086f * half * x : 0.0172f * half * (1 - x);
}

std::vector<KerbLine> KerbLines(const Layout& layout) {
  std::vector<KerbLine> lines;
  const Curve& main = layout.main();
  for (bool left : {true, false}) {
    const float hand = left ? 1.0f : -1.0f, end = left ? main.length() : 0.0f;
    // Junctions of this hand in the order they are met; the right-hand kerb is walked backwards.
    std::vector<size_t> met;
    for (size_t i = 0; i < layout.junctions().size(); ++i)
      if (layout.junctions()[i].left == left) met.push_back(i);
    std::sort(met.begin(), met.end(), [&](size_t a, size_t b) { return hand * layout.junctions()[a].s < hand * layout.junctions()[b].s; });
    std::vector<Vec2f> line;
    float at = left ? 0.0f : main.length();
    for (size_t i : met) {
      // Out along the side road's near kerb …
      const Curve& side = layout.side_roads()[i];
      const Vec2f near = Corner(main, hand * kMainHalf, side, kSideHalf);
      const float s_main = main.Find(near).s - hand * kTurn, s_side = side.Find(near).s + kTurn;
      AppendRun(line, main, at, s_main, hand * kMainHalf);
      const size_t arc0 = line.size() - 1;
      AppendArc(line, main.At(s_main, hand * kMainHalf), near, side.At(s_side, kSideHalf));
      AppendRun(line, side, s_side, side.length(), kSideHalf);
      lines.push_back(
          {Curve(line), near, {line.begin() + static_cast<std::ptrdiff_t>(arc0), line.begin() + static_cast<std::ptrdiff_t>(arc0) + 13}});
      // … and back along the far one.
      line.clear();
      const Vec2f far = Corner(main, hand * kMainHalf, side, -kSideHalf);
      const float t_side = side.Find(far).s + kTurn, t_main = main.Find(far).s + hand * kTurn;
      AppendRun(line, side, side.length(), t_side, -kSideHalf);
      const size_t arc1 = line.size() - 1;
      AppendArc(line, side.At(t_side, -kSideHalf), far, main.At(t_main, hand * kMainHalf));
      line.push_back(main.At(t_main, hand * kMainHalf));
      lines.push_back(
          {Curve(std::vector<Vec2f>(line.begin(), line.end())), far, {line.begin() + static_cast<std::ptrdiff_t>(arc1), line.end()}});
      // The main road's kerb goes on from here, in a line of its own.
      line = {main.At(t_main, hand * kMainHalf)};
      at = t_main + hand * kRowStep;
    }
    AppendRun(line, main, at, end, hand * kMainHalf);
    lines.push_back({Curve(line), {}, {}});
  }
  return lines;
}

namespace {

class RoadMaker {
 public:
  explicit RoadMaker(Park& park) : park_(park) {}

  void Carriageway(const Curve& road, float half, MaterialId material, float s_begin, const char* name) {
    const std::vector<float> across = {-half, -half / 2, 0, half / 2, half};
    const auto rows = static_cast<int>((road.length() - s_begin) / kRowStep);
    mesh_.SetMaterial(material);
    for (int i = 0; i < rows; ++i) {
      const float s0 = s_begin + static_cast<float>(i) * kRowStep, s1 = s0 + kRowStep;
      if (i == 0 || std::floor(s0 / kStretch) != std::floor((s0 - kRowStep) / kStretch))
        mesh_.SetEntity(park_.AddEntity(name, "ground/road"));
      for (size_t k = 0; k + 1 < across.size(); ++k) {
        const auto corner = [&](float s, float d) {
          // Side roads begin on the edge of the main road, level with it.
          const float start = s_begin > 0 && i == 0 && s == s0 ? Mouth(road, d) : s;
          return std::pair<Vec3f, Vec2f>(RoadPoint(road, half, start, d, s_begin),
                                         Vec2f{start / kRoadPictureLength, 0.5f - 0.5f * d / half});
        };
        const auto [a, ta] = corner(s0, across[k]);
        const auto [b, tb] = corner(s1, across[k]);
        const auto [c, tc] = corner(s1, across[k + 1]);
        const auto [d, td] = corner(s0, across[k + 1]);
        mesh_.QuadUv(a, b, c, d, ta, tb, tc, td);
      }
    }
  }

  // The verge along one kerb line.
  void Verge(const KerbLine& kerb) {
    const std::vector<Vec2f>& p = kerb.line.points();
    EntityId entities[3] = {};
    float s = 0;
    int stretch = -1;
    for (size_t i = 0; i + 1 < p.size(); ++i) {
      const float step = std::hypot(p[i + 1].x - p[i].x, p[i + 1].y - p[i].y);
      if (static_cast<int>(s / kStretch) != stretch) {
        stretch = static_cast<int>(s / kStretch);
        entities[0] = park_.AddEntity("kerb", "ground/kerb");
        entities[1] = park_.AddEntity("mulch bed", "ground/dirt");
        entities[2] = park_.AddEntity("pavement", "ground/sidewalk");
      }
      for (const VergeStrip& strip : kVerge) {
        mesh_.SetEntity(entities[strip.kind]);
        mesh_.SetMaterial(strip.kind == VergeStrip::kStone ? park_.surfaces[Surface::kKerb]
                          : strip.kind == VergeStrip::kBed ? park_.materials.mulch
                                                           : park_.materials.pavement);
        Piece(p, i, s, s + step, strip);
      }
      s += step;
    }
  }

  // The corner between two carriageways and the kerb's arc.
  void CornerFill(const KerbLine& kerb) {
    if (kerb.arc.empty()) return;
    mesh_.SetMaterial(park_.materials.side_road);
    mesh_.SetEntity(park_.AddEntity("junction corner", "ground/road"));
    const auto lift = [&](Vec2f p) { return Vec3f{p.x, p.y, park_.layout.Base(p) - 0.004f}; };
    const auto uv = [](Vec2f p) { return Vec2f{p.x / kRoadPictureLength, 0.5f - 0.1f * std::sin(p.y)}; };
    for (size_t i = 0; i + 1 < kerb.arc.size(); ++i) {
      const Vec2f a = kerb.corner, b = kerb.arc[i + 1], c = kerb.arc[i];
      mesh_.Triangle(lift(a), lift(b), lift(c), uv(a), uv(b), uv(c));
    }
  }

  float Mouth(const Curve& side, float d) const {
    const Curve& main = park_.layout.main();
    float low = 2, high = 16;
    for (int i = 0; i < 24; ++i) {
      const float middle = (low + high) / 2;
      (main.Distance(side.At(middle, d)) < kMainHalf ? low : high) = middle;
    }
    return high;
  }

  // Side roads rise from the main road's edge to their own crown over a few metres.
  Vec3f RoadPoint(const Curve& road, float half, float s, float d, float s_begin) const {
    const Vec2f p = road.At(s, d);
    const float crown = s_begin > 0 ? std::clamp((s - 7) / 10, 0.0f, 1.0f) : 1.0f;
    return {p.x, p.y, park_.layout.Base(p) + crown * CarriagewayZ(d, half)};
  }

  MeshBuilder& mesh() { return mesh_; }
  void Finish() { park_.builder.AddInstance({park_.builder.AddMesh(mesh_.Finish("roads")), {}, kNoEntity}); }

 private:
  void Piece(const std::vector<Vec2f>& p, size_t i, float s0, float s1, const VergeStrip& strip) {
    const auto outwards = [&](size_t k) {
      const Vec2f v = p[std::min(k + 1, p.size() - 1)] - p[k > 0 ? k - 1 : 0];
      return Vec2f{-v.y, v.x} * (1 / std::hypot(v.x, v.y));
    };
    const auto at = [&](size_t k, float o, float z) {
      const Vec2f q = p[k] + outwards(k) * o;
      return Vec3f{q.x, q.y, park_.layout.Base(q) + z};
    };
    // Slabs lie in two rows of 0.95 m; elsewhere v is metres around the profile.
    const float v_scale = strip.kind == VergeStrip::kSlab ? 6 / 5.7f : 1.0f;
    const float v0 = strip.kind == VergeStrip::kSlab ? 0.0f : strip.o0 - strip.z0;
    const float v1 = v0 + v_scale * std::hypot(strip.o1 - strip.o0, strip.z1 - strip.z0);
    mesh_.QuadUv(at(i, strip.o0, strip.z0), at(i + 1, strip.o0, strip.z0), at(i + 1, strip.o1, strip.z1), at(i, strip.o1, strip.z1),
                 {s0, v0}, {s1, v0}, {s1, v1}, {s0, v1});
  }

  Park& park_;
  MeshBuilder mesh_;
};

}  // namespace

void LayRoads(Park& park) {
  RoadMaker maker(park);
  maker.Carriageway(park.layout.main(), kMainHalf, park.materials.main_road, 0, "road");
  for (const Curve& side : park.layout.side_roads()) maker.Carriageway(side, kSideHalf, park.materials.side_road, 12, "side road");
  for (const KerbLine& kerb : KerbLines(park.layout)) {
    maker.Verge(kerb);
    maker.CornerFill(kerb);
  }
  maker.Finish();
  MarkRoads(park);
}

}  // namespace airsim360::internal::park

// Streets of every kind: markings on the carriageway, crossings, kerbs and pavements, pieces of ground.
#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/kit/test_mesh.h"
#include "airsim360/worlds/texture/test_surfaces.h"
#include "airsim360/worlds/town/street_markings.h"

namespace airsim360 {
namespace {

using namespace internal;

// Ground that is laid and looked at.
struct Laid {
  SceneBuilder builder{"ground"};
  Surfaces surfaces = AddTestSurfaces(builder);
  Ground ground{builder, surfaces};
  Mesh Finish() { return ground.mesh().Finish("ground"); }
};

double Above(const Mesh& mesh) {
  double area = 0;
  ForTriangles(mesh, [&](const MeshPart&, Vec3f a, Vec3f b, Vec3f c) { area += static_cast<double>(Cross(b - a, c - a).z) / 2; });
  return area;
}

struct Street {
  const char* name;
  StreetKind kind;
  float half_width;
  bool bike_lane, along_x;
};
void PrintTo(const Street& street, std::ostream* out) { *out << street.name; }

class EveryStreet : public testing::TestWithParam<Street> {
 protected:
  StreetStretch stretch() const { return {{-7, GetParam().half_width, GetParam().kind}, GetParam().along_x, 20, 140}; }
  Mesh Markings() const {
    Laid laid;
    LayMarkings(laid.ground, stretch(), "a", GetParam().bike_lane);
    return laid.Finish();
  }
  // Along, across (left positive) and over the carriageway.
  Vec3f InStreet(Vec3f p) const {
    const float s = GetParam().along_x ? p.x : p.y, d = GetParam().along_x ? p.y + 7 : -7 - p.x;
    return {s, d, p.z - CarriagewayHeight(stretch().line, d)};
  }
};

INSTANTIATE_TEST_SUITE_P(
    Streets, EveryStreet,
    testing::Values(Street{"two_way", StreetKind::kTwoWay, 6, false, true}, Street{"two_way_north", StreetKind::kTwoWay, 6, false, false},
                    Street{"narrow", StreetKind::kTwoWay, 5.6f, false, true}, Street{"with_bike_lanes", StreetKind::kTwoWay, 7, true, true},
                    Street{"with_bike_lanes_north", StreetKind::kTwoWay, 7, true, false},
                    Street{"avenue", StreetKind::kAvenue, 13, false, false}, Street{"avenue_east", StreetKind::kAvenue, 13, false, true},
                    Street{"boulevard", StreetKind::kBoulevard, 13, false, false},
                    Street{"boulevard_east", StreetKind::kBoulevard, 13, false, true}),
    [](const auto& info) { return info.param.name; });

TEST_P(EveryStreet, PaintLiesOneOrTwoLiftsOverTheCrownWithinTheStreet) {
  const Mesh mesh = Markings();
  EXPECT_EQ(FaultOf(mesh), "");
  for (Vec3f p : mesh.positions) {
    const Vec3f q = InStreet(p);
    EXPECT_TRUE(std::abs(q.z - kPaintLift) < 1e-4f || std::abs(q.z - 2 * kPaintLift) < 1e-4f) << q.z;
    EXPECT_LE(std::abs(q.y), GetParam().half_width - 0.35f);
    EXPECT_GE(q.x, 20);
    EXPECT_LE(q.x, 140);
  }
  // Between the corners the crown must not come through.
  ForTriangles(mesh, [&](const MeshPart&, Vec3f a, Vec3f b, Vec3f c) {
    EXPECT_GT(Cross(b - a, c - a).z, 0);
    EXPECT_GT(InStreet((a + b + c) * (1.0f / 3)).z, 0.5f * kPaintLift);
    for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}}) EXPECT_GT(InStreet((p + q) * 0.5f).z, 0.25f * kPaintLift);
  });
}

// Stops along a line at distance d: where paint of a surface begins and ends.
std::vector<std::pair<float, float>> Runs(const Mesh& mesh, const StreetStretch& street, float d, MaterialId material) {
  const TestRays rays(mesh, street.along_x ? 0 : 1);
  std::vector<std::pair<float, float>> runs;
  bool on = false;
  for (float s = street.s0; s <= street.s1; s += 0.05f) {
    const auto hit = rays.First(street.At(s, d, 1), {0, 0, -1}, 2);
    const bool paint = hit && hit->material == material;
    if (paint && !on) runs.push_back({s, s});
    if (paint) runs.back().second = s;
    on = paint;
  }
  return runs;
}

TEST_P(EveryStreet, LinesAreDashedSolidAndColouredByTheirKind) {
  const Mesh mesh = Markings();
  const StreetStretch street = stretch();
  const MaterialId white = TestMaterial(Surface::kPaintWhite), yellow = TestMaterial(Surface::kPaintYellow);
  const bool boulevard = GetParam().kind == StreetKind::kBoulevard, avenue = GetParam().kind == StreetKind::kAvenue;
  // The middle: yellow lines from one stop bar to the other.
  for (float d : boulevard ? std::vector<float>{-2.35f, 2.35f} : std::vector<float>{-0.135f, 0.135f}) {
    const auto runs = Runs(mesh, street, d, yellow);
    ASSERT_EQ(runs.size(), 1u) << d;
    EXPECT_NEAR(runs[0].first, 25.6f, 0.06f);
    EXPECT_NEAR(runs[0].second, 134.4f, 0.06f);
  }
  // Between lanes of one way: 3 m of paint, then 6 m without.
  for (float d : boulevard ? std::vector<float>{-5.5f, 5.9f}
                 : avenue  ? std::vector<float>{-7.2f, -3.7f, 3.7f, 7.2f}
                           : std::vector<float>{}) {
    auto runs = Runs(mesh, street, d, white);
    std::erase_if(runs, [&](const auto& run) { return run.first < 25.55f || run.second > 134.45f; });  // stop bars
    ASSERT_GE(runs.size(), 11u) << d;
    for (size_t i = 0; i < runs.size(); ++i) {
      EXPECT_NEAR(runs[i].second - runs[i].first, 3, 0.11f) << d;
      if (i > 0) {
        EXPECT_NEAR(runs[i].first - runs[i - 1].first, 9, 0.11f) << d;
      }
    }
  }
}

// Bays of 6.2 m: a line at each end, crossed 1 m off the kerb.
TEST_P(EveryStreet, ParkingBaysAreAsLongAsACar) {
  const float d = GetParam().half_width - 1;
  for (float side : {-1.0f, 1.0f}) {
    auto runs = Runs(Markings(), stretch(), side * d, TestMaterial(Surface::kPaintWhite));
    std::erase_if(runs, [&](const auto& run) { return run.second - run.first > 0.2f; });  // stop bars
    if (GetParam().kind == StreetKind::kBoulevard && side > 0) continue;                  // the bus lane
    ASSERT_GE(runs.size(), 16u);
    for (size_t i = 1; i < runs.size(); ++i) EXPECT_NEAR(runs[i].first - runs[i - 1].first, 6.2f, 0.11f);
  }
}

TEST_P(EveryStreet, StopBarsCloseTheSideOfThoseWhoCome) {
  // Traffic keeps right: those who drive towards growing s have d < 0 and stop at the far end.
  const Mesh mesh = Markings();
  const TestRays rays(mesh, GetParam().along_x ? 0 : 1);
  const auto white = [&](float s, float d) {
    const auto hit = rays.First(stretch().At(s, d, 1), {0, 0, -1}, 2);
    return hit && hit->material == TestMaterial(Surface::kPaintWhite);
  };
  const float lane = GetParam().kind == StreetKind::kTwoWay ? 1.7f : 3.1f;
  EXPECT_TRUE(white(134.8f, -lane));
  EXPECT_FALSE(white(134.8f, lane));
  EXPECT_TRUE(white(25.2f, lane));
  EXPECT_FALSE(white(25.2f, -lane));
}

TEST_P(EveryStreet, GreenAndRedLanesAreWhereTheirKindHasThem) {
  const Mesh mesh = Markings();
  const double length = 120 - 2 * 5.6;
  const bool boulevard = GetParam().kind == StreetKind::kBoulevard;
  const double green = boulevard ? 1.7 : GetParam().bike_lane ? 2 * 1.48 : 0, red = boulevard ? 3.1 : 0;
  EXPECT_NEAR(AreaOf(mesh, {TestMaterial(Surface::kBikeLane)}), green * length, 0.01 * length);
  EXPECT_NEAR(AreaOf(mesh, {TestMaterial(Surface::kBusLane)}), red * length, 0.01 * length);
}

// A lane for bicycles ends at a line towards the cars, has signs in it, and no other paint.
TEST_P(EveryStreet, GreenLanesHaveLinesAndSignsOfBicycles) {
  if (!GetParam().bike_lane) return;
  const Mesh mesh = Markings();
  const StreetStretch street = stretch();
  const MaterialId white = TestMaterial(Surface::kPaintWhite);
  const float parking = street.line.half_width - 2.35f, outer = parking - 0.12f, inner = parking - 1.6f;
  for (float side : {-1.0f, 1.0f}) {
    for (float d : {parking, inner - 0.06f}) {
      float longest = 0;
      for (const auto& [from, to] : Runs(mesh, street, side * d, white)) longest = std::max(longest, to - from);
      EXPECT_GT(longest, 108) << side * d;
    }
    int signs = 0;
    float last = -INFINITY;
    std::vector<std::pair<float, float>> marks;
    for (float d = inner + 0.05f; d < outer; d += 0.05f)
      for (const auto& run : Runs(mesh, street, side * d, white))
        if (run.first > 25.6f && run.second < 134.4f) marks.push_back(run);
    std::ranges::sort(marks);
    for (const auto& [from, to] : marks) {
      EXPECT_LT(to - from, 1.5f);
      signs += from - last > 5;
      last = to;
    }
    EXPECT_EQ(signs, 4) << side;
  }
}

TEST_P(EveryStreet, CarriagewayIsHighestInTheMiddleAndEvenOnBothSides) {
  const StreetLine line = stretch().line;
  const float hw = line.half_width;
  for (float d = 0; d < hw; d += 0.25f) {
    EXPECT_FLOAT_EQ(CarriagewayHeight(line, d), CarriagewayHeight(line, -d));
    EXPECT_NEAR(CarriagewayHeight(line, d) - CarriagewayHeight(line, d + 0.25f), 0.018 * 0.25, 1e-6);
    EXPECT_LT(CarriagewayHeight(line, d), 0.12f);
  }
  EXPECT_FLOAT_EQ(CarriagewayHeight(line, hw), -0.13f);
  for (float s : {20.0f, 77.5f, 140.0f})
    for (float d : {-3.0f, 0.0f, 4.0f}) {
      const Vec3f q = InStreet(stretch().At(s, d, 0.25f));
      EXPECT_NEAR(q.x, s, 1e-5);
      EXPECT_NEAR(q.y, d, 1e-5);
      EXPECT_NEAR(q.z, 0.25f, 1e-6);
    }
}

struct Crossing {
  const char* name;
  StreetLine ns, ew;
};
void PrintTo(const Crossing& crossing, std::ostream* out) { *out << crossing.name; }

class EveryCrossing : public testing::TestWithParam<Crossing> {};

INSTANTIATE_TEST_SUITE_P(Streets, EveryCrossing,
                         testing::Values(Crossing{"equal", {0, 6}, {0, 6}}, Crossing{"wider", {53, 7}, {-161, 5.6f}},
                                         Crossing{"avenue", {132, 13, StreetKind::kAvenue}, {84, 6.5f}},
                                         Crossing{"boulevard", {0, 13, StreetKind::kBoulevard}, {-84, 6.5f}}),
                         [](const auto& info) { return info.param.name; });

TEST_P(EveryCrossing, ItsFanMeetsTheMouthsAndKerbReturns) {
  const auto& [name, ns, ew] = GetParam();
  const Fan fan = FanOf(ns, ew);
  std::vector<Vec2f> rim;
  for (Vec3f p : fan.rim) {
    rim.push_back({p.x, p.y});
    EXPECT_NEAR(fan.Height({p.x, p.y}), p.z, 1e-4);
    const float dx = std::abs(p.x - ns.center), dy = std::abs(p.y - ew.center);
    // At the mouths the height is that of the street that leaves there, at the returns the gutter's.
    if (std::abs(dx - ns.half_width - 6) < 1e-3f) {
      EXPECT_NEAR(p.z, CarriagewayHeight(ew, p.y - ew.center), 1e-4);
    } else if (std::abs(dy - ew.half_width - 6) < 1e-3f) {
      EXPECT_NEAR(p.z, CarriagewayHeight(ns, p.x - ns.center), 1e-4);
    } else {
      EXPECT_NEAR(std::hypot(dx - ns.half_width - 6, dy - ew.half_width - 6), 6, 1e-3);
      EXPECT_NEAR(p.z, -0.13f, 1e-5);
    }
  }
  const double hx = static_cast<double>(ns.half_width), hy = static_cast<double>(ew.half_width);
  const double cross = 4 * hx * hy + 24 * (hx + hy), corner = 36 - 36 * std::numbers::pi / 4;
  EXPECT_NEAR(Shoelace(rim), cross + 4 * corner, 0.01 * cross);
  EXPECT_FLOAT_EQ(fan.Height({ns.center, ew.center}), fan.middle.z);
}

TEST_P(EveryCrossing, ItsPaintLiesOnItsFan) {
  const auto& [name, ns, ew] = GetParam();
  for (int box = 0; box < 2; ++box) {
    Laid laid;
    const Fan fan = FanOf(ns, ew);
    if (box) {
      LayJunctionBox(laid.ground, fan, ns, ew, name);
    } else if (ns.kind == StreetKind::kBoulevard) {
      LayJunctionGuides(laid.ground, fan, ns, ew, name);
    } else {
      continue;
    }
    const Mesh mesh = laid.Finish();
    EXPECT_EQ(FaultOf(mesh, false), "");
    ForTriangles(mesh, [&](const MeshPart&, Vec3f a, Vec3f b, Vec3f c) {
      EXPECT_GT(Cross(b - a, c - a).z, 0);
      for (Vec3f p : {a, b, c, (a + b + c) * (1.0f / 3)}) {
        const float lift = p.z - fan.Height({p.x, p.y});
        EXPECT_GT(lift, 0.001f);
        EXPECT_LT(lift, 0.022f);
        EXPECT_LE(std::abs(p.x - ns.center), ns.half_width + (box ? 0.0f : 6));
        EXPECT_LE(std::abs(p.y - ew.center), ew.half_width + (box ? 0.0f : 6));
      }
    });
  }
}

struct Pavement {
  const char* name;
  float width, depth, pavement, radius;
  bool worn;
};
void PrintTo(const Pavement& pavement, std::ostream* out) { *out << pavement.name; }

class EveryPavement : public testing::TestWithParam<Pavement> {
 protected:
  Block block() const {
    Block block;
    block.kerb = {-30, 10, -30 + GetParam().width, 10 + GetParam().depth};
    block.pavement = GetParam().pavement;
    block.corner_radius = GetParam().radius;
    return block;
  }
};

INSTANTIATE_TEST_SUITE_P(Streets, EveryPavement,
                         testing::Values(Pavement{"large", 100, 80, 5, 6, false}, Pavement{"worn", 100, 80, 5, 6, true},
                                         Pavement{"small", 45, 40, 5, 6, false}, Pavement{"narrow", 60, 50, 3, 6, false},
                                         Pavement{"long", 106, 71, 4.5f, 6, true}),
                         [](const auto& info) { return info.param.name; });

TEST_P(EveryPavement, HasNoHoleAndDropsAtCrossingsAlone) {
  Laid laid;
  LayPavement(laid.ground, block(), Surface::kSlabs, "ground/pavement/modular", GetParam().worn);
  const Mesh mesh = laid.Finish();
  EXPECT_EQ(FaultOf(mesh), "");
  const TestRays rays(mesh, 0);
  const GroundRect kerb = block().kerb, inner = block().inner();
  const float r = GetParam().radius;
  for (float x = kerb.x0 + 0.043f; x < kerb.x1; x += 0.71f) {
    for (float y = kerb.y0 + 0.037f; y < kerb.y1; y += 0.67f) {
      const Vec2f c{std::clamp(x, kerb.x0 + r, kerb.x1 - r), std::clamp(y, kerb.y0 + r, kerb.y1 - r)};
      const float off = std::hypot(x - c.x, y - c.y);
      if (std::abs(off - r) < 0.03f) continue;  // the return is a polygon of ten chords
      const auto hit = rays.First({x, y, 2}, {0, 0, -1}, 4);
      const bool inside = off < r && !inner.Contains({x, y});
      ASSERT_EQ(hit.has_value(), inside) << x << ", " << y;
      if (!hit) continue;
      const float z = 2 - hit->t, edge = std::min({x - kerb.x0, kerb.x1 - x, y - kerb.y0, kerb.y1 - y});
      const float s = std::min(std::min(x - kerb.x0, kerb.x1 - x), 1e9f), t = std::min(y - kerb.y0, kerb.y1 - y);
      const float along = std::max(s, t), start = r + kCrosswalkStart;  // from the nearer corner
      if (along > start && along < start + kCrosswalkWidth && edge < 0.15f) {
        EXPECT_NEAR(z, -0.11f, 1e-4) << x << ", " << y;
      } else if (along < start - 0.9f || along > start + kCrosswalkWidth + 0.9f || edge > 1.66f) {
        EXPECT_NEAR(z, 0, 0.006f) << x << ", " << y;  // gum and stains lie a little over it
      } else {
        EXPECT_LE(z, 0.006f);
        EXPECT_GE(z, -0.1101f);
      }
    }
  }
}

// From the carriageway a kerb is a face down below the gutter, all around.
TEST_P(EveryPavement, ItsKerbClosesTheStepFromTheGutter) {
  Laid laid;
  LayPavement(laid.ground, block(), Surface::kSlabs);
  const TestRays rays(laid.Finish(), 2);
  for (int side = 0; side < 4; ++side) {
    const BlockSide line = SideOf(block(), side);
    for (float s = 0.31f; s < line.length; s += 0.83f) {
      const Vec2f from = line.At(s, -3);
      const Vec3f in{line.inward.x, line.inward.y, 0};
      const auto hit = rays.First({from.x, from.y, -0.13f}, in, 3 + 2 * GetParam().radius);
      ASSERT_TRUE(hit) << side << " " << s;
      EXPECT_EQ(hit->material, TestMaterial(Surface::kKerb));
      EXPECT_LT(Dot(hit->n, in), 0);
      if (s > GetParam().radius && s < line.length - GetParam().radius) {
        EXPECT_NEAR(hit->t, 3, 1e-3);
      }
    }
  }
}

TEST(GroundPieces, HaveTheAreaOfTheirClosedForms) {
  for (int steps : {3, 8, 40}) {
    for (float r0 : {0.0f, 2.0f}) {
      Laid laid;
      laid.ground.Begin("ring", "ground/road", Surface::kAsphalt);
      laid.ground.RingSector({4, 5}, r0, 6, 0.3f, 2.3f, 0.1f, steps);
      const double chord = std::sin(2.0 / steps) * steps / 2, area = (36 - static_cast<double>(r0 * r0)) * chord;
      EXPECT_NEAR(Above(laid.Finish()), area, 1e-4 * area) << steps;
    }
  }
  Laid laid;
  laid.ground.Begin("rect", "ground/road", Surface::kAsphalt);
  laid.ground.Rect({-3, 2, 9, 4.5f}, 1);
  EXPECT_NEAR(Above(laid.Finish()), 12 * 2.5, 1e-4);
}

TEST(GroundPieces, PolygonsHaveTheAreaOfTheShoelaceFormula) {
  for (int corners = 3; corners < 60; corners += 7) {
    std::vector<Vec2f> outline;
    for (int i = 0; i < corners; ++i) {
      const float a = 2 * kPiF * static_cast<float>(i) / static_cast<float>(corners);
      const float r = 10 + 6 * std::sin(3.7f * static_cast<float>(i * i));
      outline.push_back({100 + r * std::cos(a), -50 + r * std::sin(a)});
    }
    Laid laid;
    laid.ground.Begin("polygon", "ground/grass", Surface::kLawn);
    laid.ground.Polygon(outline, 0.2f);
    const Mesh mesh = laid.Finish();
    EXPECT_NEAR(Above(mesh), Shoelace(outline), 1e-3 * Shoelace(outline)) << corners;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      EXPECT_EQ(mesh.uvs[i], (Vec2f{mesh.positions[i].x, -mesh.positions[i].y}));
      EXPECT_FLOAT_EQ(mesh.positions[i].z, 0.2f);
    }
  }
}

// A wall is seen from the right-hand side of its line.
TEST(GroundPieces, WallsLookToTheRightOfTheirLine) {
  for (int i = 0; i < 8; ++i) {
    const float a = kPiF / 4 * static_cast<float>(i);
    const std::vector<Vec2f> line{{1, 2}, {1 + 3 * std::cos(a), 2 + 3 * std::sin(a)}};
    Laid laid;
    laid.ground.Begin("wall", "ground/kerb", Surface::kKerb);
    laid.ground.Wall(line, -0.2f, 0.3f);
    const Mesh mesh = laid.Finish();
    for (Vec3f n : mesh.normals) EXPECT_GT(n.x * std::sin(a) - n.y * std::cos(a), 0.999f);
    EXPECT_NEAR(AreaOf(mesh, {TestMaterial(Surface::kKerb)}), 1.5, 1e-4);
  }
}

class EverySeedOfStreets : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Streets, EverySeedOfStreets, testing::Range(0, 3));

// Both towns: seen from above, a street is its carriageway or what lies millimetres over it.
TEST_P(EverySeedOfStreets, LieAtTheHeightOfTheirCarriageway) {
  const auto seed = static_cast<uint64_t>(GetParam());
  for (const StreetPlan& plan : {PlanDowntownWest(), PlanNewYorkCity()}) {
    Laid laid, again, other;
    const auto streets = LayStreets(laid.ground, plan, seed);
    LayStreets(again.ground, plan, seed);
    LayStreets(other.ground, plan, seed + 1);
    const Mesh mesh = laid.Finish();
    EXPECT_EQ(FaultOf(mesh, false), "");
    EXPECT_TRUE(SameBytes(mesh, again.Finish()));
    EXPECT_FALSE(SameBytes(mesh, other.Finish()));
    const TestRays rays(mesh, 0);
    for (const StreetStretch& street : streets) {
      for (float s = street.s0 + 0.37f; s < street.s1; s += 7.31f) {
        for (float d = 0.043f - street.line.half_width; d < street.line.half_width; d += 1.37f) {
          const auto hit = rays.First(street.At(s, d, 1), {0, 0, -1}, 2);
          ASSERT_TRUE(hit) << s << ", " << d;
          EXPECT_NEAR(hit->t, 0.992f, 0.0085f) << s << ", " << d;
        }
      }
      for (const StreetStretch& next : streets) {
        if (&street == &next || street.along_x != next.along_x || street.line.center != next.line.center) continue;
        EXPECT_TRUE(street.s1 < next.s0 || next.s1 < street.s0);
      }
    }
  }
}

}  // namespace
}  // namespace airsim360

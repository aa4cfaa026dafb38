// The sea of small maps against rules of their own: half planes, circles, counted samples.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/worlds/osm/osm_sea.h"
#include "airsim360/worlds/osm/test_map.h"

namespace airsim360::internal {
namespace {

const TestMap::Tags kCoast = {{"natural", "coastline"}};
constexpr OsmBox kBox{-500, -400, 500, 400};

Sea SeaOf(const TestMap& map, const OsmBox& box = kBox) { return FindSea(ReadOsm("test.osm", AsBytes(map.Text())), box); }

bool Wet(const Sea& sea, Vec2d p) {
  for (const Patch& patch : sea.water)
    if (Inside(patch, p)) return true;
  return false;
}

double BoxArea(const OsmBox& box) { return box.width() * box.depth(); }

// A round island (clockwise: a lake) of n corners.
std::vector<Vec2d> Circle(Vec2d middle, double radius, bool clockwise = false, int n = 48) {
  std::vector<Vec2d> ring;
  for (int i = 0; i < n; ++i) {
    const double a = (clockwise ? -1 : 1) * 2 * M_PI * i / n;
    ring.push_back(middle + Vec2d{std::cos(a), std::sin(a)} * radius);
  }
  return ring;
}
double CircleArea(double radius, int n = 48) { return n / 2.0 * std::sin(2 * M_PI / n) * radius * radius; }

TEST(OsmSea, TheRightSideIsWet) {
  // Eastwards through the middle: the south is wet. Ways end to end, given out of order.
  TestMap map(500, 400);
  const int a = map.Node({-900, 0}), b = map.Node({-100, 0}), c = map.Node({100, 0}), d = map.Node({900, 0});
  map.WayOf({c, d}, kCoast);
  map.WayOf({a, b}, kCoast);
  map.WayOf({b, c}, kCoast);
  const Sea sea = SeaOf(map);
  EXPECT_TRUE(sea.faults.empty());
  EXPECT_NEAR(Area(sea.water), BoxArea(kBox) / 2, 40);
  EXPECT_TRUE(Wet(sea, {0, -10}));
  EXPECT_FALSE(Wet(sea, {0, 10}));
  TestMap back(500, 400);
  back.Line({{900, 0}, {-900, 0}}, kCoast);
  EXPECT_TRUE(Wet(SeaOf(back), {0, 10}));
  // A corner: in at the west, out at the south, and the same the other way.
  TestMap corner(500, 400);
  corner.Line({{-900, 0}, {0, 0}, {0, -900}}, kCoast);
  EXPECT_NEAR(Area(SeaOf(corner).water), 500 * 400, 40);
  TestMap other(500, 400);
  other.Line({{0, -900}, {0, 0}, {-900, 0}}, kCoast);
  EXPECT_NEAR(Area(SeaOf(other).water), BoxArea(kBox) - 500 * 400, 40);
}

TEST(OsmSea, IslandsAreDryAndTheirLakesWet) {
  TestMap map(500, 400);
  map.Ring(Circle({0, 0}, 300), kCoast);
  map.Ring(Circle({0, 0}, 200, true), kCoast);
  map.Ring(Circle({20, 0}, 90), kCoast);
  const Sea sea = SeaOf(map);
  EXPECT_NEAR(Area(sea.water), BoxArea(kBox) - CircleArea(300) + CircleArea(200) - CircleArea(90), 100);
  EXPECT_FALSE(Wet(sea, {20, 0}));
  EXPECT_TRUE(Wet(sea, {150, 0}));
  EXPECT_FALSE(Wet(sea, {250, 0}));
  EXPECT_TRUE(Wet(sea, {400, 300}));
  // A clockwise ring alone is water in the land.
  TestMap lake(500, 400);
  lake.Ring(Circle({0, 0}, 300, true), kCoast);
  EXPECT_NEAR(Area(SeaOf(lake).water), CircleArea(300), 100);
}

TEST(OsmSea, ABoxThatNoCoastEntersIsWetOrDryAsTheNearestSays) {
  TestMap at_sea(500, 400);
  at_sea.Ring(Circle({2000, 0}, 300), kCoast);
  EXPECT_NEAR(Area(SeaOf(at_sea).water), BoxArea(kBox), 1);
  TestMap on_land(500, 400);
  on_land.Ring(Circle({0, 0}, 3000), kCoast);
  on_land.Ring(Circle({0, 9000}, 3000), kCoast);
  EXPECT_TRUE(SeaOf(on_land).water.empty());
  TestMap none(500, 400);
  none.Line({{-900, 0}, {900, 0}}, {{"highway", "residential"}});
  EXPECT_TRUE(SeaOf(none).water.empty());
}

TEST(OsmSea, LinesThatTheExtractCutsGoOn) {
  // The nodes outside are missing: what is left ends 20 to 60 m before the border; the coast leaves and comes back.
  TestMap map(500, 400);
  std::vector<int> way{9001};
  for (double x : {-460.0, -200.0, 0.0, 200.0, 470.0}) way.push_back(map.Node({x, 20}));
  for (int missing : {9002, 9003}) way.push_back(missing);
  for (double x : {480.0, 0.0, -440.0}) way.push_back(map.Node({x, -180}));
  way.push_back(9004);
  map.WayOf(way, kCoast);
  const Sea sea = SeaOf(map);
  EXPECT_TRUE(sea.faults.empty());
  EXPECT_NEAR(Area(sea.water) / (1000 * 200), 1, 1e-3);
  EXPECT_TRUE(Wet(sea, {490, -100}));
  EXPECT_TRUE(Wet(sea, {-490, -100}));
}

TEST(OsmSea, BrokenCoastsAreMendedAndTold) {
  // The middle way runs the wrong way round.
  TestMap map(500, 400);
  const int a = map.Node({-900, 0}), b = map.Node({-100, 0}), c = map.Node({100, 0}), d = map.Node({900, 0});
  map.WayOf({a, b}, kCoast);
  map.WayOf({c, b}, kCoast);
  map.WayOf({c, d}, kCoast);
  Sea sea = SeaOf(map);
  ASSERT_EQ(sea.faults.size(), 1u);
  EXPECT_NE(sea.faults[0].find("way/2"), std::string::npos);
  EXPECT_NEAR(Area(sea.water), BoxArea(kBox) / 2, 40);
  // A gap of 40 m in the middle.
  TestMap gap(500, 400);
  gap.Line({{-900, 0}, {-20, 0}}, kCoast);
  gap.Line({{20, 0}, {900, 0}}, kCoast);
  sea = SeaOf(gap);
  ASSERT_EQ(sea.faults.size(), 1u);
  EXPECT_NE(sea.faults[0].find("40 m"), std::string::npos);
  EXPECT_NEAR(Area(sea.water), BoxArea(kBox) / 2, 40);
  // A line that ends in the middle of the map.
  TestMap half(500, 400);
  half.Line({{-900, 0}, {0, 0}}, kCoast);
  sea = SeaOf(half);
  EXPECT_EQ(sea.faults.size(), 1u);
  EXPECT_NEAR(Area(sea.water), BoxArea(kBox) / 2, 40);
  // Two lines that contradict each other: some sea, and a word.
  TestMap odd(500, 400);
  odd.Line({{-900, 100}, {900, 100}}, kCoast);
  odd.Line({{-900, -100}, {900, -100}}, kCoast);
  sea = SeaOf(odd);
  EXPECT_FALSE(sea.faults.empty());
  EXPECT_LE(Area(sea.water), BoxArea(kBox) + 1);
}

// Random coasts y = f(x) with random bays and islands, cut into ways anywhere, in any order; counted on a grid.
TEST(OsmSea, RandomCoastsAgreeWithACountOfSamples) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    RngStream rng(seed, "coast");
    std::vector<Vec2d> line;
    for (double x = -1200; x <= 1200; x += rng.Uniform(15, 90)) line.push_back({x, rng.Uniform(-330, 150)});
    line.push_back({1300, 0});
    struct Island {
      Vec2d middle;
      double radius;
    };
    std::vector<Island> islands;
    TestMap map(500, 400);
    // Islands south of everything the coast reaches, some across the border, none touching another.
    for (int i = 0; i < 12; ++i) {
      const Island island{{-550 + 100.0 * i, rng.Uniform(-430, -380)}, rng.Uniform(5, 45)};
      islands.push_back(island);
      map.Ring(Circle(island.middle, island.radius), kCoast);
    }
    std::vector<int> nodes;
    for (Vec2d p : line) nodes.push_back(map.Node(p));
    std::vector<std::vector<int>> ways;
    for (size_t i = 0; i + 1 < nodes.size();) {
      const size_t end = std::min<size_t>(nodes.size() - 1, i + 1 + rng.Index(9));
      ways.emplace_back(nodes.begin() + static_cast<std::ptrdiff_t>(i), nodes.begin() + static_cast<std::ptrdiff_t>(end) + 1);
      i = end;
    }
    for (size_t i = ways.size(); i > 1; --i) std::swap(ways[i - 1], ways[rng.Index(static_cast<uint32_t>(i))]);
    for (const auto& way : ways) map.WayOf(way, kCoast);
    const Sea sea = SeaOf(map);
    EXPECT_TRUE(sea.faults.empty()) << seed << ": " << (sea.faults.empty() ? "" : sea.faults[0]);
    // Even-odd: crossings of the line on the way south.
    const auto rule = [&](Vec2d p) {
      int below = 0;
      for (size_t i = 0; i + 1 < line.size(); ++i)
        if ((line[i].x <= p.x) != (line[i + 1].x <= p.x))
          below += line[i].y + (line[i + 1].y - line[i].y) * (p.x - line[i].x) / (line[i + 1].x - line[i].x) < p.y;
      if (below % 2) return false;
      for (const Island& island : islands)
        if (std::hypot(p.x - island.middle.x, p.y - island.middle.y) < island.radius) return false;
      return true;
    };
    int wet = 0, wrong = 0, count = 0;
    for (double y = kBox.y0 + 2.03; y < kBox.y1; y += 4)
      for (double x = kBox.x0 + 2.03; x < kBox.x1; x += 4) {
        const bool expected = rule({x, y});
        wet += expected;
        ++count;
        wrong += Wet(sea, {x, y}) != expected;
      }
    EXPECT_LE(wrong, count / 2000) << seed;  // between a circle and its 48 corners, and rounding of coordinates
    EXPECT_NEAR(Area(sea.water) / (16.0 * wet), 1, 5e-3) << seed;
  }
}

// The ground of a scene: what is seen from above at a place, and how high it is.
struct Seen {
  std::string name, path;
  double z = -1e9;
};
Seen Below(const Scene& scene, Vec2d p) {
  Seen seen;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (mesh.name != "ground") continue;
    for (const MeshPart& part : mesh.parts)
      for (uint32_t i = 0; i < part.triangle_count; ++i) {
        const Vec3u t = mesh.triangles[part.first_triangle + i];
        const Vec3d a = VecCast<double>(mesh.positions[t.x]), b = VecCast<double>(mesh.positions[t.y]),
                    c = VecCast<double>(mesh.positions[t.z]);
        const double det = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
        if (std::abs(det) < 1e-9) continue;
        const double u = ((p.x - a.x) * (c.y - a.y) - (c.x - a.x) * (p.y - a.y)) / det,
                     v = ((b.x - a.x) * (p.y - a.y) - (p.x - a.x) * (b.y - a.y)) / det;
        const double z = a.z + u * (b.z - a.z) + v * (c.z - a.z);
        if (u < 0 || v < 0 || u + v > 1 || z <= seen.z) continue;
        const Entity& entity = scene.entity(part.entity);
        seen = {entity.name, scene.tree[entity.category].path, z};
      }
  }
  return seen;
}

// A town on a coast that runs along y = 0; a reserve, a pier and a bay reach over it, a river into it.
TestMap CoastTown() {
  TestMap map(400, 300);
  map.Line({{-900, 0}, {900, 0}}, kCoast);
  map.Box({-100, -150}, {100, 100}, {{"leisure", "nature_reserve"}});
  map.Box({150, -60}, {156, 20}, {{"man_made", "pier"}});
  map.Line({{250, 20}, {250, -80}}, {{"man_made", "pier"}, {"width", "4"}});
  map.Box({-350, -120}, {-200, 30}, {{"natural", "bay"}, {"name", "Small Bay"}});
  map.Box({300, -20}, {330, 200}, {{"natural", "water"}});
  for (int i = 0; i < 9; ++i)
    for (int k = 0; k < 5; ++k)
      map.Box({-390.0 + 85 * i, 40.0 + 52 * k}, {-330.0 + 85 * i, 80.0 + 52 * k}, {{"building", "yes"}, {"height", "12"}});
  return map;
}

TEST(OsmSea, ATownByTheSea) {
  OsmReport report;
  const auto scene = CoastTown().Build(&report, {});
  const auto at = [&](double x, double y) { return Below(*scene, {x, y}); };
  EXPECT_EQ(at(-150, -100).path, "water/sea");
  EXPECT_NEAR(at(-150, -100).z, -0.28, 1e-3);
  EXPECT_EQ(at(0, -50).name, "sea");  // under the reserve
  EXPECT_EQ(at(0, 50).path, "ground/terrain/landscape");
  EXPECT_NEAR(at(153, -30).z, 0, 1e-3);  // the pier as an area
  EXPECT_EQ(at(250, -40).path, "ground/pavement/modular");
  EXPECT_EQ(at(-250, -60).name, "way/5 Small Bay");
  EXPECT_EQ(at(-250, -60).path, "water/sea");
  EXPECT_NE(at(-250, 15).path, "water/sea");  // the bay's outline on land
  // On beyond the edge of the map, to the horizon; and the town on its side.
  for (double d : {50.0, 200.0, 1000.0, 8000.0}) {
    EXPECT_EQ(at(0, -330 - d).name, "sea") << d;
    EXPECT_EQ(at(-430 - d, -20 - d / 10).name, "sea") << d;
    EXPECT_NE(at(430 + d, 20 + d / 10).path, "water/sea") << d;
  }
  int blocks = 0;
  for (const Entity& entity : scene->entities) {
    if (!entity.name.starts_with("backdrop block")) continue;
    ++blocks;
    EXPECT_GT(static_cast<double>(entity.bounds.max.y), 0);
    const Vec3f c = entity.bounds.center();
    EXPECT_NE(at(static_cast<double>(c.x), static_cast<double>(entity.bounds.min.y)).name, "sea");
  }
  EXPECT_GT(blocks, 50);
}

// No wall between waters that meet: the bank of the river ends where it opens into the sea.
TEST(OsmSea, RiversOpenIntoTheSea) {
  const auto scene = CoastTown().Build();
  EXPECT_NEAR(Below(*scene, {315, -20.1}).z, -0.28, 1e-3);
  EXPECT_NEAR(Below(*scene, {-275, -120.1}).z, -0.28, 1e-3);
  EXPECT_NEAR(Below(*scene, {299.9, 100}).z, 0.004, 1e-3);  // on land it has one
}

TEST(OsmSea, TheGroundIsStillCoveredOnce) {
  const auto scene = CoastTown().Build();
  double sum = 0;
  const std::set<std::string> ground{"water/sea", "water/lake", "ground/terrain/landscape", "ground/pavement/modular", "ground/grass"};
  for (const Instance& instance : scene->instances) {
    const Mesh& mesh = scene->meshes[instance.mesh];
    if (mesh.name != "ground") continue;
    for (const MeshPart& part : mesh.parts) {
      const Entity& entity = scene->entity(part.entity);
      if (!ground.contains(scene->tree[entity.category].path) || entity.name == "country") continue;
      for (uint32_t i = 0; i < part.triangle_count; ++i) {
        const Vec3u t = mesh.triangles[part.first_triangle + i];
        const Vec3f a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        if (std::max({std::abs(a.x), std::abs(b.x), std::abs(c.x)}) > 430.5f ||
            std::max({std::abs(a.y), std::abs(b.y), std::abs(c.y)}) > 330.5f)
          continue;
        sum += static_cast<double>(Cross(b - a, c - a).z) / 2;
      }
    }
  }
  EXPECT_NEAR(sum / (860 * 660), 1, 2e-4);
}

// A town whose edge is a park and a lake: open country behind those, houses behind houses.
TEST(OsmSea, NoTownIsInventedBehindAPark) {
  TestMap map(400, 300);
  for (int i = 0; i < 9; ++i)
    for (int k = 0; k < 10; ++k)
      map.Box({-390.0 + 85 * i, -280.0 + 52 * k}, {-330.0 + 85 * i, -240.0 + 52 * k}, {{"building", "yes"}, {"height", "12"}});
  map.Box({-450, 240}, {450, 400}, {{"leisure", "park"}});
  const auto scene = map.Build(nullptr, {});
  int north = 0, south = 0;
  for (const Entity& entity : scene->entities) {
    if (!entity.name.starts_with("backdrop block")) continue;
    const Vec3f c = entity.bounds.center();
    north += c.y > 330 && std::abs(c.x) < c.y;
    south += c.y < -330 && std::abs(c.x) < -c.y;
  }
  EXPECT_EQ(north, 0);
  EXPECT_GT(south, 50);
}

}  // namespace
}  // namespace airsim360::internal

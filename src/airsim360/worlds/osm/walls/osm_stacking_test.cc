// Building parts that stand on others: nobody sees through between them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "airsim360/worlds/osm/test_map.h"

namespace airsim360::internal {
namespace {

struct Corners {
  Vec3d a, b, c;
};

// The triangles of all buildings.
std::vector<Corners> BuildingTriangles(const Scene& scene) {
  std::vector<Corners> all;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (const MeshPart& part : mesh.parts) {
      const EntityId entity = part.entity != kNoEntity ? part.entity : instance.entity;
      if (!scene.tree[scene.entity(entity).category].path.starts_with("construction/building")) continue;
      for (uint32_t i = 0; i < part.triangle_count; ++i) {
        const Vec3u t = mesh.triangles[part.first_triangle + i];
        const auto at = [&](uint32_t k) { return VecCast<double>(instance.X_WM * mesh.positions[k]); };
        all.push_back({at(t.x), at(t.y), at(t.z)});
      }
    }
  }
  return all;
}

// Does the segment from p to q meet a triangle? (Moeller and Trumbore)
bool Meets(const std::vector<Corners>& triangles, Vec3d p, Vec3d q) {
  const Vec3d d = q - p;
  for (const Corners& t : triangles) {
    const Vec3d e1 = t.b - t.a, e2 = t.c - t.a, h = Cross(d, e2);
    const double det = Dot(e1, h);
    if (std::abs(det) < 1e-12) continue;
    const Vec3d s = p - t.a, g = Cross(s, e1);
    const double u = Dot(s, h) / det, v = Dot(d, g) / det, w = Dot(e2, g) / det;
    if (u >= -1e-9 && v >= -1e-9 && u + v <= 1 + 1e-9 && w >= 0 && w <= 1) return true;
  }
  return false;
}

constexpr const char* kShapes[] = {"flat", "gabled", "hipped", "half-hipped", "gambrel",  "mansard", "pyramidal",
                                   "cone", "dome",   "onion",  "round",       "skillion", "saltbox", "sawtooth"};

struct Stack {
  std::string shape;
  int storeys;
  double inset;  // of each volume against the one below; negative: wider
  Vec2d middle;
};

// Of many rays through the two joints of a stack of three volumes, those that meet nothing.
int Slits(const Stack& stack, const std::vector<Corners>& all) {
  std::vector<Corners> triangles;
  const Vec3d middle{stack.middle.x, stack.middle.y, 0};
  for (const Corners& t : all)
    if (Norm(Vec3d{t.a.x, t.a.y, 0} - middle) < 22) triangles.push_back(t);
  int slits = 0;
  for (int joint = 1; joint <= 2; ++joint)
    for (double under = -0.41; under < 2.2; under += 0.13)
      for (int i = 0; i < 6; ++i)
        for (double tilt : {0.0, 0.4}) {
          // Through the axis of the stack, level or falling, so that it passes within the narrowest volume.
          const double a = 0.1 + i * M_PI / 6, z = 3.2 * stack.storeys * joint - under;
          const Vec3d way = Vec3d{std::cos(a), std::sin(a), 0} * 22;
          slits += !Meets(triangles, middle + Vec3d{0, 0, z + tilt} - way, middle + Vec3d{0, 0, z - tilt} + way);
        }
  return slits;
}

TEST(OsmStacking, NobodySeesThroughBetweenVolumesOfAnyRoof) {
  TestMap map(400, 400);
  std::vector<Stack> stacks;
  for (const char* shape : kShapes)
    for (int storeys : {2, 3, 5})
      for (double inset : {0.0, 2.0, -1.5}) {
        const auto n = static_cast<double>(stacks.size());
        stacks.push_back({shape, storeys, inset, {-330 + 60 * std::fmod(n, 12), -330 + 60 * std::floor(n / 12)}});
        const Stack& stack = stacks.back();
        const double tall = 3.2 * storeys;
        const auto box = [&](double x, double y, TestMap::Tags tags) {
          map.Box(stack.middle - Vec2d{x, y}, stack.middle + Vec2d{x, y}, tags);
        };
        box(14, 11, {{"building", "yes"}, {"height", std::to_string(3 * tall)}});
        for (int i = 0; i < 3; ++i)
          box(10 - inset * i, 7 - inset * i,
              {{"building:part", "yes"},
               {"height", std::to_string(tall * (i + 1))},
               {"min_height", std::to_string(tall * i)},
               {"roof:shape", shape},
               {"roof:height", "2.2"}});
      }
  const std::vector<Corners> triangles = BuildingTriangles(*map.Build());
  for (const Stack& stack : stacks)
    EXPECT_EQ(Slits(stack, triangles), 0) << stack.shape << ", " << stack.storeys << " storeys, inset " << stack.inset;
}

// What the map leaves open stays open: a bridge between two towers, a floor a storey above a roof.
TEST(OsmStacking, PassagesStayOpen) {
  TestMap map(60, 60);
  map.Box({-20, -6}, {-10, 6}, {{"building", "yes"}, {"height", "20"}});
  map.Box({10, -6}, {20, 6}, {{"building", "yes"}, {"height", "20"}});
  map.Box({-20, -6}, {20, 6}, {{"building:part", "yes"}, {"height", "26"}, {"min_height", "20"}});
  const std::vector<Corners> triangles = BuildingTriangles(*map.Build());
  EXPECT_FALSE(Meets(triangles, {0, -30, 18}, {0, 30, 18}));
  EXPECT_TRUE(Meets(triangles, {0, -30, 22}, {0, 30, 22}));
  EXPECT_TRUE(Meets(triangles, {-15, -30, 19.5}, {-15, 30, 19.5}));
  TestMap gap(60, 60);
  gap.Box({-10, -10}, {10, 10}, {{"building", "yes"}, {"height", "30"}});
  gap.Box({-10, -10}, {10, 10}, {{"building:part", "yes"}, {"height", "10"}});
  gap.Box({-10, -10}, {10, 10}, {{"building:part", "yes"}, {"height", "30"}, {"min_height", "13"}});
  EXPECT_FALSE(Meets(BuildingTriangles(*gap.Build()), {0, -30, 11.5}, {1, 30, 11.5}));
}

// On a slope all volumes of a stack count their heights from the same ground.
TEST(OsmStacking, AStackOnASlopeStaysTogether) {
  TestMap map(60, 60);
  map.Box({-20, -10}, {20, 10}, {{"building", "yes"}, {"height", "24"}});
  map.Box({-20, -10}, {20, 10}, {{"building:part", "yes"}, {"height", "12"}});
  map.Box({14, -6}, {19, 6}, {{"building:part", "yes"}, {"height", "24"}, {"min_height", "12"}});
  HeightGrid grid{41, 41, 6.98, 45.02, 0.001, 0.001, {}};
  for (int i = 0; i < 41 * 41; ++i) grid.heights.push_back(static_cast<float>(100 + 0.1 * 78846.8 * ((i % 41 + 0.5) * 0.001 - 0.02)));
  const std::vector<Corners> triangles =
      BuildingTriangles(*map.Build(nullptr, {.heights = [&](const GeoBox&) { return grid; }, .fill = false}));
  for (double z = 7; z < 18; z += 0.1) EXPECT_TRUE(Meets(triangles, {16.5, -30, z}, {16.5, 30, z})) << z;
}

// A drum with a dome that is a building itself, in a cathedral, under a cross: the dome stays.
TEST(OsmBuildings, AnOutlineThatIsAPartKeepsItsRoof) {
  const auto dome = [](bool cross) {
    TestMap map(60, 60);
    map.Box({-22, -22}, {22, 22}, {{"building", "cathedral"}, {"height", "13"}});
    const int drum =
        map.Box({-11, -11}, {11, 11}, {{"building", "church"}, {"building:part", "yes"}, {"height", "38"}, {"roof:shape", "dome"}});
    if (cross) map.Box({-1, -1}, {1, 1}, {{"building:part", "yes"}, {"height", "41"}, {"min_height", "37"}});
    const auto scene = map.Build();
    for (const Entity& entity : scene->entities)
      if (entity.name == "way/" + std::to_string(drum) + "/roof") return entity.bounds;
    return Box3f{};
  };
  const Box3f without = dome(false), with = dome(true);
  EXPECT_NEAR(static_cast<double>(without.max.z), 38, 0.01);
  EXPECT_NEAR(static_cast<double>(with.max.z), 38, 0.01);
  EXPECT_NEAR(static_cast<double>(with.min.z), static_cast<double>(without.min.z), 0.01);
  EXPECT_LT(static_cast<double>(with.min.z), 30);
}

}  // namespace
}  // namespace airsim360::internal

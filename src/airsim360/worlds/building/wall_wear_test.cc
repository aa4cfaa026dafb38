// Marks of age on walls: where they lie, what they keep off, how much differs from house to house.
#include "airsim360/worlds/building/wall_wear.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "airsim360/worlds/kit/test_mesh.h"
#include "airsim360/worlds/texture/test_surfaces.h"

namespace airsim360 {
namespace {

using namespace internal;

constexpr float kWornLength = 24, kWornTop = 14;

struct WornPen {
  SceneBuilder builder{"wear"};
  Surfaces surfaces = AddTestSurfaces(builder);
  MeshBuilder mesh;
  FacadePen pen{mesh, surfaces};
  WornPen() {
    pen.SetScale(0, 1, 1);
    pen.SetWall({0, 0}, {kWornLength, 0});
  }
};

Dress DressWith(Surface surface) {
  BuildingPlan plan;
  plan.style = FacadeStyle::kStuccoShutters;
  Dress dress = DressOf(plan);
  dress.wall = surface;
  return dress;
}

Mesh WornMesh(Surface wall, const std::vector<Kept>& kept, float amount, uint64_t seed) {
  WornPen d;
  RngStream rng(seed, "test");
  WearWall(d.pen, DressWith(wall), 3, kWornTop, kept, amount, rng);
  return d.mesh.Finish("wear");
}

TEST(RoughPatch, IsFlatWithinItsBoxAndFacesTheStreet) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    WornPen d;
    RngStream rng(seed, "test");
    d.pen.Use(Surface::kConcrete);
    RoughPatch(d.pen, {8, 5}, {0.9f, 0.5f}, 0.008f, rng);
    const Mesh mesh = d.mesh.Finish("patch");
    double area = 0;
    for (Vec3u t : mesh.triangles) {
      const Vec3f a = mesh.positions[t.x], n = Cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
      EXPECT_LT(n.y, 0);
      area += 0.5 * static_cast<double>(Norm(n));
    }
    const Box3f box = mesh.Bounds();
    EXPECT_GE(box.min.x, 8 - 0.901f);
    EXPECT_LE(box.max.x, 8 + 0.901f);
    EXPECT_GE(box.min.z, 5 - 0.501f);
    EXPECT_LE(box.max.z, 5 + 0.501f);
    EXPECT_NEAR(box.min.y, -0.008f, 1e-6);
    EXPECT_NEAR(box.max.y, -0.008f, 1e-6);
    // More than a star, less than the box.
    EXPECT_GT(area, 0.28 * 1.8 * 1.0);
    EXPECT_LT(area, 0.93 * 1.8 * 1.0);
  }
}

TEST(WearWall, KeepsOffOpeningsAndOnTheWall) {
  std::vector<Kept> kept;
  for (float z = 4; z < kWornTop - 2; z += 3.2f)
    for (float x = 1.2f; x < kWornLength - 2; x += 3) kept.push_back({x, x + 1.6f, z, z + 2.2f});
  for (uint64_t seed = 0; seed < 30; ++seed) {
    const Mesh mesh = WornMesh(Surface::kStuccoOchre, kept, 1, seed);
    ASSERT_FALSE(mesh.triangles.empty());
    const Box3f box = mesh.Bounds();
    EXPECT_GE(box.min.x, -0.001f);
    EXPECT_LE(box.max.x, kWornLength + 0.001f);
    EXPECT_GE(box.min.z, 3 - 0.15f);
    EXPECT_LE(box.max.z, kWornTop);
    EXPECT_GT(box.min.y, -0.25f);
    for (Vec3f p : mesh.positions)
      for (const Kept& k : kept) {
        const bool inside = p.x > k.x0 + 0.001f && p.x < k.x1 - 0.001f && p.z > k.z0 + 0.001f && p.z < k.z1 - 0.001f;
        ASSERT_FALSE(inside) << seed << ": " << p.x << " " << p.z;
      }
  }
}

// What a yard's wall has, a front has a part of; panels of glass and metal are not mended with mortar.
TEST(WearWall, DependsOnHowWellAWallIsKept) {
  const auto area = [&](Surface wall, float amount) {
    double sum = 0;
    for (uint64_t seed = 0; seed < 24; ++seed) {
      const Mesh mesh = WornMesh(wall, {}, amount, seed);
      for (const MeshPart& part : mesh.parts) {
        const auto s = static_cast<Surface>(part.material);
        if (!IsBrick(s) && s != Surface::kConcrete && s != Surface::kConcreteWarm && s != Surface::kTrimStone) continue;
        for (uint32_t k = 0; k < part.triangle_count; ++k) {
          const Vec3u t = mesh.triangles[part.first_triangle + k];
          const Vec3f a = mesh.positions[t.x];
          sum += 0.5 * static_cast<double>(Norm(Cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a)));
        }
      }
    }
    return sum / (24 * static_cast<double>(kWornLength) * (kWornTop - 3));
  };
  const double yard = area(Surface::kStuccoRose, 1), front = area(Surface::kStuccoRose, 0.35f);
  // Few per cent of a wall are mended: 2 to 10.
  EXPECT_GT(yard, 0.02);
  EXPECT_LT(yard, 0.10);
  EXPECT_LT(front, 0.7 * yard);
  EXPECT_EQ(area(Surface::kPanelDark, 1), 0);
}

TEST(DampFoot, EndsRoughlyBelowItsHeight) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    WornPen d;
    RngStream rng(seed, "test");
    DampFoot(d.pen, DressWith(Surface::kStuccoWhite), 2, 5.4f, 0, 0.8f, rng);
    const Mesh mesh = d.mesh.Finish("damp");
    std::set<int> heights;  // centimetres
    for (Vec3f p : mesh.positions) {
      EXPECT_GE(p.z, -1e-6f);
      EXPECT_LE(p.z, 0.801f);
      if (p.z > 0.01f) heights.insert(static_cast<int>(100 * p.z));
    }
    EXPECT_GE(heights.size(), 4u);
    // Seen above ground that lies higher than the wall's foot, and not at all where that hides it.
    WornPen higher, hidden;
    DampFoot(higher.pen, DressWith(Surface::kStuccoWhite), 2, 5.4f, 0.5f, 0.9f, rng);
    EXPECT_GT(higher.mesh.Finish("damp").Bounds().max.z, 0.7f);
    DampFoot(hidden.pen, DressWith(Surface::kStuccoWhite), 2, 5.4f, 0.9f, 0.9f, rng);
    EXPECT_TRUE(hidden.mesh.Finish("damp").triangles.empty());
    EXPECT_NEAR(mesh.Bounds().size().x, 3.4f, 1e-4);
  }
}

// Whole walls towards a yard: most of them, at windows, but none that hangs before an opening.
TEST(DampFoot, IsUnderMostWallsTowardsYardsBelowTheirWindows) {
  int damp = 0;
  for (uint64_t seed = 0; seed < 30; ++seed) {
    SceneBuilder builder("wear");
    const Surfaces surfaces = AddTestSurfaces(builder);
    MeshBuilder mesh;
    FacadeContext context{builder, surfaces, mesh, AddBalconyMesh(builder, surfaces), AddWindowBoxMesh(builder, surfaces)};
    context.reach = 0.6f;  // as in maps
    context.fall = [](Vec2f) { return -0.3f; };
    BuildingPlan plan;
    plan.outline = {{0, 0}, {17, 0}, {17, 12}, {0, 12}};
    plan.edges = {EdgeKind::kRear, EdgeKind::kParty, EdgeKind::kParty, EdgeKind::kParty};
    plan.party_height = {0, 1e3f, 1e3f, 1e3f};
    plan.style = FacadeStyle::kStuccoShutters;
    plan.seed = MixBits(seed);
    BuildFacades(context, plan, builder.AddEntity("house", builder.tree().At("construction/building")),
                 std::vector<FacadeDetail>(4, FacadeDetail::kSimple));
    const TestRays rays(mesh.Finish("house"));
    int before = 0;
    for (float x = 0.4f; x < 16.6f; x += 0.1f) {
      const auto hit = rays.First({x, -5, 0.4f}, {0, 1, 0}, 10);
      ASSERT_TRUE(hit);
      before += std::abs(hit->t - (5 - 0.6f * 0.008f)) < 1e-4f;
      const auto above = rays.First({x, -5, 1.05f}, {0, 1, 0}, 10);
      EXPECT_FALSE(above && std::abs(above->t - (5 - 0.6f * 0.008f)) < 1e-4f) << seed << " " << x;
    }
    damp += before > 60;
  }
  EXPECT_GE(damp, 18);
  EXPECT_LE(damp, 29);
}

// A street where all shutters are of one green is a street of one owner.
TEST(DressOf, OwnersPaintTheirShuttersEachInAColourOfTheirOwn) {
  std::map<Surface, int> shutters, frames;
  int same = 0;
  Surface last = Surface::kCount;
  for (uint64_t seed = 0; seed < 400; ++seed) {
    BuildingPlan plan;
    plan.style = FacadeStyle::kStuccoShutters;
    plan.palette = static_cast<int>(seed % 4);
    plan.seed = MixBits(seed);
    const Dress dress = DressOf(plan);
    ++shutters[dress.shutter], ++frames[dress.frame];
    same += dress.shutter == last;
    last = dress.shutter;
  }
  EXPECT_GE(shutters.size(), 7u);
  for (const auto& [surface, count] : shutters) EXPECT_LT(count, 110) << static_cast<int>(surface);
  EXPECT_LT(same, 80);  // of 400
  EXPECT_GE(frames.size(), 4u);
}

}  // namespace
}  // namespace airsim360

#include "airsim360/worlds/kit/drape.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "airsim360/worlds/kit/mesh_builder.h"
#include "airsim360/worlds/kit/test_mesh.h"

namespace airsim360 {
namespace {

std::vector<float> Lines(float from, float to, float step) {
  std::vector<float> lines;
  for (float x = from; x <= to + 1e-3f; x += step) lines.push_back(x);
  return lines;
}

Vec3f Hill(Vec2f p) {
  return {p.x + 2 * std::sin(0.11f * p.y), p.y + 1.5f * std::cos(0.09f * p.x), 5 * std::sin(0.07f * p.x) * std::cos(0.06f * p.y)};
}
Drape HillDrape() { return Drape(Lines(-40, 40, 4), Lines(-40, 40, 5), Hill); }

// A floor of one big quad, with a lifted stripe that crosses the lattice aslant, and a wall.
Mesh Flat() {
  MeshBuilder builder;
  builder.SetEntity(1);
  builder.Quad({-31, -29, 0}, {33, -29, 0}, {33, 30, 0}, {-31, 30, 0});
  builder.SetEntity(2);
  builder.Quad({-30, -20, 0.006f}, {-29, -20.5f, 0.006f}, {29, 21, 0.006f}, {28, 21.5f, 0.006f});
  builder.SetEntity(3);
  builder.Quad({-20, 3, 0}, {21, 7, 0}, {21, 7, 4}, {-20, 3, 4});
  return builder.Finish("flat");
}

TEST(Drape, PutsLatticePointsWhereTheGroundIs) {
  const Drape drape = HillDrape();
  for (float x = -36; x <= 36; x += 4)
    for (float y = -35; y <= 35; y += 5) EXPECT_LT(Norm(drape.At({x, y, 2.5f}) - (Hill({x, y}) + Vec3f{0, 0, 2.5f})), 1e-4f);
}

// An affine ground is reproduced everywhere, its frame too, beyond the lattice as well.
TEST(Drape, IsExactForAffineGround) {
  const auto plane = [](Vec2f p) { return Vec3f{3 + 2 * p.x - p.y, 1 + 0.5f * p.x + p.y, 0.3f * p.x - 0.2f * p.y}; };
  const Drape drape(Lines(0, 12, 3), Lines(0, 10, 2), plane);
  for (Vec2f p : {Vec2f{1.3f, 4.4f}, {7.7f, 9.9f}, {-5, 3}, {20, 40}}) {
    EXPECT_LT(Norm(drape.At({p.x, p.y, 0}) - plane(p)), 1e-3f);
    const AffineTransform frame = drape.Frame(p);
    EXPECT_NEAR(frame.A.m[2][0], 0.3f, 1e-5f);
    EXPECT_NEAR(frame.A.m[2][1], -0.2f, 1e-5f);
    EXPECT_NEAR(frame.A.m[0][0], 2, 1e-4f);
  }
}

TEST(Drape, KeepsEveryVertexItsHeightOverTheGround) {
  const Drape drape = HillDrape();
  const Mesh laid = drape.Lay(Flat());
  // The plan's point under a vertex, by fixed-point iteration.
  const auto plan_of = [&](Vec3f q) {
    Vec2f p{q.x, q.y};
    for (int i = 0; i < 60; ++i) {
      const Vec3f at = drape.At({p.x, p.y, 0});
      p = {p.x - (at.x - q.x), p.y - (at.y - q.y)};
    }
    return p;
  };
  internal::ForTriangles(laid, [&](const MeshPart& part, Vec3f a, Vec3f b, Vec3f c) {
    if (part.entity == 3) return;
    const float lift = part.entity == 2 ? 0.006f : 0.0f;
    for (Vec3f q : {a, b, c, (a + b + c) / 3.0f}) {
      const Vec2f p = plan_of(q);
      EXPECT_NEAR(q.z - drape.At({p.x, p.y, 0}).z, lift, 4e-4f);
    }
  });
}

// Pieces that meet share their corners: no vertex of a part is there twice.
TEST(Drape, KeepsEqualVerticesOnce) {
  const Mesh laid = HillDrape().Lay(Flat());
  for (const MeshPart& part : laid.parts) {
    std::set<uint32_t> vertices;
    std::set<std::array<float, 8>> different;
    for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
      const Vec3u t = laid.triangles[k];
      for (uint32_t v : {t.x, t.y, t.z}) {
        const Vec3f p = laid.positions[v], n = laid.normals[v];
        vertices.insert(v);
        different.insert({p.x, p.y, p.z, n.x, n.y, n.z, laid.uvs[v].x, laid.uvs[v].y});
      }
    }
    EXPECT_EQ(vertices.size(), different.size()) << part.entity;
  }
}

// Splitting loses nothing: under a map that only lifts, the floor's area seen from above stays.
TEST(Drape, CoversTheSameGround) {
  const Drape drape(Lines(-40, 40, 4), Lines(-40, 40, 5), [](Vec2f p) { return Vec3f{p.x, p.y, Hill(p).z}; });
  const Mesh laid = drape.Lay(Flat());
  std::map<EntityId, double> area;
  internal::ForTriangles(
      laid, [&](const MeshPart& part, Vec3f a, Vec3f b, Vec3f c) { area[part.entity] += static_cast<double>(Cross(b - a, c - a).z) / 2; });
  EXPECT_NEAR(area[1], 64.0 * 59, 0.02);
  EXPECT_NEAR(area[3], 0, 0.02);
  // The wall keeps its area over the plan: 4 m times its length.
  double wall = 0;
  internal::ForTriangles(laid, [&](const MeshPart& part, Vec3f a, Vec3f b, Vec3f c) {
    if (part.entity == 3) wall += static_cast<double>(std::hypot(Cross(b - a, c - a).x, Cross(b - a, c - a).y)) / 2;
  });
  EXPECT_NEAR(wall, 4 * std::hypot(41.0, 4.0), 0.05);
}

// Rays from above meet the floor everywhere, on the lines of the lattice, its diagonals and the quad's own diagonal too.
TEST(Drape, LeavesNoGap) {
  MeshBuilder builder;
  builder.SetEntity(1);
  builder.Quad({-31, -29, 0}, {33, -29, 0}, {33, 30, 0}, {-31, 30, 0});
  const Drape drape = HillDrape();
  const internal::TestRays rays(drape.Lay(builder.Finish("floor")), 0);
  int missed = 0, all = 0;
  const auto look = [&](Vec2f p) {
    const Vec3f at = drape.At({p.x, p.y, 20});
    const auto hit = rays.First(at, {0, 0, -1});
    ++all;
    missed += !hit || std::abs(hit->t - 20) > 1e-3f;
  };
  for (float s = 0.01f; s < 1; s += 0.0137f) {
    for (float x = -28; x <= 28; x += 4) look({x, -29 + 59 * s});
    for (float y = -25; y <= 25; y += 5) look({-31 + 64 * s, y});
    for (float k = -24; k <= 20; k += 4) look({k + 4 * s, -5 + 5 * s});
    look({-31 + 64 * s, -29 + 59 * s});
    for (float t = 0.05f; t < 1; t += 0.083f) look({-31 + 64 * s, -29 + 59 * t});
  }
  EXPECT_EQ(missed, 0) << "of " << all;
}

TEST(Drape, NormalsAreUnitAndFollowTheSlope) {
  const Mesh laid = HillDrape().Lay(Flat());
  EXPECT_EQ(internal::FaultOf(laid), "");
  internal::ForTriangles(laid, [&](const MeshPart& part, Vec3f a, Vec3f b, Vec3f c) {
    if (part.entity == 1 && Norm(Cross(b - a, c - a)) > 0.5f) {
      EXPECT_GT(Cross(b - a, c - a).z, 0);
    }
  });
  for (size_t i = 0; i < laid.normals.size(); ++i) EXPECT_NEAR(Norm(laid.normals[i]), 1, 1e-4f);
}

}  // namespace
}  // namespace airsim360

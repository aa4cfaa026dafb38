#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/assets/axes.h"
#include "airsim360/assets/imported.h"
#include "airsim360/assets/merge.h"
#include "airsim360/assets/normals.h"
#include "airsim360/assets/polygon.h"
#include "airsim360/base/random.h"

namespace airsim360::internal {
namespace {

TEST(Axes, ConversionsBetweenGAndWAreInverseOfEachOther) {
  RngStream random(1, "axes");
  for (int i = 0; i < 100; ++i) {
    const Vec3d v{random.Normal(), random.Normal(), random.Normal()};
    EXPECT_EQ(ToG(FromG(v)), v);
    const Mat3d A = RotationX(random.Normal()) * RotationY(random.Normal()) * RotationZ(random.Normal());
    EXPECT_EQ(ToG(FromG(A)), A);
    // A map and its converted twin do the same to a vector and its converted twin.
    const Vec3d a = FromG(A * v);
    const Vec3d b = FromG(A) * FromG(v);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-12);
  }
}

TEST(Axes, GIsTurnedAndNotMirrored) {
  EXPECT_EQ(FromG(Vec3d{0, 1, 0}), (Vec3d{0, 0, 1}));
  EXPECT_EQ(FromG(Vec3d{0, 0, 1}), (Vec3d{0, -1, 0}));
  EXPECT_EQ(Cross(FromG(Vec3d{1, 0, 0}), FromG(Vec3d{0, 1, 0})), FromG(Vec3d{0, 0, 1}));
}

double Area(const std::vector<Vec3f>& p, const std::vector<Vec3u>& triangles, Vec3f normal) {
  double sum = 0;
  for (Vec3u t : triangles) sum += 0.5 * Dot(Cross(p[t.y] - p[t.x], p[t.z] - p[t.x]), normal);
  return sum;
}

TEST(Polygon, TrianglesTileAConcavePolygonExactly) {
  // A "U" of 7 unit squares; signed areas add up to its own only if no triangle turns over or overlaps.
  const std::vector<Vec3f> u = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  const std::vector<Vec3u> triangles = TriangulateFace(u);
  EXPECT_EQ(triangles.size(), 6u);
  EXPECT_NEAR(Area(u, triangles, {0, 0, 1}), 7, 1e-6);
  for (Vec3u t : triangles) EXPECT_GT(Dot(Cross(u[t.y] - u[t.x], u[t.z] - u[t.x]), Vec3f{0, 0, 1}), 0);
}

TEST(Polygon, DegenerateAndHugePolygonsStillGiveAFan) {
  EXPECT_TRUE(TriangulateFace(std::vector<Vec3f>(2)).empty());
  EXPECT_EQ(TriangulateFace(std::vector<Vec3f>(5)).size(), 3u);
  EXPECT_EQ(TriangulateFace(std::vector<Vec3f>(100000)).size(), 99998u);
}

Mesh Cube() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back({float(i & 1), float((i >> 1) & 1), float(i >> 2)});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  mesh.parts = {{0, 12, 0, kNoEntity}};
  return mesh;
}

TEST(Normals, CubeStaysFlatBelowItsEdgeAngleAndRoundAboveIt) {
  Mesh flat = Cube();
  FillMissingNormals(flat, 40);
  EXPECT_EQ(flat.positions.size(), 24u);
  for (Vec3f n : flat.normals) EXPECT_NEAR(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1, 1e-6);

  // All faces join: angle weights make the corner normals the diagonals although faces are cut in two
  // unevenly.
  Mesh round = Cube();
  FillMissingNormals(round, 100);
  EXPECT_EQ(round.positions.size(), 8u);
  for (size_t i = 0; i < 8; ++i) {
    const Vec3f outward = Normalized(round.positions[i] - Vec3f{0.5f, 0.5f, 0.5f});
    EXPECT_NEAR(Dot(round.normals[i], outward), 1, 1e-5);
  }
}

TEST(Normals, GivenNormalsAreKeptAndOnlyHolesAreFilled) {
  Mesh mesh = Cube();
  mesh.normals.assign(8, Vec3f{0, 0, 2});
  mesh.normals[7] = {NAN, 0, 0};
  FillMissingNormals(mesh);
  EXPECT_EQ(mesh.normals[0], (Vec3f{0, 0, 1}));
  EXPECT_EQ(mesh.positions.size(), 10u);  // the corner that lacked one has three flat faces
}

TEST(Merge, MirroredMeshesTurnTheirTriangles) {
  Mesh mesh = Cube();
  FillMissingNormals(mesh);
  AffineTransform X;
  X.A.m = {{{-2, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  TransformMesh(mesh, X);
  for (Vec3u t : mesh.triangles) {
    const Vec3f face = Normalized(Cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
    EXPECT_NEAR(Dot(face, mesh.normals[t.x]), 1, 1e-5);
  }
}

TEST(CleanName, GivesValidTextOfBoundedLength) {
  EXPECT_EQ(CleanName("  caf\xe9\n"), "caf\xc3\xa9");
  EXPECT_EQ(CleanName("caf\xc3\xa9"), "caf\xc3\xa9");
  EXPECT_EQ(CleanName(std::string("a\0b", 3)), "a b");
  EXPECT_LE(CleanName(std::string(1000, 'x')).size(), 120u);
}

}  // namespace
}  // namespace airsim360::internal

#include "airsim360/planning/clearance_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

struct Triangle {
  Vec3d a, b, c;
};

std::vector<Triangle> RandomTriangles(uint64_t seed, int count) {
  RngStream rng(seed, "triangles");
  std::vector<Triangle> triangles;
  for (int i = 0; i < count; ++i) {
    const double size = std::exp(rng.Uniform(-4, 2));
    const Vec3d a{rng.Uniform(-2, 14), rng.Uniform(-2, 12), rng.Uniform(-2, 10)};
    const auto near = [&] { return a + Vec3d{rng.Uniform(-size, size), rng.Uniform(-size, size), rng.Uniform(-size, size)}; };
    triangles.push_back({a, near(), near()});
  }
  return triangles;
}

Vec3d PointOf(const Triangle& t, RngStream& rng) {
  double u = rng.Uniform(), v = rng.Uniform();
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return t.a + (t.b - t.a) * u + (t.c - t.a) * v;
}

ClearanceField FieldOf(const std::vector<Triangle>& triangles, double voxel) {
  ClearanceFieldBuilder builder({{0, 0, 0}, {12, 10, 8}}, voxel);
  ParallelFor(static_cast<int64_t>(triangles.size()), [&](int64_t i) { builder.Add(triangles[i].a, triangles[i].b, triangles[i].c); });
  return builder.Build();
}

TEST(ClearanceField, EveryPointOfATriangleIsInAnOccupiedVoxel) {
  const auto triangles = RandomTriangles(1, 80);
  const ClearanceField field = FieldOf(triangles, 0.25);
  RngStream rng(2, "points");
  for (const Triangle& t : triangles) {
    for (int i = 0; i < 300; ++i) {
      const Vec3d p = PointOf(t, rng);
      EXPECT_TRUE(field.Occupied(p) || !field.box().Contains(p));
    }
  }
}

TEST(ClearanceField, IsNeverAboveTheDistanceAndAtMostAFewVoxelsBelow) {
  const auto triangles = RandomTriangles(3, 12);
  const double voxel = 0.25;
  const ClearanceField field = FieldOf(triangles, voxel);
  // Dense points of the triangles inside the box: distances to them are upper bounds of the distance.
  RngStream rng(4, "points");
  std::vector<Vec3d> surface;
  for (const Triangle& t : triangles) {
    for (int i = 0; i < 4000; ++i) {
      const Vec3d p = PointOf(t, rng);
      if (field.box().Contains(p)) surface.push_back(p);
    }
  }
  ASSERT_GT(surface.size(), 1000u);
  int close = 0, all = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3d p{rng.Uniform(0, 12), rng.Uniform(0, 10), rng.Uniform(0, 8)};
    double distance = 1e9;
    for (const Vec3d& q : surface) distance = std::min(distance, Norm(p - q));
    EXPECT_LE(field.At(p), distance);
    if (distance < 20 * voxel) {
      ++all;
      // Two diagonals, the steps of a bound, and squares that a triangle only nearly touches.
      close += field.At(p) > distance - 4.5 * voxel - 0.3;
    }
  }
  EXPECT_GT(close, 0.98 * all);
}

TEST(ClearanceField, OfOneVoxelIsTheDistanceBetweenBoxes) {
  ClearanceFieldBuilder builder({{0, 0, 0}, {10, 10, 10}}, 1);
  builder.Add({5.5, 5.5, 5.5}, {5.6, 5.5, 5.5}, {5.5, 5.6, 5.5});
  const ClearanceField field = builder.Build();
  EXPECT_EQ(field.At(Vec3d{5.5, 5.5, 5.5}), 0);
  EXPECT_EQ(field.At(Vec3d{4.5, 5.5, 5.5}), 0);
  EXPECT_EQ(field.At(Vec3d{2.5, 5.5, 5.5}), 2);
  EXPECT_EQ(field.At(Vec3d{2.5, 1.5, 5.5}), std::floor(4 * std::sqrt(4 + 9)) / 4);
  EXPECT_EQ(field.At(Vec3d{-1, 5, 5}), 0);
  EXPECT_EQ(field.TopOfColumn(5, 5), 6);
  EXPECT_EQ(field.BottomOfColumn(5, 5), 5);
  EXPECT_EQ(field.TopOfColumn(4, 5), 0);
}

TEST(ClearanceField, BoxesMarkWhatTheyTouch) {
  ClearanceFieldBuilder builder({{0, 0, 0}, {4, 4, 4}}, 1);
  builder.Add(Box3d{{1.5, 1.2, -3}, {2.5, 1.4, 0.5}});
  builder.Add(Box3d{{7, 7, 7}, {9, 9, 9}});
  const ClearanceField field = builder.Build();
  int occupied = 0;
  for (int z = 0; z < 4; ++z) {
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 4; ++x) occupied += field.Occupied(x, y, z);
    }
  }
  EXPECT_EQ(occupied, 2);
  EXPECT_TRUE(field.Occupied(1, 1, 0) && field.Occupied(2, 1, 0));
}

TEST(ClearanceField, DoesNotDependOnTheNumberOfThreads) {
  const auto triangles = RandomTriangles(5, 200);
  const ClearanceField many = FieldOf(triangles, 0.2);
  const ThreadLimit limit(1);
  const ClearanceField one = FieldOf(triangles, 0.2);
  for (int z = 0; z < one.size(2); ++z) {
    for (int y = 0; y < one.size(1); ++y) {
      for (int x = 0; x < one.size(0); ++x) ASSERT_EQ(one.At(x, y, z), many.At(x, y, z));
    }
  }
}

TEST(ClearanceField, RefusesBoxesWithoutSizeOrWithTooManyVoxels) {
  EXPECT_THROW(ClearanceFieldBuilder({{0, 0, 0}, {0, 1, 1}}, 0.5), InputError);
  EXPECT_THROW(ClearanceFieldBuilder({{0, 0, 0}, {1e4, 1e4, 1e4}}, 0.1), InputError);
  EXPECT_THROW(ClearanceFieldBuilder({{0, 0, 0}, {1, 1, 1}}, 0), InputError);
}

}  // namespace
}  // namespace airsim360

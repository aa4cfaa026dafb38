#include "airsim360/worlds/city_park/layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "airsim360/base/random.h"
#include "airsim360/worlds/city_park/noise.h"
#include "airsim360/worlds/city_park/park.h"
#include "airsim360/worlds/city_park/road_parts.h"
#include "airsim360/worlds/vegetation/park_trees.h"

namespace airsim360::internal::park {
namespace {

TEST(Fractal, IsTheSumOfItsOctavesOfNoise) {
  RngStream rng(3, "fractal test");
  for (int i = 0; i < 20000; ++i) {
    const float x0 = static_cast<float>(rng.Uniform(-300, 300)), y0 = static_cast<float>(rng.Uniform(-300, 300));
    const int octaves = 1 + i % 4, seed = i % 97;
    float x = x0, y = y0, sum = 0, weight = 0.5f, total = 0;
    for (int k = 0; k < octaves; ++k) {
      sum += weight * Noise(x, y, seed + 7 * k);
      total += weight;
      weight *= 0.5f;
      const float t = 1.6f * x - 1.2f * y + 3.1f;
      y = 1.2f * x + 1.6f * y + 1.7f;
      x = t;
    }
    ASSERT_EQ(Fractal(x0, y0, octaves, seed), sum / total) << x0 << " " << y0 << " " << octaves;
  }
}

// Whatever is skipped, the distance is that of the nearest of all segments.
TEST(Curve, DistanceIsTheLeastOfAllSegments) {
  const Layout layout;
  const std::vector<Vec2f>& points = layout.main().points();
  RngStream rng(4, "curve test");
  for (int i = 0; i < 2000; ++i) {
    const double reach = i % 2 ? 60 : 900;
    const Vec2f p{static_cast<float>(rng.Uniform(-reach, reach)), static_cast<float>(rng.Uniform(-reach, reach))};
    float least = 1e9f;
    for (size_t k = 0; k + 1 < points.size(); ++k) {
      const Vec2f v = points[k + 1] - points[k], w = p - points[k];
      const Vec2f d = w - v * std::clamp((w.x * v.x + w.y * v.y) / (v.x * v.x + v.y * v.y), 0.0f, 1.0f);
      least = std::min(least, std::sqrt(d.x * d.x + d.y * d.y));
    }
    ASSERT_EQ(layout.main().Distance(p), least) << p.x << " " << p.y;
    ASSERT_EQ(layout.main().Find(p).distance, least) << p.x << " " << p.y;
  }
}

TEST(Curve, FindsThePointThatAtCameFrom) {
  const Layout layout;
  const Curve& road = layout.main();
  for (float s = 20; s < road.length() - 20; s += 37.3f) {
    for (float side : {-6.0f, -0.5f, 3.0f}) {
      const Curve::Nearest found = road.Find(road.At(s, side));
      EXPECT_NEAR(found.side, side, 0.05f);
      EXPECT_NEAR(found.s, s, 0.3f);
    }
  }
}

TEST(Curve, DistanceAgreesWithASearchOverAllPoints) {
  const Layout layout;
  RngStream rng(1, "points");
  for (int i = 0; i < 200; ++i) {
    const Vec2f p{static_cast<float>(rng.Uniform(-600, 600)), static_cast<float>(rng.Uniform(-600, 600))};
    for (const Curve& path : layout.paths()) {
      float nearest = 1e9f;
      for (Vec2f q : path.points()) nearest = std::min(nearest, std::hypot(p.x - q.x, p.y - q.y));
      // Points are about a metre apart.
      EXPECT_NEAR(path.Distance(p), nearest, 1.0f);
      EXPECT_LE(path.Distance(p), nearest + 1e-3f);
      EXPECT_NEAR(path.Distance(p), path.Find(p).distance, 1e-3f);
    }
  }
}

TEST(Layout, ShortCutsFarFromRoadsNeverClaimMoreThanTheDistance) {
  const Layout layout;
  RngStream rng(2, "points");
  for (int i = 0; i < 3000; ++i) {
    const Vec2f p{static_cast<float>(rng.Uniform(-900, 900)), static_cast<float>(rng.Uniform(-900, 900))};
    float exact = layout.main().Find(p).distance - kMainHalf - kVergeEnd;
    for (const Curve& side : layout.side_roads()) exact = std::min(exact, side.Find(p).distance - kSideHalf - kVergeEnd);
    const float beyond = layout.BeyondRoad(p);
    EXPECT_LE(beyond, exact + 1e-2f);
    if (exact < 40) {
      EXPECT_NEAR(beyond, exact, 1e-2f);
    } else {
      EXPECT_GE(beyond, 40 - 1e-2f);
    }
  }
}

TEST(Layout, LakeIsABasinAndPavementsLieOverTheGround) {
  const Layout layout;
  for (float y = 56; y < 114; y += 1.7f) {
    for (float x = -86; x < 2; x += 1.9f) {
      const Vec2f p{x, y};
      if (layout.Lake(p) < 0.9f && layout.Island(p) < 0.05f) {
        EXPECT_LT(layout.Ground(p), kLakeZ);
      }
      if (layout.Lake(p) > 1.08f) {
        EXPECT_GT(layout.Ground(p), kLakeZ);
      }
    }
  }
  for (float s = 50; s < layout.main().length() - 50; s += 3.1f) {
    for (float d : {-10.5f, -3.0f, 0.0f, 6.9f, 10.5f}) {
      const Vec2f p = layout.main().At(s, d);
      EXPECT_LT(layout.Ground(p), layout.Base(p));
    }
  }
}

TEST(KerbLines, NeverStandOnACarriageway) {
  const Layout layout;
  const std::vector<KerbLine> lines = KerbLines(layout);
  EXPECT_EQ(lines.size(), 2 + 2 * layout.junctions().size());
  for (const KerbLine& kerb : lines) {
    for (Vec2f p : kerb.line.points()) {
      EXPECT_GT(layout.main().Distance(p), kMainHalf - 0.05f) << p.x << " " << p.y;
      for (const Curve& side : layout.side_roads()) EXPECT_GT(side.Distance(p), kSideHalf - 0.05f) << p.x << " " << p.y;
    }
  }
}

// Every inner edge of the ground is shared by exactly two triangles of opposite direction: no gaps between
// cells of different size.
TEST(Terrain, IsWatertight) {
  SceneBuilder builder("ground");
  const Layout layout;
  const Surfaces surfaces;
  const MaterialId plain = builder.AddMaterial({});
  ParkMaterials materials;
  materials.ground = {plain, plain, plain};
  const Lawns lawns(builder, layout);
  PropShelf shelf(builder, nullptr, 0);
  Occupancy occupancy;
  Placer placer(shelf, occupancy, 0);
  Park park{builder, surfaces, materials, layout, lawns, occupancy, placer, 0};
  const size_t triangles = LayTerrain(park);
  EXPECT_LT(triangles, 1'500'000u);
  const auto scene = builder.Build();
  using Corner = std::pair<float, float>;
  std::map<std::pair<Corner, Corner>, int> open;
  size_t down = 0;
  for (const Mesh& mesh : scene->meshes) {
    for (Vec3u t : mesh.triangles) {
      const Vec3f p[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
      down += Cross(p[1] - p[0], p[2] - p[0]).z <= 0;
      for (int k = 0; k < 3; ++k) {
        const Corner a{p[k].x, p[k].y}, b{p[(k + 1) % 3].x, p[(k + 1) % 3].y};
        if (const auto it = open.find({b, a}); it != open.end()) {
          open.erase(it);
        } else {
          EXPECT_EQ(++open[(std::pair{a, b})], 1);
        }
      }
    }
  }
  EXPECT_EQ(down, 0u);
  const float rim = kGroundSquares.back();
  for (const auto& [edge, count] : open) {
    const auto on_rim = [&](Corner c) { return std::max(std::abs(c.first), std::abs(c.second)) == rim; };
    ASSERT_TRUE(on_rim(edge.first) && on_rim(edge.second)) << edge.first.first << " " << edge.first.second;
  }
}

TEST(ParkTrees, KeepTheirShapeWithFewerTriangles) {
  for (int i = 0; i < static_cast<int>(ParkTree::kCount); ++i) {
    const auto species = static_cast<ParkTree>(i);
    const Model full = MakeParkTree(species, TreeDetail::kFull, 0, 1), middle = MakeParkTree(species, TreeDetail::kMiddle, 0, 1),
                far = MakeParkTree(species, TreeDetail::kFar, 0, 1);
    const auto name = InfoOf(species).name;
    EXPECT_GE(full.mesh.triangles.size(), 50'000u) << name;
    EXPECT_LE(full.mesh.triangles.size(), 420'000u) << name;
    EXPECT_LE(middle.mesh.triangles.size(), 40'000u) << name;
    EXPECT_LE(far.mesh.triangles.size(), 9'000u) << name;
    EXPECT_TRUE(SemanticTree().Find(InfoOf(species).category)) << name;
    for (const Model* model : {&full, &middle, &far}) {
      const Box3f box = model->mesh.Bounds();
      EXPECT_GT(box.max.z, 8) << name;
      EXPECT_LT(box.max.z, 21) << name;
      EXPECT_GT(box.min.z, -0.4f) << name;
    }
  }
}

}  // namespace
}  // namespace airsim360::internal::park

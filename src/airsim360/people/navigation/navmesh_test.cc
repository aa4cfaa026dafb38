#include "airsim360/people/navigation/navmesh.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "airsim360/base/disk_cache.h"
#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/people/navigation/nav_graph.h"
#include "airsim360/people/navigation/polygon2d.h"
#include "airsim360/people/navigation/test_ground.h"

namespace airsim360 {
namespace {

using internal::NavGraph;
using internal::NavPolygon;
using internal::TestGround;
constexpr uint32_t kAll = ~0u;

TEST(NavMesh, AnEmptySquareIsWalkableUpToTheRadiusOfAPerson) {
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, 60, 40);  // several tiles
  const auto mesh = NavMesh::Build(*ground.Build());
  EXPECT_NEAR(mesh->AreaOf({}, kAll).square_metres, 59.5 * 39.5, 25);
  EXPECT_TRUE(mesh->Nearest({30, 20, 0}, 0.1).valid());
  EXPECT_FALSE(mesh->Nearest({-1, 20, 0}, 0.5).valid());
}

TEST(NavMesh, AWayGoesAroundAWallAndIsAsLongAsTheTautString) {
  TestGround ground;
  ground.Floor("ground/floor", 0, 0, 40, 40);
  ground.Wall(20, -1, 20, 30);
  const auto mesh = NavMesh::Build(*ground.Build());
  const NavPath path = mesh->FindPath(mesh->Nearest({10, 10, 0}), mesh->Nearest({30, 10, 0}));
  ASSERT_TRUE(path.complete);
  // Around the end of the wall, which is 0.35 m away from its axis and 0.35 m beyond its end.
  const double expected = 2 * std::hypot(10 - 0.35, 20.35) + 0.7;
  EXPECT_NEAR(path.length, expected, 0.5);
  EXPECT_FALSE(mesh->Straight(mesh->Nearest({10, 10, 0}), {30, 10}));
  EXPECT_TRUE(mesh->Straight(mesh->Nearest({10, 10, 0}), {10, 39}));
}

// A slope of many small pieces of lawn and path, none along the raster: to be crossed in all directions, without a slit or a hole.
TEST(NavMesh, KindsOfGroundThatMeetLeaveNothingBetweenThem) {
  TestGround ground;
  constexpr int kPieces = 130;
  constexpr float kSize = 0.31f;
  for (const char* category : {"ground/grass", "ground/path"}) {
    Mesh mosaic;
    for (int i = 0; i < kPieces * kPieces; ++i) {
      const bool lawn = RngStream(5, "mosaic", static_cast<uint64_t>(i)).Chance(0.6);
      if (lawn != (std::string_view(category) == "ground/grass")) continue;
      const auto first = static_cast<uint32_t>(mosaic.positions.size());
      for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        const float a = kSize * static_cast<float>(i % kPieces + u), b = kSize * static_cast<float>(i / kPieces + v);
        const float x = 0.87f * a - 0.49f * b, y = 0.49f * a + 0.87f * b;
        mosaic.positions.push_back({x, y, 0.2f * x + 0.1f * y});
      }
      mosaic.triangles.push_back({first, first + 1, first + 2});
      mosaic.triangles.push_back({first, first + 2, first + 3});
    }
    const EntityId entity = ground.builder().AddEntity(category, ground.builder().tree().At(category));
    ground.builder().AddInstance({.mesh = ground.builder().AddMesh(std::move(mosaic)), .X_WM = {}, .entity = entity});
  }
  const auto mesh = NavMesh::Build(*ground.Build());
  // Metres from the edge of the whole.
  const auto inside = [&](Vec2d p) {
    const double a = 0.87 * p.x + 0.49 * p.y, b = 0.87 * p.y - 0.49 * p.x, edge = kPieces * kSize;
    return std::min({a, b, edge - a, edge - b});
  };
  for (const NavWall& wall : mesh->walls())
    EXPECT_LT(inside((wall.a + wall.b) * 0.5), 0.6) << wall.a.x << ' ' << wall.a.y << ' ' << wall.b.x << ' ' << wall.b.y;
  const NavArea all = mesh->AreaOf({}, kAll);
  RngStream rng(6, "ways");
  for (int k = 0; k < 300; ++k) {
    const NavPoint from = mesh->Pick(all, rng), to = mesh->Pick(all, rng);
    const Vec2d p{to.p_W.x, to.p_W.y};
    if (std::min(inside({from.p_W.x, from.p_W.y}), inside(p)) < 0.6) continue;
    const NavPoint end = mesh->Move(from, p);
    EXPECT_LT(std::hypot(end.p_W.x - p.x, end.p_W.y - p.y), 0.01) << from.p_W.x << ' ' << from.p_W.y << " to " << p.x << ' ' << p.y;
  }
}

// A lawn's blades are part of the lawn, whatever they rise to: feet go through them.
TEST(NavMesh, BladesOfALawnAreNeitherGroundNorObstacle) {
  TestGround ground;
  const EntityId lawn = ground.Floor("ground/grass", 0, 0, 30, 30);
  Mesh blades;
  for (int i = 0; i < 400; ++i) {
    const auto first = static_cast<uint32_t>(blades.positions.size());
    const Vec3f p{15 + 0.01f * static_cast<float>(i % 20), 0.075f * static_cast<float>(i), 0};
    blades.positions.insert(blades.positions.end(), {p, p + Vec3f{0, 0.1f, 0}, p + Vec3f{0, 0.05f, 1.2f}});
    blades.triangles.push_back({first, first + 1, first + 2});
  }
  Material grass;
  grass.kind = SurfaceKind::kFoliage;
  blades.parts = {{0, static_cast<uint32_t>(blades.triangles.size()), ground.builder().AddMaterial(grass), kNoEntity}};
  ground.builder().AddInstance({.mesh = ground.builder().AddMesh(std::move(blades)), .X_WM = {}, .entity = lawn});
  const auto mesh = NavMesh::Build(*ground.Build());
  EXPECT_TRUE(mesh->Straight(mesh->Nearest({5, 15, 0}), {25, 15}));
  EXPECT_NEAR(mesh->Nearest({15.1, 15, 0}).p_W.z, 0, 0.05);
}

// What one search cannot see takes several, and is hardly longer.
TEST(NavMesh, LongWaysTakeSeveralSearches) {
  TestGround ground;
  ground.Floor("ground/pavement", 0, 0, 120, 60);
  for (float x = 6; x < 118; x += 8)
    for (float y = 3; y < 58; y += 6) ground.Box("construction/wall", {x, y + (x > 60 ? 1.5f : 0), 0}, {x + 5, y + (x > 60 ? 4.5f : 3), 3});
  const auto scene = ground.Build();
  const auto whole = NavMesh::Build(*scene), parts = NavMesh::Build(*scene, {.search_nodes = 200});
  ASSERT_GT(whole->polygon_count(), 300u);
  RngStream rng(4, "ways");
  const NavArea everywhere = whole->AreaOf({}, kAll);
  double longest = 0;
  for (int i = 0; i < 200; ++i) {
    const NavPoint a = whole->Pick(everywhere, rng), b = whole->Pick(everywhere, rng);
    const NavPath direct = whole->FindPath(a, b), joined = parts->FindPath(a, b);
    ASSERT_TRUE(direct.complete && joined.complete) << i;
    EXPECT_LE(joined.length, 1.6 * direct.length + 2) << i;
    longest = std::max(longest, direct.length);
    for (size_t k = 1; k < joined.corners.size(); ++k) {
      const Vec3d from = joined.corners[k - 1], step = joined.corners[k] - from;
      for (double t = 0; t < 1; t += 0.25 / std::max(0.25, Norm(step))) EXPECT_TRUE(parts->Nearest(from + step * t, 0.1).valid()) << i;
    }
  }
  EXPECT_GT(longest, 80);
}

// Where the ground is steep a corner of a polygon can be there twice, one above the other. City Park has seven such.
TEST(NavMesh, NoWallIsWithoutLength) {
  NavPolygon polygon{};
  polygon.corners = 5;
  const Vec2d corners[] = {{0, 0}, {4, 0}, {4, 0}, {4, 3}, {0, 3}};
  const float heights[] = {0, 0, 1, 1, 0};
  std::copy(std::begin(corners), std::end(corners), polygon.corner);
  std::copy(std::begin(heights), std::end(heights), polygon.z);
  NavGraph graph;
  graph.polygons = {polygon};
  graph.Finish();
  ASSERT_EQ(graph.walls.size(), 4u);
  double around = 0;
  for (const NavWall& wall : graph.walls) {
    EXPECT_GT(std::hypot(wall.b.x - wall.a.x, wall.b.y - wall.a.y), 2.9);
    around += std::hypot(wall.b.x - wall.a.x, wall.b.y - wall.a.y);
  }
  EXPECT_NEAR(around, 14, 1e-9);
}

// Somebody in Rome stood 12 mm outside of a polygon for a minute and a half: whoever starts to walk makes shorter steps.
TEST(NavMesh, ShortStepsLeadBackFromOutsideOfAPolygon) {
  NavPolygon polygon{};
  polygon.corners = 4;
  const Vec2d corners[] = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  std::copy(std::begin(corners), std::end(corners), polygon.corner);
  std::fill(std::begin(polygon.z), std::end(polygon.z), 0.0f);
  NavGraph graph;
  graph.polygons = {polygon};
  graph.Finish();
  Vec2d p{2, -0.0125};
  for (int step = 0; step < 10; ++step) {
    const NavPoint next = graph.Walk(0, p, {p.x + 0.003, p.y + 0.01}, true, nullptr);
    p = {next.p_W.x, next.p_W.y};
  }
  EXPECT_NEAR(p.x, 2.03, 1e-5);
  EXPECT_NEAR(p.y, 0.09, 1e-4);
}

TEST(NavMesh, NobodyMovesThroughWalls) {
  TestGround ground;
  ground.Floor("ground/floor", 0, 0, 30, 30);
  ground.Box("vehicle/car", {10, 10, 0}, {14, 12, 1.5f});
  const auto mesh = NavMesh::Build(*ground.Build());
  RngStream rng(1, "moves");
  NavPoint p = mesh->Nearest({5, 5, 0});
  for (int i = 0; i < 20000; ++i) {
    const Vec2d target{p.p_W.x + rng.Uniform(-3, 3), p.p_W.y + rng.Uniform(-3, 3)};
    const NavPoint q = mesh->Move(p, target);
    const bool in_car = q.p_W.x > 9.85 && q.p_W.x < 14.15 && q.p_W.y > 9.85 && q.p_W.y < 12.15;
    ASSERT_FALSE(in_car) << q.p_W.x << " " << q.p_W.y;
    ASSERT_TRUE(q.p_W.x > 0.1 && q.p_W.x < 29.9 && q.p_W.y > 0.1 && q.p_W.y < 29.9);
    // What says that a line is free agrees with where the move ends.
    if (mesh->Straight(p, target)) {
      ASSERT_NEAR(std::hypot(q.p_W.x - target.x, q.p_W.y - target.y), 0, 1e-6);
    }
    p = q;
  }
}

TEST(NavMesh, CrossingsAreTakenBeforeRoads) {
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, 60, 6);
  ground.Floor("ground/road", 0, 6, 60, 14, -0.12f);
  ground.Floor("ground/sidewalk", 0, 14, 60, 20);
  ground.Floor("ground/crosswalk", 24, 6, 28, 14, -0.115f);
  const auto mesh = NavMesh::Build(*ground.Build());
  const NavPath path = mesh->FindPath(mesh->Nearest({8, 3, 0}), mesh->Nearest({8, 17, 0}));
  ASSERT_TRUE(path.complete);
  double farthest = 0;
  for (const Vec3d& corner : path.corners) farthest = std::max(farthest, corner.x);
  EXPECT_GT(farthest, 23.5);
  EXPECT_GE(mesh->CrossingAt({26, 10}), 0);
  EXPECT_EQ(mesh->CrossingAt({10, 10}), -1);
  EXPECT_EQ(mesh->Kind(mesh->Nearest({26, 10, -0.1})), GroundKind::kCrossing);
  EXPECT_EQ(mesh->Kind(mesh->Nearest({40, 10, -0.1})), GroundKind::kRoad);
  EXPECT_NEAR(mesh->GroundHeight(26, 10, 0), -0.115, 1e-4);
  EXPECT_NEAR(mesh->GroundHeight(40, 10, 0), -0.12, 1e-4);
}

TEST(NavMesh, StairsAndSlopesAreWalkedAndCliffsAreNot) {
  TestGround ground;
  ground.Floor("ground/floor", 0, 0, 10, 10);
  for (int i = 0; i < 10; ++i)  // 17 cm by 30 cm
    ground.Box("construction/stairs", {10 + 0.3f * static_cast<float>(i), 0, -1}, {13, 4, 0.17f * static_cast<float>(i + 1)});
  ground.Floor("ground/floor", 13, 0, 23, 10, 1.7f);
  const auto mesh = NavMesh::Build(*ground.Build());
  const NavPath path = mesh->FindPath(mesh->Nearest({5, 8, 0}), mesh->Nearest({20, 8, 1.7}));
  ASSERT_TRUE(path.complete);
  EXPECT_GT(path.length, 17);  // by the stairs, not up the edge of the upper floor
  EXPECT_NEAR(mesh->GroundHeight(11.4, 2, 0.8), 0.85, 0.01);

  TestGround steep;
  steep.Floor("ground/terrain", 0, 0, 10, 10);
  steep.Sheet("ground/terrain", {10, 0, 0}, {14, 0, 2.0f}, {14, 10, 2.0f}, {10, 10, 0});  // 27 degrees
  steep.Floor("ground/terrain", 14, 0, 20, 10, 2);
  steep.Sheet("ground/terrain", {0, 10, 0}, {10, 10, 0}, {10, 13, 4}, {0, 13, 4});  // 53 degrees
  steep.Floor("ground/terrain", 0, 13, 10, 20, 4);
  const auto hill = NavMesh::Build(*steep.Build());
  EXPECT_TRUE(hill->FindPath(hill->Nearest({5, 5, 0}), hill->Nearest({18, 5, 2})).complete);
  EXPECT_NE(hill->Component(hill->Nearest({5, 5, 0})), hill->Component(hill->Nearest({5, 17, 4})));
  EXPECT_NEAR(hill->GroundHeight(12, 5, 1), 1.0, 1e-4);
}

TEST(NavMesh, PlacesAreDrawnInsideAnAreaAndEvenly) {
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, 40, 40);
  const auto mesh = NavMesh::Build(*ground.Build());
  const std::vector<Vec2d> outline = {{5, 5}, {25, 5}, {15, 30}};
  const NavArea area = mesh->AreaOf(outline, kAll);
  EXPECT_NEAR(area.square_metres, 250, 5);
  RngStream rng(3, "draw");
  int left = 0;
  for (int i = 0; i < 2000; ++i) {
    const NavPoint p = mesh->Pick(area, rng);
    ASSERT_TRUE(p.valid());
    ASSERT_TRUE(InPolygon(outline, {p.p_W.x, p.p_W.y}));
    left += p.p_W.x < 15;
  }
  EXPECT_NEAR(left, 1000, 100);
}

TEST(NavMesh, OpenShareIsOneInTheOpenAndAHalfAtAWall) {
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, 20, 20);
  const auto mesh = NavMesh::Build(*ground.Build());
  EXPECT_NEAR(mesh->OpenShare({10, 10}), 1, 0.02);
  EXPECT_NEAR(mesh->OpenShare({0.25, 10}), 0.6, 0.12);
}

TEST(NavMesh, IsTheSameWithOneThreadAndMany) {
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, 100, 60);
  for (int i = 0; i < 40; ++i) {
    const auto x = static_cast<float>(7 * i % 90 + 3), y = static_cast<float>(11 * i % 50 + 3);
    ground.Box("furniture/box", {x, y, 0}, {x + 1.5f, y + 1, 1});
  }
  const auto scene = ground.Build();
  const auto corners = [&] {
    const auto mesh = NavMesh::Build(*scene);
    std::vector<double> numbers;
    for (uint32_t i = 0; i < mesh->polygon_count(); ++i)
      for (const Vec3d& p : mesh->PolygonOutline(i)) numbers.insert(numbers.end(), {p.x, p.y, p.z});
    return numbers;
  };
  const std::vector<double> many = corners();
  const ThreadLimit one(1);
  EXPECT_EQ(many, corners());
}

TEST(NavMesh, ComesBackFromTheDiskAsItWasBuiltAndIsBuiltAnewWhereTheFileIsDamaged) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / ("navmesh_" + std::to_string(::getpid()));
  const DiskCache cache(folder);
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, 60, 40);
  ground.Floor("ground/crosswalk", 20, 10, 24, 18, 0.01f);
  ground.Box("furniture/box", {30, 10, 0}, {33, 20, 1});
  const auto scene = WithCacheKey(ground.Build(), "a scene");
  const auto everything = [&](const NavMesh& mesh) {
    std::vector<double> numbers;
    for (uint32_t i = 0; i < mesh.polygon_count(); ++i)
      for (const Vec3d& p : mesh.PolygonOutline(i)) numbers.insert(numbers.end(), {p.x, p.y, p.z});
    for (double x = 0.1; x < 60; x += 0.7)
      for (double y = 0.1; y < 40; y += 0.7) numbers.insert(numbers.end(), {mesh.GroundHeight(x, y, 0.1), mesh.OpenShare({x, y})});
    const NavPath path = mesh.FindPath(mesh.Nearest({5, 15, 0}), mesh.Nearest({55, 15, 0}));
    numbers.push_back(path.length);
    numbers.push_back(static_cast<double>(mesh.CrossingAt({22, 12})));
    return numbers;
  };
  const auto files = [&] {
    std::vector<std::filesystem::path> found;
    if (std::filesystem::exists(folder))
      for (const auto& file : std::filesystem::directory_iterator(folder)) found.push_back(file.path());
    return found;
  };
  const std::vector<double> built = everything(*NavMesh::Build(*scene, {}, cache));
  ASSERT_EQ(files().size(), 1u);
  EXPECT_EQ(everything(*NavMesh::Build(*scene, {}, cache)), built);
  ASSERT_EQ(files().size(), 1u);

  // Cut off: built again.
  std::filesystem::resize_file(files()[0], std::filesystem::file_size(files()[0]) / 2);
  EXPECT_EQ(everything(*NavMesh::Build(*scene, {}, cache)), built);

  // Another mesh has another file; a scene without a key has none.
  NavMeshOptions wide;
  wide.person_radius = 0.5;
  EXPECT_NE(everything(*NavMesh::Build(*scene, wide, cache)), built);
  EXPECT_EQ(files().size(), 2u);
  NavMesh::Build(*WithCacheKey(scene, ""), {}, cache);
  EXPECT_EQ(files().size(), 2u);
  std::filesystem::remove_all(folder);
}

TEST(NavMesh, WorldsWithoutGroundAreRefused) {
  TestGround ground;
  ground.Floor("ground/road", 0, 0, 0.3f, 0.3f);
  EXPECT_THROW(NavMesh::Build(*ground.Build()), InputError);
}

}  // namespace
}  // namespace airsim360

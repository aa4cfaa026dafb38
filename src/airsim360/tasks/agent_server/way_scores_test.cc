// Scores go by the way around walls, not through them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "airsim360/opening/world_loader.h"
#include "airsim360/planning/routes/search.h"
#include "airsim360/routes/shortest_way.h"
#include "airsim360/tasks/agent_server/episode.h"

namespace airsim360 {
namespace {

void AddBox(SceneBuilder& builder, const char* name, Vec3f low, Vec3f high) {
  Mesh mesh;
  mesh.name = name;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
  mesh.parts = {{0, 12, 0, kNoEntity}};
  const EntityId entity = builder.AddEntity(name, builder.tree().At("construction/wall"));
  builder.AddInstance({builder.AddMesh(std::move(mesh)), {}, entity, {1, 1, 1}});
}

constexpr double kThick = 0.1;  // half the wall between the rooms

// Two rooms of 5 x 10 x 3 m; the wall between has a door from its floor to the ceiling, y in [door, 5].
std::shared_ptr<const Scene> TwoRooms(float door) {
  SceneBuilder builder("two rooms");
  builder.AddMaterial({});
  AddBox(builder, "shell", {-5, -5, 0}, {5, 5, 3});
  AddBox(builder, "wall", {-static_cast<float>(kThick), -5, 0}, {static_cast<float>(kThick), door, 3});
  builder.SetInteriorLight({1, 1, 1});
  builder.SetSpawn({-3, -3, 1.5f});
  return builder.Build();
}

std::shared_ptr<AgentWorld> World(float door) {
  return std::make_shared<AgentWorld>(std::make_shared<Stage>(TwoRooms(door)), RenderSettings{.tier = Tier::kLabels});
}

// From (-3, -3) to (3, -3) around the end of the wall at y = 3, never nearer to it than r: two tangents, two
// arcs, and the thickness of the wall.
double AroundTheWall(double r) {
  const double across = 3 - kThick, along = 6, away = std::hypot(across, along);
  const double tangent = std::sqrt(away * away - r * r);
  // From the heading of the tangent to that along the end of the wall.
  const double turn = std::atan2(along, across) + std::asin(r / away);
  return 2 * (tangent + r * turn) + 2 * kThick;
}

TEST(ShortestWay, LeadsThroughTheDoorAndIsAsLongAsThat) {
  const auto tracer = std::make_shared<const RayTracer>(TwoRooms(3));
  for (const double radius : {0.2, 0.4}) {
    const ShortestWay way = FindShortestWay(tracer, {-3, -3, 1.5}, {3, -3, 1.5}, radius);
    ASSERT_TRUE(way.found);
    const double exact = AroundTheWall(radius), length = PolylineLength(way.points);
    EXPECT_GT(length, exact - 0.01) << radius;
    EXPECT_LT(length, 1.05 * exact) << radius;
  }
}

TEST(ShortestWay, OfWhatCanBeSeenIsTheStraightOne) {
  const auto tracer = std::make_shared<const RayTracer>(TwoRooms(3));
  const ShortestWay way = FindShortestWay(tracer, {-3, -3, 1.5}, {-1, 2, 1.5}, 0.3);
  EXPECT_TRUE(way.found);
  EXPECT_EQ(way.points, (std::vector<Vec3d>{{-3, -3, 1.5}, {-1, 2, 1.5}}));
}

TEST(ShortestWay, WhereNoneLeadsItIsSaid) {
  const auto closed = std::make_shared<const RayTracer>(TwoRooms(5));
  EXPECT_FALSE(FindShortestWay(closed, {-3, -3, 1.5}, {3, -3, 1.5}, 0.2).found);
  // A door narrower than the drone.
  const auto narrow = std::make_shared<const RayTracer>(TwoRooms(4.7f));
  EXPECT_FALSE(FindShortestWay(narrow, {-3, -3, 1.5}, {3, -3, 1.5}, 0.2).found);
  // A goal inside the wall.
  EXPECT_FALSE(FindShortestWay(narrow, {-3, -3, 1.5}, {0, 0, 1.5}, 0.2).found);
}

TEST(ShortestWay, ANarrowPlaceToStartFromIsNoObstacle) {
  const auto tracer = std::make_shared<const RayTracer>(TwoRooms(3));
  EXPECT_TRUE(FindShortestWay(tracer, {-3, -3, 0.15}, {3, -3, 1.5}, 0.4).found);
}

// Before, the straight line through the wall was the shortest way: 6 m, and half the SPL for a perfect
// flight.
TEST(Episode, AFlightThroughTheOnlyDoorIsScoredByTheWayThatThereIs) {
  const auto world = World(3);
  EpisodeSpec spec;
  spec.start = Vec3d{-3, -3, 1.5};
  spec.start_yaw = std::numbers::pi / 2;
  spec.goal = Vec3d{3, -3, 1.5};
  spec.success_radius = 0.5;
  Episode episode(world, spec);
  episode.Act(WaypointsAction{.points = {{-0.8, 4, 1.5}, {0.8, 4, 1.5}, {3, -3, 1.5}}, .speed = 1.5});
  episode.Act(PresetAction{Preset::kStop});
  const EpisodeScore score = episode.Score();
  ASSERT_TRUE(score.success);
  EXPECT_FALSE(score.shortest_is_straight);
  EXPECT_GT(score.shortest_length, AroundTheWall(0) - 0.01);
  EXPECT_LT(score.shortest_length, 1.05 * AroundTheWall(0.4));
  EXPECT_GT(score.path_length, AroundTheWall(0) - 0.5);  // success is 0.5 m before the goal
  EXPECT_GT(score.spl, 0.8);
  // The reference bends with the way: it is nearer to the flight than the straight line, 7 m off, could be.
  EXPECT_GT(score.ndtw, std::exp(-4));

  spec.goal = Vec3d{-3, 0, 1.5};
  Episode near(world, spec);
  EXPECT_NEAR(near.Score().shortest_length, 3, 1e-9);
  EXPECT_FALSE(near.Score().shortest_is_straight);
}

TEST(Episode, AGoalThatNoWayLeadsToIsScoredByTheStraightLineAndSaysSo) {
  EpisodeSpec spec;
  spec.start = Vec3d{-3, -3, 1.5};
  spec.goal = Vec3d{3, -3, 1.5};
  Episode episode(World(5), spec);
  EXPECT_TRUE(episode.Score().shortest_is_straight);
  EXPECT_NEAR(episode.Score().shortest_length, 6, 1e-9);
  // A demonstration counts as the way, whatever stands between.
  spec.reference_path = {{-3, -3, 1.5}, {0, 6, 1.5}, {3, -3, 1.5}};
  Episode shown(World(5), spec);
  EXPECT_FALSE(shown.Score().shortest_is_straight);
  EXPECT_NEAR(shown.Score().shortest_length, 2 * std::hypot(3, 9), 1e-9);
}

}  // namespace
}  // namespace airsim360

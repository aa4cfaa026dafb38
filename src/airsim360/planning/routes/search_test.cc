#include "airsim360/planning/routes/search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/planning/analytic_world.h"
#include "airsim360/planning/certificate.h"
#include "airsim360/planning/routes/point_to_point.h"

namespace airsim360 {
namespace {

constexpr Box3d kHall = {{-10, -10, 0}, {10, 10, 6}};

// A wall across the hall at x = 0 with a door of 2 m by 2.5 m.
AnalyticWorld WallWithDoor() {
  return AnalyticWorld({}, {{{-0.1, -10, 0}, {0.1, 4, 6}}, {{-0.1, 6, 0}, {0.1, 10, 6}}, {{-0.1, 4, 2.5}, {0.1, 6, 6}}});
}

void ExpectClear(const std::vector<Vec3d>& path, const ClearanceQuery& world, double radius) {
  for (size_t i = 0; i + 1 < path.size(); ++i) EXPECT_TRUE(SegmentIsClear(path[i], path[i + 1], world, radius));
}

TEST(Search, GoesThroughTheDoorAndShortcutsComeNearTheShortestWay) {
  const AnalyticWorld inner = WallWithDoor();
  const BoundedClearance world(inner, kHall);
  const Vec3d start{-8, -8, 1.2}, goal{8, -8, 1.2};
  const SearchResult found = FindPath(start, goal, world, {.radius = 0.4, .spacing = 0.5});
  ASSERT_EQ(found.outcome, SearchOutcome::kFound);
  EXPECT_EQ(found.path.front(), start);
  EXPECT_EQ(found.path.back(), goal);
  EXPECT_NEAR(found.length, PolylineLength(found.path), 1e-9);
  ExpectClear(found.path, world, 0.4);
  const std::vector<Vec3d> path = Shortcut(found.path, world, 0.4);
  ExpectClear(path, world, 0.4);
  // Between the ways around the end of the wall at y = 4 of a point, and of a ball in a square of 0.4 m.
  EXPECT_GT(PolylineLength(path), 2 * std::hypot(8, 12));
  EXPECT_LT(PolylineLength(path), 1.01 * (2 * std::hypot(7.5, 12.4) + 1));
}

TEST(Search, IsAsShortAsDijkstraOnTheSameLattice) {
  RngStream rng(3, "search");
  int found = 0;
  for (int k = 0; k < 12; ++k) {
    std::vector<Ball> balls;
    for (int i = 0; i < 25; ++i) balls.push_back({{rng.Uniform(-7, 7), rng.Uniform(-9, 9), rng.Uniform(0, 6)}, rng.Uniform(0.5, 2)});
    const AnalyticWorld inner(balls, {});
    const BoundedClearance world(inner, kHall);
    const Vec3d start{-9, rng.Uniform(-8, 8), 3}, goal{9, rng.Uniform(-8, 8), 3};
    const SearchResult a = FindPath(start, goal, world, {.radius = 0.3, .spacing = 0.8});
    const SearchResult b = FindPath(start, goal, world, {.radius = 0.3, .spacing = 0.8, .heuristic = 0});
    ASSERT_EQ(a.outcome, b.outcome);
    if (a.outcome != SearchOutcome::kFound) continue;
    ++found;
    EXPECT_NEAR(a.length, b.length, 1e-9);
    EXPECT_LE(a.expanded, b.expanded);
    ExpectClear(a.path, world, 0.3);
  }
  EXPECT_GT(found, 6);
}

TEST(Search, SaysWhatIsWrong) {
  const AnalyticWorld inner({{{8, 0, 3}, 0.5}}, {{{4, -2, 0}, {6, 2, 0.1}},
                                                 {{4, -2, 2}, {6, 2, 2.1}},
                                                 {{4, -2, 0}, {4.1, 2, 2.1}},
                                                 {{5.9, -2, 0}, {6, 2, 2.1}},
                                                 {{4, -2, 0}, {6, -1.9, 2.1}},
                                                 {{4, 1.9, 0}, {6, 2, 2.1}}});
  const BoundedClearance world(inner, kHall);
  const SearchOptions options{.radius = 0.3, .spacing = 0.4};
  const Vec3d open{-8, 0, 3}, boxed{5, 0, 1}, wall{8, 0, 3};
  EXPECT_EQ(FindPath(wall, open, world, options).outcome, SearchOutcome::kStartBlocked);
  EXPECT_EQ(FindPath(open, wall, world, options).outcome, SearchOutcome::kGoalBlocked);
  EXPECT_EQ(FindPath(open, {30, 0, 3}, world, options).outcome, SearchOutcome::kGoalBlocked);
  const SearchResult enclosed = FindPath(open, boxed, world, options);
  EXPECT_EQ(enclosed.outcome, SearchOutcome::kGoalEnclosed);
  EXPECT_LT(enclosed.reached_volume, 8);
  EXPECT_EQ(FindPath(boxed, open, world, options).outcome, SearchOutcome::kStartEnclosed);
  EXPECT_THROW(FindPath(open, boxed, world, {.radius = 0.3, .spacing = 0.01}), InputError);
}

TEST(FlyFree, IsProvedFreeThroughTheDoorAndWithinTheLimits) {
  const AnalyticWorld inner = WallWithDoor();
  const BoundedClearance world(inner, kHall);
  FlightOptions options{.limits = {.speed = 5, .acceleration = 3}, .allocation = {}, .radius = 0.4};
  const std::vector<Vec3d> ends = {{-8, -8, 1.2}, {8, -8, 1.2}};
  const CertifiedFlight flight = FlyFree(ends, world, options);
  EXPECT_TRUE(flight.certificate.certified);
  EXPECT_LE(flight.flight.peaks.speed.value, 5 * (1 + 1e-9));
  EXPECT_LE(flight.flight.peaks.acceleration.value, 3 * (1 + 1e-9));
  const PolynomialTrajectory& path = flight.flight.trajectory;
  EXPECT_LT(Norm(path.At(0).p - ends[0]), 1e-9);
  EXPECT_LT(Norm(path.At(path.duration()).p - ends[1]), 1e-6);
  for (int i = 0; i <= 5000; ++i) {
    const double t = path.duration() * i / 5000;
    EXPECT_GE(world.Clearance(path.At(t).p, 1), 0.4);
  }
}

TEST(FlyFree, NamesTheWaypointThatCannotBeReached) {
  const AnalyticWorld inner = WallWithDoor();
  const BoundedClearance world(inner, kHall);
  const FlightOptions options{.limits = {.speed = 5, .acceleration = 3}, .allocation = {}, .radius = 0.4};
  const auto message = [&](std::vector<Vec3d> points, double radius) -> std::string {
    FlightOptions with = options;
    with.radius = radius;
    try {
      FlyFree(points, world, with);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({{-8, 0, 1}, {0.2, 0, 1}}, 0.4).find("waypoint 2 (0.20, 0.00, 1.00) is only 0.1 m"), std::string::npos);
  EXPECT_NE(message({{-8, 0, 1}, {80, 0, 1}}, 0.4).find("waypoint 2 (80.00, 0.00, 1.00) is outside"), std::string::npos);
  // The door is 2 m wide: a ball of radius 1.2 does not fit.
  EXPECT_NE(message({{-8, 0, 2}, {8, 0, 2}}, 1.2).find("no way from"), std::string::npos);
}

TEST(FlyThrough, AddsWaypointsOnlyWhereTheSmoothPathLeavesTheFreeSpace) {
  // A corridor with a right angle, 3 m wide: the smooth path through the corner swings out of it.
  const AnalyticWorld world({}, {{{-20, 1.5, -5}, {-1.5, 20, 5}}, {{1.5, -20, -5}, {4, 20, 5}}, {{-20, -4, -5}, {4, -1.5, 5}}});
  const std::vector<Vec3d> corner = {{-15, 0, 0}, {0, 0, 0}, {0, 15, 0}};
  const FlightOptions options{.limits = {.speed = 8, .acceleration = 4}, .allocation = {}, .radius = 1};
  const CertifiedFlight flight = FlyThrough(corner, world, options);
  EXPECT_TRUE(flight.certificate.certified);
  EXPECT_GT(flight.added, 0u);
  const AnalyticWorld open({}, {});
  EXPECT_EQ(FlyThrough(corner, open, options).added, 0u);
}

}  // namespace
}  // namespace airsim360

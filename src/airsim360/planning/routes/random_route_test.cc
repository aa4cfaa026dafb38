#include "airsim360/planning/routes/random_route.h"

#include <gtest/gtest.h>

#include "airsim360/planning/analytic_world.h"
#include "airsim360/planning/arc_length.h"
#include "airsim360/planning/certificate.h"
#include "airsim360/planning/routes/search.h"
#include "airsim360/planning/splines/minimum_snap.h"

namespace airsim360 {
namespace {

// A floor of 60 x 60 m with a few towers and a closed hut at (30, 30).
ClearanceField Town() {
  ClearanceFieldBuilder builder({{0, 0, -1}, {60, 60, 30}}, 0.5);
  builder.Add(Box3d{{-5, -5, -0.5}, {65, 65, -0.1}});
  for (const Vec2d at : {Vec2d{10, 10}, Vec2d{45, 15}, Vec2d{15, 45}, Vec2d{48, 48}})
    builder.Add(Box3d{{at.x, at.y, 0}, {at.x + 5, at.y + 5, 25}});
  // Walls and roof of the hut.
  builder.Add(Box3d{{24, 24, 9.9}, {36, 36, 10}});
  builder.Add(Box3d{{24, 24, 0}, {36, 24.1, 10}});
  builder.Add(Box3d{{24, 35.9, 0}, {36, 36, 10}});
  builder.Add(Box3d{{24, 24, 0}, {24.1, 36, 10}});
  builder.Add(Box3d{{35.9, 24, 0}, {36, 36, 10}});
  return builder.Build();
}

// The map alone as a world.
class MapWorld : public ClearanceQuery {
 public:
  explicit MapWorld(const ClearanceField& field) : field_(field) {}
  double Clearance(Vec3d p, double max_distance) const override { return std::min(field_.At(p), max_distance); }

 private:
  const ClearanceField& field_;
};

TEST(ReachableSpace, EndsAtClosedWalls) {
  const ClearanceField field = Town();
  const ReachableSpace outside(field, {5, 5, 5}, 0.5), inside(field, {30, 30, 5}, 0.5);
  EXPECT_TRUE(outside.Contains({55, 55, 20}));
  EXPECT_FALSE(outside.Contains({30, 30, 5}));
  EXPECT_TRUE(inside.Contains({30, 30, 5}));
  EXPECT_FALSE(inside.Contains({5, 5, 5}));
  EXPECT_FALSE(outside.Contains({5, 5, -0.8}));
  EXPECT_FALSE(outside.Contains({500, 5, 5}));
  // The hut's free space is at most its inside.
  EXPECT_LT(inside.volume(), 12 * 12 * 10);
  EXPECT_GT(inside.volume(), 8 * 8 * 7);
}

TEST(RandomRoute, IsReachableClearOfTheLengthAskedForAndReproducible) {
  const ClearanceField field = Town();
  const ReachableSpace space(field, {5, 5, 5}, 0.5);
  const RandomRouteOptions options{.min_length = 20, .max_length = 50, .room = 1, .max_height = 20};
  int drawn = 0;
  for (uint64_t seed = 0; seed < 60; ++seed) {
    RngStream a(seed, "route"), b(seed, "route");
    const auto route = DrawRoute(field, space, MapWorld(field), options, a);
    EXPECT_EQ(route, DrawRoute(field, space, MapWorld(field), options, b));
    if (!route) continue;
    ++drawn;
    const double length = PolylineLength(*route);
    EXPECT_GE(length, 20 - 1e-9);
    EXPECT_LE(length, 50 + 1e-9);
    EXPECT_GE(route->size(), 3u);
    for (size_t i = 0; i + 1 < route->size(); ++i) {
      for (int k = 0; k <= 200; ++k) {
        const Vec3d p = (*route)[i] + ((*route)[i + 1] - (*route)[i]) * (k / 200.0);
        EXPECT_TRUE(space.Contains(p));
        EXPECT_GE(field.At(p), 0.5);
      }
    }
  }
  EXPECT_GT(drawn, 30);
}

TEST(RandomRoute, FindsGapsThatTheMapIsTooCoarseFor) {
  // A wall with a slit of 2 m, which the map's voxels of 2 m close for a leg that needs 0.75 m to either
  // side.
  const Box3d left{{-20, -0.5, -20}, {-1, 0.5, 20}}, right{{1, -0.5, -20}, {20, 0.5, 20}};
  ClearanceFieldBuilder builder({{-20, -20, -20}, {20, 20, 20}}, 2);
  builder.Add(left);
  builder.Add(right);
  const ClearanceField field = builder.Build();
  const AnalyticWorld exact({}, {left, right});
  const BoundedClearance world(exact, field.box());
  const ReachableSpace space(field, {0, -10, 0}, 0.5);
  const RandomRouteOptions options{.min_length = 10, .max_length = 30, .room = 0.75};
  int through = 0;
  for (uint64_t seed = 0; seed < 2000; ++seed) {
    RngStream random(seed, "route");
    const auto route = DrawRoute(field, space, world, options, random);
    if (!route) continue;
    for (size_t i = 0; i + 1 < route->size(); ++i) {
      const Vec3d a = (*route)[i], b = (*route)[i + 1];
      if ((a.y > 0) == (b.y > 0)) continue;
      ++through;
      EXPECT_LT(std::abs(a.x + (b.x - a.x) * a.y / (a.y - b.y)), 0.25);
      EXPECT_FALSE(SegmentIsClear(a, b, MapWorld(field), options.room));
    }
  }
  EXPECT_GT(through, 0);
}

TEST(ArcLength, IsTheDistanceOnAStraightFlightAndTheSumOfFineChordsOnOthers) {
  const Vec3d points[] = {{0, 0, 0}, {6, 8, 0}, {12, 0, 5}, {12, 9, 9}};
  const double durations[] = {3, 2, 4};
  const PolynomialTrajectory straight = SolveMinimumSnap({.waypoints = std::span(points, 2), .durations = std::span(durations, 1)});
  EXPECT_NEAR(ArcLength(straight), 10, 1e-9);
  const PolynomialTrajectory curve = SolveMinimumSnap({.waypoints = points, .durations = durations});
  double chords = 0;
  constexpr int kChords = 200'000;
  for (int i = 0; i < kChords; ++i) {
    chords += Norm(curve.At(curve.duration() * (i + 1) / kChords).p - curve.At(curve.duration() * i / kChords).p);
  }
  EXPECT_NEAR(ArcLength(curve), chords, 1e-6 * chords);
}

}  // namespace
}  // namespace airsim360

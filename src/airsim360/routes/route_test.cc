#include "airsim360/routes/route.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/routes/route_file.h"

namespace airsim360 {
namespace {

double DistanceToSegment(Vec3d p, Vec3d a, Vec3d b) {
  const Vec3d d = b - a;
  const double s = std::clamp(Dot(p - a, d) / Dot(d, d), 0.0, 1.0);
  return Norm(p - (a + d * s));
}

std::vector<Vec3d> RandomCorners(uint64_t seed, int n) {
  RngStream random(seed, "corners");
  std::vector<Vec3d> corners;
  for (int i = 0; i < n; ++i) corners.push_back({random.Uniform(-40, 40), random.Uniform(-40, 40), random.Uniform(0, 30)});
  return corners;
}

TEST(Route, VelocityAndAccelerationAreDerivativesOfPosition) {
  const Route route = RoundedRoute(RandomCorners(1, 12), {});
  constexpr double h = 1e-4;
  for (double t = 0.0137; t < route.duration() - h; t += 0.31) {
    const Vec3d v = (route.At(t + h).p - route.At(t - h).p) / (2 * h);
    const Vec3d a = (route.At(t + h).v - route.At(t - h).v) / (2 * h);
    EXPECT_LT(Norm(v - route.At(t).v), 1e-5) << t;
    EXPECT_LT(Norm(a - route.At(t).a), 1e-2) << t;
  }
}

TEST(Route, RoundedCornersStayNearTheLegsAndWithinTheLimits) {
  const FlightLimits limits{.speed = 5, .acceleration = 3, .corner = 1.2};
  for (uint64_t seed = 0; seed < 5; ++seed) {
    const std::vector<Vec3d> corners = RandomCorners(seed, 10);
    const Route route = RoundedRoute(corners, limits);
    double farthest = 0, fastest = 0, strongest = 0;
    for (double t = 0; t < route.duration(); t += 0.01) {
      const RoutePoint point = route.At(t);
      double nearest = 1e9;
      for (size_t i = 0; i + 1 < corners.size(); ++i) {
        nearest = std::min(nearest, DistanceToSegment(point.p, corners[i], corners[i + 1]));
      }
      farthest = std::max(farthest, nearest);
      fastest = std::max(fastest, Norm(point.v));
      strongest = std::max(strongest, Norm(point.a));
    }
    EXPECT_LT(farthest, 0.19 * 1.2 * 2);
    EXPECT_LE(fastest, 5 * (1 + 1e-9));
    EXPECT_LE(strongest, 3 * (1 + 1e-6));
    EXPECT_GT(strongest, 2.5);  // uses what it may
  }
}

TEST(Route, StartsAndEndsAtRestAtTheGivenPoints) {
  const std::vector<Vec3d> corners = RandomCorners(3, 5);
  const Route route = RoundedRoute(corners, {});
  EXPECT_EQ(route.At(-1).p, corners.front());
  EXPECT_EQ(route.At(route.duration() + 1).p, corners.back());
  EXPECT_LT(Norm(route.At(1e-6).v), 1e-3);
  EXPECT_LT(Norm(route.At(route.duration() - 1e-6).v), 1e-3);
}

TEST(Route, TurnsTheShorterWay) {
  const Route route({{.t = 0, .p = {}, .v = {}, .yaw = 3.0}, {.t = 1, .p = {}, .v = {}, .yaw = -3.0}});
  EXPECT_NEAR(route.At(1).yaw, 2 * std::numbers::pi - 3, 1e-12);
  EXPECT_GT(route.At(0.5).yaw_rate, 0);
}

TEST(Route, RefusesTimesThatDoNotGrow) {
  const RouteNode zero, one{1, {}, {}, 0};
  EXPECT_THROW(Route(std::vector<RouteNode>{}), InputError);
  EXPECT_THROW(Route(std::vector<RouteNode>{zero, zero}), InputError);
  EXPECT_THROW(Route(std::vector<RouteNode>{one}), InputError);
  EXPECT_NO_THROW(Route(std::vector<RouteNode>{zero, one}));
}

TEST(RouteThrough, PassesEveryWaypointExactlyAtItsTimeAndHeading) {
  std::vector<Waypoint> waypoints;
  RngStream random(5, "waypoints");
  for (int i = 0; i < 8; ++i) {
    waypoints.push_back({{random.Uniform(-9, 9), random.Uniform(-9, 9), 3}, random.Uniform(-3, 3), 2.0 * i + 1, true, true});
  }
  const Route route = RouteThrough(waypoints, 3);
  for (int i = 0; i < 8; ++i) {
    const RoutePoint point = route.At(2.0 * i);
    EXPECT_LT(Norm(point.p - waypoints[i].p), 1e-9);
    EXPECT_NEAR(std::remainder(point.yaw - waypoints[i].yaw, 2 * std::numbers::pi), 0, 1e-9);
  }
}

TEST(RouteThrough, LooksAlongTheTravelWhereNoHeadingIsGiven) {
  const Route route = RouteThrough({{{0, 0, 1}}, {{0, 5, 1}}, {{0, 9, 1}}}, 2);
  EXPECT_NEAR(route.At(1).yaw, std::numbers::pi / 2, 1e-12);
}

// The message of the InputError that parsing `text` gives.
std::string ParseError(std::string_view text) {
  try {
    ParseRouteCsv(text, "route.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(RouteCsv, ReadsColumnsInAnyOrder) {
  const auto waypoints = ParseRouteCsv("# survey\nz, yaw_deg, x, y\n\n3,90,1,2\r\n4,-90,5,6\n", "route.csv");
  ASSERT_EQ(waypoints.size(), 2u);
  EXPECT_EQ(waypoints[0].p, (Vec3d{1, 2, 3}));
  EXPECT_NEAR(waypoints[0].yaw, std::numbers::pi / 2, 1e-15);
  EXPECT_TRUE(waypoints[0].has_yaw);
  EXPECT_FALSE(waypoints[0].has_time);
  EXPECT_EQ(waypoints[1].p, (Vec3d{5, 6, 4}));
}

TEST(RouteCsv, WithoutAHeaderTheColumnsAreXyz) {
  const auto waypoints = ParseRouteCsv(
      "\xef\xbb\xbf"
      "1,2,3\n4,5,6",
      "route.csv");  // with a byte order mark, as of spreadsheets
  ASSERT_EQ(waypoints.size(), 2u);
  EXPECT_EQ(waypoints[1].p, (Vec3d{4, 5, 6}));
}

TEST(RouteCsv, ErrorsNameFileLineAndColumn) {
  EXPECT_EQ(ParseError("x,y,z\n1,2,3\n1,two,3\n"), "route.csv:3:3: two: not a finite number");
  EXPECT_EQ(ParseError("x,y,z\n1,2\n"), "route.csv:2:1: 2 values for 3 columns");
  EXPECT_EQ(ParseError("x,y,z\n1,2,nan\n"), "route.csv:2:5: nan: not a finite number");
  EXPECT_EQ(ParseError("x,y,z\n1,2,2e18\n"), "route.csv:2:5: 2e+18 is not in -1e+07 … 1e+07 metres");
  EXPECT_EQ(ParseError("x,y\n"), "route.csv:1:1: column 'z' is missing from the header");
  EXPECT_EQ(ParseError("x,y,z,x\n"), "route.csv:1:7: column 'x' is there twice");
  EXPECT_EQ(ParseError("x,y,z,t\n0,0,0,1\n0,0,0,1\n"), "route.csv:3:1: t does not grow: 1 s after 1 s");
  EXPECT_EQ(ParseError("# nothing\n"), "route.csv: no points");
  EXPECT_NE(ParseError("x,y,z,yawdeg\n").find("route.csv:1:7: unknown column 'yawdeg'; did you mean 'yaw_deg'?"), std::string::npos);
}

}  // namespace
}  // namespace airsim360

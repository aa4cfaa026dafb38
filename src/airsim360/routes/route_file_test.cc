// Route files other than CSV (route_test.cc has those).
#include "airsim360/routes/route_file.h"

#include <gtest/gtest.h>

#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/planning/splines/minimum_snap.h"

namespace airsim360 {
namespace {

template <class Parse>
std::string MessageOf(const Parse& parse) {
  try {
    parse();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RouteYaml, HasTheFieldsOfCsv) {
  const auto route = ParseRouteYaml("waypoints:\n- {x: 1, y: 2, z: 3, yaw_deg: 90, t: 0}\n- {x: 4, y: 5, z: 6, t: 2.5}\n", "r.yaml");
  ASSERT_EQ(route.size(), 2u);
  EXPECT_EQ(route[0].p, (Vec3d{1, 2, 3}));
  EXPECT_TRUE(route[0].has_yaw && !route[1].has_yaw);
  EXPECT_NEAR(route[0].yaw, std::numbers::pi / 2, 1e-15);
  EXPECT_EQ(route[1].t, 2.5);
  EXPECT_EQ(route[0].line, 2u);
  EXPECT_EQ(route[1].line, 3u);
}

TEST(RouteYaml, ErrorsNameThePlace) {
  const auto message = [](const char* text) { return MessageOf([&] { ParseRouteYaml(text, "r.yaml"); }); };
  EXPECT_NE(message("waypoints:\n- {x: 1, y: 2, w: 3}\n").find("r.yaml:2:"), std::string::npos);
  EXPECT_NE(message("waypoints:\n- {x: 1, y: 2}\n").find("r.yaml:2: waypoint 1 lacks"), std::string::npos);
  EXPECT_NE(message("waypoints:\n- {x: 1, y: 2, z: nan}\n").find("r.yaml:2:"), std::string::npos);
  EXPECT_NE(message("waypoints:\n- {x: 1, y: 2, z: 1, t: 3}\n- {x: 1, y: 2, z: 1, t: 2}\n")
                .find("r.yaml:3: waypoint 2: t does not grow: 2 s after 3 s"),
            std::string::npos);
  EXPECT_NE(message("waypoints: []\n").find("no points"), std::string::npos);
}

TEST(RouteXml, GpxIsEastNorthUpAroundTheFirstPoint) {
  const char* gpx =
      "<?xml version=\"1.0\"?>\n<!-- a <trkpt> in a comment -->\n<gpx><trk><trkseg>\n"
      "<trkpt lat=\"47.0\" lon='8.0'><ele>400</ele><time>2026-01-01T00:00:00Z</time></trkpt>\n"
      "<trkpt lat=\"47.001\" lon=\"8.0\"><ele>410.5</ele></trkpt>\n"
      "<trkpt lat=\"47.0\" lon=\"8.001\"><ele>400</ele></trkpt>\n</trkseg></trk></gpx>\n";
  const auto route = ParseRouteXml(gpx, "r.gpx");
  ASSERT_EQ(route.size(), 3u);
  EXPECT_LT(Norm(route[0].p - Vec3d{0, 0, 400}), 1e-6);
  // A thousandth of a degree at 47 degrees north: 111.17 m north, 76.06 m east, and 400 m higher a little
  // more.
  EXPECT_NEAR(route[1].p.y, 111.18, 0.02);
  EXPECT_NEAR(route[1].p.z, 410.5, 0.002);
  EXPECT_NEAR(route[2].p.x, 76.06, 0.02);
  EXPECT_EQ(route[0].line, 4u);
  EXPECT_EQ(route[2].line, 6u);
}

TEST(RouteXml, KmlCoordinatesAreLongitudeFirst) {
  const char* kml =
      "<kml><Placemark><LineString><coordinates>\n 8.0,47.0,5\n 8.0,47.001,6 8.001,47.0\n"
      "</coordinates></LineString></Placemark></kml>";
  const auto route = ParseRouteXml(kml, "r.kml", GeoPoint{47, 8, 0});
  ASSERT_EQ(route.size(), 3u);
  EXPECT_NEAR(route[0].p.z, 5, 1e-6);
  EXPECT_NEAR(route[1].p.y, 111.17, 0.02);
  EXPECT_NEAR(route[2].p.x, 76.05, 0.02);
  EXPECT_EQ(route[1].line, 3u);
}

TEST(RouteXml, ErrorsNameThePlace) {
  const auto message = [](const char* text) { return MessageOf([&] { ParseRouteXml(text, "r.gpx"); }); };
  EXPECT_NE(message("<gpx>\n<wpt lat=\"x\" lon=\"1\"/>\n</gpx>").find("r.gpx:2:11: 'x' is not a number"), std::string::npos)
      << message("<gpx>\n<wpt lat=\"x\" lon=\"1\"/>\n</gpx>");
  EXPECT_NE(message("<gpx>\n<wpt lon=\"1\"/></gpx>").find("attribute 'lat' is missing"), std::string::npos);
  EXPECT_NE(message("<gpx><wpt lat=\"91\" lon=\"1\"/></gpx>").find("latitude 91"), std::string::npos);
  EXPECT_NE(message("<gpx><wpt lat=\"9").find("does not end"), std::string::npos);
  EXPECT_NE(message("<!DOCTYPE x><gpx/>").find("DOCTYPE"), std::string::npos);
  EXPECT_NE(message("<gpx></gpx>").find("no points"), std::string::npos);
  EXPECT_NE(message("<kml><coordinates>1,2,3,4</coordinates></kml>").find("more than lon,lat,alt"), std::string::npos);
  EXPECT_NE(message("<kml><coordinates>1</coordinates></kml>").find("is needed"), std::string::npos);
}

TEST(RouteXml, AFileThatIsCutOffIsRefusedWithoutLosingPoints) {
  const auto message = [](const char* text) { return MessageOf([&] { ParseRouteXml(text, "r.gpx"); }); };
  EXPECT_NE(message("<gpx>\n<wpt lat=\"1\" lon=\"1\"/>\n<wpt lat=\"2\" lon=\"1\">").find("r.gpx:3:1: 'wpt' is not closed"),
            std::string::npos);
  EXPECT_NE(message("<gpx><rte><rtept lat=\"1\" lon=\"1\"/></gpx>").find("'gpx' is closed, but not open"), std::string::npos);
  EXPECT_EQ(ParseRouteXml("<gpx><wpt lat=\"1\" name=\"a>b\" lon=\"1\"/></gpx>", "r.gpx").size(), 1u);
}

TEST(RouteXml, AHeightThatIsMissingIsNotTheSeaLevel) {
  EXPECT_NE(MessageOf([] {
              ParseRouteXml("<gpx><wpt lat=\"1\" lon=\"1\"><ele>9</ele></wpt>\n<wpt lat=\"2\" lon=\"1\"/></gpx>", "r.gpx");
            }).find("r.gpx:2:2: no height"),
            std::string::npos);
  EXPECT_EQ(ParseRouteXml("<gpx><wpt lat=\"1\" lon=\"1\"/></gpx>", "r.gpx")[0].p.z, 0);
}

TEST(RouteAlong, IsThePlannedFlightExactlyAndLooksWhereItGoes) {
  const Vec3d points[] = {{0, 0, 2}, {10, 0, 2}, {10, 10, 4}};
  const double durations[] = {4, 5};
  const PolynomialTrajectory path = SolveMinimumSnap({.waypoints = points, .durations = durations});
  const Route route = Route::Along(path, std::nullopt), fixed = Route::Along(path, ConstantYaw{1.25});
  EXPECT_EQ(route.duration(), path.duration());
  for (int i = 1; i < 900; ++i) {
    const double t = path.duration() * i / 900;
    EXPECT_EQ(route.At(t).p, path.At(t).p);
    EXPECT_EQ(route.At(t).v, path.At(t).v);
    EXPECT_EQ(fixed.At(t).yaw, 1.25);
    EXPECT_EQ(fixed.At(t).yaw_rate, 0);
    const Vec3d v = path.At(t).v;
    if (std::hypot(v.x, v.y) > 1) {
      EXPECT_LT(std::fabs(std::remainder(route.At(t).yaw - std::atan2(v.y, v.x), 2 * std::numbers::pi)), 0.15);
    }
  }
}

TEST(RouteAlong, TurnsAsThePolynomialsOfThePlanSay) {
  const Vec3d points[] = {{0, 0, 2}, {10, 0, 2}, {10, 10, 4}};
  const double durations[] = {4, 5};
  const PolynomialTrajectory path = SolveMinimumSnap({.waypoints = points, .durations = durations});
  // 0.1 + 0.4 t - 0.05 t^2 over 4 s, then on from there with the rate that it has.
  const Route route = Route::Along(path, YawPowers{{{0.1, 0.4, -0.05}, {0.9, 0, 0.02}}});
  for (int i = 1; i < 90; ++i) {
    const double t = 0.1 * i, u = t - 4;
    EXPECT_NEAR(route.At(t).yaw, t < 4 ? 0.1 + 0.4 * t - 0.05 * t * t : 0.9 + 0.02 * u * u, 1e-12) << t;
    EXPECT_NEAR(route.At(t).yaw_rate, t < 4 ? 0.4 - 0.1 * t : 0.04 * u, 1e-5) << t;
  }
  EXPECT_NE(MessageOf([&] { Route::Along(path, YawPowers{{{0.1}}}); }).find("1 polynomials for 2 segments"), std::string::npos);
}

}  // namespace
}  // namespace airsim360

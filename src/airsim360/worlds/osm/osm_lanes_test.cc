#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/scene/road_network.h"
#include "airsim360/worlds/osm/test_map.h"

namespace airsim360::internal {
namespace {

// Two streets of 200 m that cross at the origin.
TestMap Cross(TestMap::Tags crossing, const std::string& oneway = "no") {
  TestMap map(120, 120);
  const int middle = map.Node({0, 0}, crossing);
  map.WayOf({map.Node({-100, 0}), middle, map.Node({100, 0})}, {{"highway", "residential"}, {"width", "9"}, {"oneway", oneway}});
  map.WayOf({map.Node({0, -100}), middle, map.Node({0, 100})}, {{"highway", "secondary"}, {"width", "9"}});
  return map;
}

TEST(OsmLanes, KeepRightOfTheMiddleOfTheStreetBelowTheKerbs) {
  const auto scene = Cross({}).Build();
  ASSERT_TRUE(scene->roads);
  int between = 0;
  for (const Lane& lane : scene->roads->lanes) {
    for (const Vec3f p : lane.points) EXPECT_NEAR(p.z, -0.13f, 0.02f);
    if (lane.junction >= 0) continue;
    ++between;
    const Vec3f d = lane.points.back() - lane.points.front(), p = lane.points.front();
    const float left = (d.x * p.y - d.y * p.x) / Norm(d);  // of the axis through the origin
    EXPECT_LT(left, -0.9f);
    EXPECT_GT(left, -4.5f);
  }
  EXPECT_EQ(between, 8);
}

TEST(OsmLanes, HaveSignalsWhereTheMapHasThemElseTheBiggerRoadGoesFirst) {
  for (const bool signals : {false, true}) {
    const auto scene = (signals ? Cross({{"highway", "traffic_signals"}}) : Cross({})).Build();
    int priority[2] = {-1, -1};
    for (const Lane& lane : scene->roads->lanes) {
      if (lane.junction < 0) continue;
      const Junction& junction = scene->roads->junctions[static_cast<size_t>(lane.junction)];
      if (std::hypot(junction.center.x, junction.center.y) > 5) continue;
      EXPECT_EQ(lane.signal >= 0, signals);
      EXPECT_EQ(junction.phases.empty(), !signals);
      const Vec3f d = lane.points[1] - lane.points[0];
      const bool secondary = std::abs(d.y) > std::abs(d.x);
      EXPECT_EQ(lane.signal, !signals ? -1 : secondary ? 0 : 1);
      priority[secondary] = lane.priority;
    }
    EXPECT_GT(priority[1], priority[0]);
  }
}

TEST(OsmLanes, OneWayStreetsHaveNoLaneAgainstThem) {
  const auto scene = Cross({}, "yes").Build();
  ASSERT_TRUE(scene->roads);
  for (const Lane& lane : scene->roads->lanes) {
    if (lane.junction >= 0) continue;
    const Vec3f d = lane.points.back() - lane.points.front();
    EXPECT_TRUE(d.x > 0 || std::abs(d.y) > std::abs(d.x));
  }
}

TEST(OsmLanes, MapsWithoutStreetsHaveNoRoads) {
  TestMap map(60, 60);
  map.Line({{-50, 0}, {50, 0}}, {{"highway", "footway"}});
  EXPECT_FALSE(map.Build()->roads);
}

}  // namespace
}  // namespace airsim360::internal

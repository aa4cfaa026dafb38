#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>
#include <vector>

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

// A street from west to east through the origin, and a way back far to the north.
std::shared_ptr<const Scene> StreetWith(std::initializer_list<std::pair<const char*, std::string>> more) {
  TestMap map(120, 100);
  const int west = map.Node({-100, 0}), east = map.Node({100, 0});
  const int way = map.WayOf({west, map.Node({0, 0}), east}, {{"highway", "tertiary"}, {"lanes", "2"}});
  map.WayOf({east, map.Node({100, 80}), map.Node({-100, 80}), west}, {{"highway", "tertiary"}});
  std::string text = map.Text();
  const size_t at = text.find("<tag k='highway'", text.find("<way id='" + std::to_string(way) + "'"));
  for (const auto& [key, value] : more) text.insert(at, std::string("<tag k='") + key + "' v='" + value + "'/>");
  return BuildOsmWorld("street.osm", AsBytes(text), {.fill = false});
}

struct CycleCase {
  const char* name;
  std::initializer_list<std::pair<const char*, std::string>> tags;
  double east = 0, west = 0;  // y of the lanes for bicycles to the east and to the west; 0: none
  double half = 0;            // of the carriageway; bays of 2.1 m on both sides, where it is wider than 8.4 m
};

// 6.4 m for cars and 2.1 m for bays on each side, as without bicycles; 1.7 m more for each of their lanes.
const CycleCase kCycleCases[] = {
    {"none", {}, 0, 0, 5.3},
    {"lane", {{"cycleway", "lane"}}, -4.05, 4.05, 7},
    {"track", {{"cycleway", "track"}}, -4.05, 4.05, 7},
    {"both", {{"cycleway:both", "lane"}}, -4.05, 4.05, 7},
    {"right", {{"cycleway:right", "lane"}}, -3.2, 0, 6.15},
    {"left", {{"cycleway:left", "lane"}}, 0, 3.2, 6.15},
    {"separate", {{"cycleway", "separate"}}, 0, 0, 5.3},
    {"one_way", {{"oneway", "yes"}, {"cycleway", "lane"}}, -3.2, 0, 6.15},
    {"one_way_left", {{"oneway", "yes"}, {"cycleway:left", "lane"}}, 3.2, 0, 6.15},
    {"one_way_against", {{"oneway", "yes"}, {"cycleway:left", "lane"}, {"cycleway:left:oneway", "-1"}}, 0, 0, 5.3},
    {"narrow", {{"width", "8"}, {"cycleway", "lane"}}, 0, 0, 4},
    {"instead_of_bays", {{"width", "9"}, {"cycleway", "lane"}}, -3.65, 3.65, 4.5},
    {"cobbles", {{"surface", "sett"}, {"cycleway:right", "lane"}}, 0, 0, 6.15},
};

void PrintTo(const CycleCase& c, std::ostream* out) { *out << c.name; }

class CycleLanes : public testing::TestWithParam<CycleCase> {};

INSTANTIATE_TEST_SUITE_P(OsmLanes, CycleLanes, testing::ValuesIn(kCycleCases), [](const auto& info) { return info.param.name; });

TEST_P(CycleLanes, LieWhereTheTagsSayAndLeaveTheRestToTheCars) {
  const auto scene = StreetWith(GetParam().tags);
  ASSERT_TRUE(scene->roads);
  double found[2] = {0, 0}, low = INFINITY, high = -INFINITY;
  std::vector<std::pair<double, double>> bands;
  for (const Lane& lane : scene->roads->lanes) {
    if (lane.junction >= 0 || std::ranges::any_of(lane.points, [](Vec3f p) { return p.y > 20; })) continue;
    const double y = lane.points.front().y, half = lane.width / 2;
    const bool east = lane.points.back().x > lane.points.front().x;
    if (lane.cycle) {
      EXPECT_EQ(found[east], 0) << "two lanes to one side";
      found[east] = y;
      EXPECT_NEAR(half, 0.85, 1e-3);
    }
    bands.emplace_back(y - half, y + half);
    low = std::min(low, y - half);
    high = std::max(high, y + half);
  }
  EXPECT_NEAR(found[true], GetParam().east, 0.01);
  EXPECT_NEAR(found[false], GetParam().west, 0.01);
  // The lanes fill the carriageway between the bays without overlap.
  std::ranges::sort(bands);
  for (size_t i = 1; i < bands.size(); ++i) EXPECT_NEAR(bands[i].first, bands[i - 1].second, 0.01);
  const bool bays = GetParam().half > 4.6;
  EXPECT_NEAR(high - low, 2 * (GetParam().half - (bays ? 2.1 : 0)), 0.02);
  EXPECT_NEAR(high + low, 0, 0.02);
  const bool painted = std::ranges::any_of(scene->entities, [](const Entity& entity) { return entity.name.ends_with("/bike_lane"); });
  EXPECT_EQ(painted, GetParam().east != 0 || GetParam().west != 0);
}

// Crossings of such streets: bicycles ride straight on from green to green, and cars have ways of their own.
TEST(OsmLanes, CycleLanesGoOnOverCrossings) {
  TestMap map(160, 160);
  const int middle = map.Node({0, 0}, {{"highway", "traffic_signals"}});
  map.WayOf({map.Node({-150, 0}), middle, map.Node({150, 0})}, {{"highway", "tertiary"}, {"cycleway", "lane"}});
  map.WayOf({map.Node({0, -150}), middle, map.Node({0, 150})}, {{"highway", "residential"}, {"cycleway:both", "lane"}});
  const auto scene = map.Build();
  int arriving = 0;
  for (const Lane& lane : scene->roads->lanes) {
    if (lane.junction >= 0 || !lane.cycle || Norm(lane.points.back()) > 60) continue;
    ++arriving;
    const Vec3f along = Normalized(lane.points.back() - lane.points.front());
    EXPECT_TRUE(std::ranges::any_of(lane.next, [&](LaneId way) {
      const Lane& on = scene->roads->lanes[scene->roads->lanes[way].next[0]];
      return on.cycle && Dot(Normalized(on.points.back() - on.points.front()), along) > 0.99f;
    }));
    for (const LaneId way : lane.next) EXPECT_GE(scene->roads->lanes[way].signal, 0);
  }
  EXPECT_EQ(arriving, 4);
}

// Streets into a roundabout are bigger than it is; who is in it goes first all the same.
TEST(OsmLanes, InARoundaboutOneGoesFirst) {
  TestMap map(160, 160);
  constexpr double kRadius = 40;
  std::vector<int> ring;
  for (int i = 0; i < 16; ++i) {
    const double a = 2 * M_PI * i / 16;
    ring.push_back(map.Node({kRadius * std::cos(a), kRadius * std::sin(a)}));
  }
  ring.push_back(ring.front());
  map.WayOf(ring, {{"highway", "residential"}, {"junction", "roundabout"}});
  for (int i = 0; i < 16; i += 4) {
    const double a = 2 * M_PI * i / 16;
    map.WayOf({ring[static_cast<size_t>(i)], map.Node({150 * std::cos(a), 150 * std::sin(a)})}, {{"highway", "secondary"}, {"lanes", "2"}});
  }
  const auto scene = map.Build();
  int on = 0, into = 0;
  for (const Lane& lane : scene->roads->lanes) {
    if (lane.junction < 0 || std::hypot(lane.points.front().x, lane.points.front().y) > 100) continue;
    const bool from_ring = std::hypot(lane.points.front().x, lane.points.front().y) < kRadius + 2;
    (from_ring ? on : into)++;
    EXPECT_EQ(lane.priority > 5, from_ring);
  }
  EXPECT_GE(on, 8);
  EXPECT_GE(into, 4);
}

// Both carriageways of a street cross another one 16 m apart; the map has signals at one of the crossings.
TEST(OsmLanes, BothCrossingsOfADualCarriagewayAreOneJunctionWithSignals) {
  TestMap map(160, 160);
  const int a = map.Node({-7, 0}, {{"highway", "traffic_signals"}}), b = map.Node({7, 0});
  map.WayOf({map.Node({-150, 0}), a, b, map.Node({150, 0})}, {{"highway", "residential"}, {"width", "9"}});
  map.WayOf({map.Node({-7, 150}), a, map.Node({-7, -150})}, {{"highway", "secondary"}, {"lanes", "2"}, {"oneway", "yes"}});
  map.WayOf({map.Node({7, -150}), b, map.Node({7, 150})}, {{"highway", "secondary"}, {"lanes", "2"}, {"oneway", "yes"}});
  const auto scene = map.Build();
  int ways = 0;
  for (const Lane& lane : scene->roads->lanes) {
    if (lane.junction < 0) {
      EXPECT_GT(Norm(lane.points.back() - lane.points.front()), 7);
    } else if (std::hypot(lane.points.front().x, lane.points.front().y) < 50) {
      ++ways;
      EXPECT_GE(lane.signal, 0);
    }
  }
  EXPECT_GE(ways, 12);
}

// On 4.6 m of carriageway two vans pass each other with their mirrors over the kerbs.
TEST(OsmLanes, OfANarrowStreetAreFarEnoughApartForTwoVans) {
  const auto scene = StreetWith({{"width", "4.6"}});
  for (const Lane& lane : scene->roads->lanes) {
    if (lane.junction >= 0 || std::ranges::any_of(lane.points, [](Vec3f p) { return p.y > 20; })) continue;
    EXPECT_NEAR(std::abs(lane.points.front().y), 1.25, 0.01);
  }
}

TEST(OsmLanes, MapsWithoutStreetsHaveNoRoads) {
  TestMap map(60, 60);
  map.Line({{-50, 0}, {50, 0}}, {{"highway", "footway"}});
  EXPECT_FALSE(map.Build()->roads);
}

}  // namespace
}  // namespace airsim360::internal

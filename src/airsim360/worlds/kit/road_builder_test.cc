#include "airsim360/worlds/kit/road_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

const auto kFlat = [](Vec2f) { return 0.0f; };
const std::vector<RoadLane> kOneLane = {{1.75f, 3.5f}}, kTwoLanes = {{1.75f, 3.5f}, {5.25f, 3.5f}};

// Four roads of 80 m from a crossing at the origin; their outer ends are dead.
RoadNetwork Crossing(const std::vector<RoadLane>& lanes, const std::function<float(Vec2f)>& height = kFlat) {
  RoadBuilder builder(height);
  const size_t middle = builder.AddJunction({0, 0}, 12);
  for (const Vec2f d : {Vec2f{1, 0}, Vec2f{0, 1}, Vec2f{-1, 0}, Vec2f{0, -1}}) {
    const size_t end = builder.AddJunction(d * 100, 5);
    builder.AddRoad({.from = middle, .to = end, .axis = {d * 15, d * 95}, .forward = lanes, .backward = lanes});
  }
  return builder.Build();
}

float Turn(const Lane& lane) {
  const auto heading = [](Vec3f d) { return std::atan2(d.y, d.x); };
  const size_t n = lane.points.size();
  return std::remainder(heading(lane.points[n - 1] - lane.points[n - 2]) - heading(lane.points[1] - lane.points[0]),
                        2 * static_cast<float>(M_PI));
}

TEST(RoadBuilder, EveryLaneOfACrossingLeadsLeftStraightAndRightAndBackAtDeadEnds) {
  const RoadNetwork roads = Crossing(kOneLane);
  ASSERT_NO_THROW(CheckRoads(roads));
  int to_crossing = 0, to_end = 0;
  for (const Lane& lane : roads.lanes) {
    if (lane.junction >= 0) continue;
    std::multiset<int> turns;
    for (const LaneId next : lane.next) turns.insert(static_cast<int>(std::lround(Turn(roads.lanes[next]) / (M_PI / 2))));
    const bool arrives = std::hypot(lane.points.back().x, lane.points.back().y) < 50;
    (arrives ? to_crossing : to_end)++;
    EXPECT_EQ(turns.size(), arrives ? 3u : 1u);
    EXPECT_EQ(turns.count(0), arrives ? 1u : 0u);
  }
  EXPECT_EQ(to_crossing, 4);
  EXPECT_EQ(to_end, 4);
}

// From a cycle lane one rides straight on and right into the next one; into it from every lane at the edge; cars have ways of their own.
TEST(RoadBuilder, CycleLanesLeadIntoCycleLanes) {
  const RoadNetwork roads = Crossing({{1.75f, 3.5f}, {.offset = 4.5f, .width = 1.7f, .cycle = true}});
  ASSERT_NO_THROW(CheckRoads(roads));
  int arriving = 0;
  for (const Lane& lane : roads.lanes) {
    if (lane.junction >= 0) continue;
    std::multiset<int> all, cycles;
    for (const LaneId next : lane.next) {
      const Lane& way = roads.lanes[next];
      EXPECT_EQ(way.cycle, roads.lanes[way.next[0]].cycle);
      const int turn = static_cast<int>(std::lround(Turn(way) / (M_PI / 2)));
      (way.cycle ? cycles : all).insert(turn);
    }
    if (std::hypot(lane.points.back().x, lane.points.back().y) > 50) {
      EXPECT_GE(lane.next.size(), 1u);
      continue;
    }
    ++arriving;
    EXPECT_EQ(cycles, lane.cycle ? (std::multiset<int>{-1, 0}) : (std::multiset<int>{-1, 0, 1}));
    EXPECT_EQ(all, lane.cycle ? std::multiset<int>{} : (std::multiset<int>{-1, 0, 1}));
    EXPECT_NE(lane.cycle ? lane.left : lane.right, kNoLane);
  }
  EXPECT_EQ(arriving, 8);
}

// One at the left kerb of a one-way road leads straight on and left, and nobody changes from it to the cars.
TEST(RoadBuilder, CycleLanesAtTheLeftKerbLeadStraightOnAndLeft) {
  RoadBuilder builder(kFlat);
  const std::vector<RoadLane> lanes{{.offset = -4.5f, .width = 1.7f, .cycle = true}, {-1.75f, 3.5f}, {1.75f, 3.5f}};
  const size_t middle = builder.AddJunction({0, 0}, 12);
  const auto add = [&](Vec2f d, bool in) {
    const size_t end = builder.AddJunction(d * 100, 5);
    const std::vector<Vec2f> axis = in ? std::vector<Vec2f>{d * 95, d * 15} : std::vector<Vec2f>{d * 15, d * 95};
    builder.AddRoad({.from = in ? end : middle, .to = in ? middle : end, .axis = axis, .forward = lanes, .backward = kOneLane});
  };
  add({0, -1}, true);
  for (const Vec2f d : {Vec2f{0, 1}, Vec2f{-1, 0}, Vec2f{1, 0}}) add(d, false);
  const RoadNetwork roads = builder.Build();
  ASSERT_NO_THROW(CheckRoads(roads));
  std::multiset<int> out, in;
  for (const Lane& lane : roads.lanes) {
    if (lane.junction >= 0) continue;
    EXPECT_FALSE(lane.cycle && (lane.left != kNoLane || lane.right != kNoLane));
    if (lane.points.front().y > -90) continue;  // from the south
    for (const LaneId next : lane.next) {
      const Lane& way = roads.lanes[next];
      const int turn = static_cast<int>(std::lround(Turn(way) / (M_PI / 2)));
      if (lane.cycle || way.cycle) (lane.cycle ? out : in).insert(turn);
      EXPECT_TRUE(way.cycle || !lane.cycle);
    }
  }
  EXPECT_EQ(out, (std::multiset<int>{0, 1}));
  EXPECT_EQ(in, (std::multiset<int>{-1, 0, 1}));
}

TEST(RoadBuilder, TrafficKeepsRightOfTheAxis) {
  for (const Lane& lane : Crossing(kTwoLanes).lanes) {
    if (lane.junction >= 0) continue;
    const Vec3f d = Normalized(lane.points[1] - lane.points[0]);
    // The axes go through the origin: it lies to the left of everybody.
    EXPECT_LT(d.x * lane.points[0].y - d.y * lane.points[0].x, -1.7f);
  }
}

TEST(RoadBuilder, OnlyInnerLanesTurnLeftAndOuterOnesRight) {
  const RoadNetwork roads = Crossing(kTwoLanes);
  for (const Lane& lane : roads.lanes) {
    if (lane.junction != 0 && lane.junction >= 0) continue;
    if (lane.junction < 0 && std::hypot(lane.points.back().x, lane.points.back().y) < 50) {
      const bool inner = lane.left == kNoLane;
      for (const LaneId next : lane.next) {
        const float turn = Turn(roads.lanes[next]);
        EXPECT_TRUE(inner ? turn > -0.1f : turn < 0.1f) << turn;
      }
      EXPECT_EQ(lane.next.size(), 2u);
    }
  }
}

TEST(RoadBuilder, WaysThroughAJunctionTouchTheirLanesWithoutAKink) {
  const RoadNetwork roads = Crossing(kTwoLanes);
  for (const Lane& lane : roads.lanes) {
    for (const LaneId next : lane.next) {
      const Lane& after = roads.lanes[next];
      EXPECT_EQ(lane.points.back(), after.points.front());
      const Vec3f a = Normalized(lane.points.back() - lane.points[lane.points.size() - 2]),
                  b = Normalized(after.points[1] - after.points[0]);
      // The chord of the first step of a curve: half of its bend.
      EXPECT_GT(Dot(a, b), 0.9f);
    }
  }
}

TEST(RoadBuilder, LanesLieOnTheGround) {
  const auto hill = [](Vec2f p) { return 3 * std::sin(p.x / 20) + 0.1f * p.y; };
  for (const Lane& lane : Crossing(kOneLane, hill).lanes)
    for (const Vec3f p : lane.points) EXPECT_NEAR(p.z, hill({p.x, p.y}), 1e-4f);
}

TEST(RoadBuilder, OneWayRoadsThatEndNowhereAreLeftOut) {
  RoadBuilder builder(kFlat);
  const size_t a = builder.AddJunction({0, 0}, 5), b = builder.AddJunction({100, 0}, 5), c = builder.AddJunction({200, 0}, 5);
  builder.AddRoad({.from = a, .to = b, .axis = {{5, 0}, {95, 0}}, .forward = kOneLane, .backward = kOneLane});
  builder.AddRoad({.from = b, .to = c, .axis = {{105, 0}, {195, 0}}, .forward = kOneLane, .backward = {}});
  const RoadNetwork roads = builder.Build();
  ASSERT_NO_THROW(CheckRoads(roads));
  for (const Lane& lane : roads.lanes)
    for (const Vec3f p : lane.points) EXPECT_LT(p.x, 106);
  EXPECT_GE(roads.lanes.size(), 4u);
}

// A street from west to east over one that has a carriageway each for north and south, 16 m apart; signals at the first of both crossings.
RoadNetwork DualCarriageway() {
  RoadBuilder builder(kFlat);
  const size_t west = builder.AddJunction({-100, 0}, 5), east = builder.AddJunction({100, 0}, 5), north = builder.AddJunction({0, 110}, 12),
               south = builder.AddJunction({0, -110}, 12), a = builder.AddJunction({-8, 0}, 8, CrossStreetSignals()),
               b = builder.AddJunction({8, 0}, 8);
  const auto street = [&](size_t from, size_t to, float x0, float x1) {
    builder.AddRoad({.from = from,
                     .to = to,
                     .axis = {{x0, 0}, {x1, 0}},
                     .forward = kOneLane,
                     .backward = kOneLane,
                     .signal_to = kEastWestHead,
                     .signal_from = kEastWestHead});
  };
  const auto carriageway = [&](size_t from, size_t to, float x, float y0, float y1) {
    builder.AddRoad({.from = from,
                     .to = to,
                     .axis = {{x, y0}, {x, y1}},
                     .forward = {{0, 3.5f}},
                     .backward = {},
                     .signal_to = kNorthSouthHead,
                     .signal_from = kNorthSouthHead});
  };
  street(west, a, -95, -14);
  street(a, b, -2, 2);
  street(b, east, 14, 95);
  carriageway(north, a, -8, 100, 6);
  carriageway(a, south, -8, -6, -100);
  carriageway(south, b, 8, -100, -6);
  carriageway(b, north, 8, 6, 100);
  return builder.Build();
}

// Between two junctions a few metres apart who waits for the second stands in the first: rings of such waited for ever.
TEST(RoadBuilder, JunctionsThatNoVehicleFitsBetweenAreOne) {
  const RoadNetwork roads = DualCarriageway();
  ASSERT_NO_THROW(CheckRoads(roads));
  EXPECT_EQ(roads.junctions.size(), 5u);
  int arriving = 0;
  for (const Lane& lane : roads.lanes) {
    if (lane.junction >= 0) continue;
    EXPECT_GT(Norm(lane.points.back() - lane.points.front()), kHoldsACar);
    if (std::hypot(lane.points.back().x, lane.points.back().y) > 20) continue;
    ++arriving;
    // Straight on, left and right, over both carriageways; never back on the other one.
    std::multiset<int> turns;
    for (const LaneId next : lane.next) {
      turns.insert(static_cast<int>(std::lround(Turn(roads.lanes[next]) / (M_PI / 2))));
      EXPECT_GE(roads.lanes[next].signal, 0);
      EXPECT_EQ(roads.junctions[static_cast<size_t>(roads.lanes[next].junction)].phases.size(), 2u);
    }
    EXPECT_EQ(turns, (std::multiset<int>{-1, 0, 1}));
  }
  EXPECT_EQ(arriving, 4);
}

// Within a junction of several, one-way streets lead one way too.
TEST(RoadBuilder, NobodyDrivesAgainstAOneWayStreetWithinAJunction) {
  RoadBuilder builder(kFlat);
  const size_t west = builder.AddJunction({-100, 0}, 5), a = builder.AddJunction({-5, 0}, 8), b = builder.AddJunction({5, 0}, 8),
               east = builder.AddJunction({100, 0}, 5);
  builder.AddRoad({.from = west, .to = a, .axis = {{-95, 0}, {-8, 0}}, .forward = kOneLane, .backward = kOneLane});
  builder.AddRoad({.from = a, .to = b, .axis = {{-3, 0}, {3, 0}}, .forward = kOneLane, .backward = {}});
  builder.AddRoad({.from = b, .to = east, .axis = {{8, 0}, {95, 0}}, .forward = kOneLane, .backward = kOneLane});
  const RoadNetwork roads = builder.Build();
  ASSERT_NO_THROW(CheckRoads(roads));
  for (const Lane& lane : roads.lanes) {
    if (lane.junction < 0 || std::abs(lane.points.front().x) > 20) continue;
    const bool from_east = lane.points.front().x > 0;
    EXPECT_EQ(lane.points.back().x > 0, true) << "from " << (from_east ? "the east: back" : "the west: on");
  }
}

// A ring that is entered and left on one-way roads, 12 m apart, which end at the edge of the map.
TEST(RoadBuilder, WhoLeavesTheMapOnAOneWayRoadComesBackOnTheOneBesideIt) {
  for (const float longer : {0.0f, 80.0f, -80.0f}) {
    RoadBuilder builder(kFlat);
    const size_t a = builder.AddJunction({0, 0}, 8), b = builder.AddJunction({-60, 0}, 8), out = builder.AddJunction({200, -6}, 5),
                 in = builder.AddJunction({200 + longer, 6}, 5);
    builder.AddRoad({.from = a, .to = b, .axis = {{-5, 5}, {-30, 30}, {-55, 5}}, .forward = kOneLane, .backward = {}});
    builder.AddRoad({.from = b, .to = a, .axis = {{-55, -5}, {-30, -30}, {-5, -5}}, .forward = kOneLane, .backward = {}});
    builder.AddRoad({.from = a, .to = out, .axis = {{8, -6}, {195, -6}}, .forward = {{0, 3.5f}}, .backward = {}});
    builder.AddRoad({.from = in, .to = a, .axis = {{195 + longer, 6}, {8, 6}}, .forward = {{0, 3.5f}}, .backward = {}});
    const RoadNetwork roads = builder.Build();
    ASSERT_NO_THROW(CheckRoads(roads));
    int leaving = 0;
    for (const Lane& lane : roads.lanes) {
      if (lane.junction >= 0 || lane.points.front().y > -5.5f || lane.points.back().x < 50) continue;
      ++leaving;
      ASSERT_EQ(lane.next.size(), 1u);
      const Lane& way = roads.lanes[lane.next[0]];
      EXPECT_NEAR(way.points.back().y, 6, 0.01) << longer;
      EXPECT_LT(Norm(way.points.back() - way.points.front()), 15) << longer;
    }
    EXPECT_EQ(leaving, 1) << longer;
  }
}

// Streets of maps are as short and as bent as their mappers drew them: one bad lane takes the traffic of the whole town.
TEST(RoadBuilder, WhateverIsDrawnIsANetwork) {
  RngStream random(11, "streets");
  size_t lanes = 0;
  for (int town = 0; town < 400; ++town) {
    RoadBuilder builder(kFlat);
    std::vector<Vec2f> nodes;
    const double size = std::exp(random.Uniform(0.5, 5));
    const auto place = [&] {
      return Vec2f{static_cast<float>(random.Uniform(-size, size)), static_cast<float>(random.Uniform(-size, size))};
    };
    for (int i = 0; i < 6; ++i) {
      nodes.push_back(place());
      builder.AddJunction(nodes.back(), 8);
    }
    for (int i = 0; i < 9; ++i) {
      const size_t from = random.Index(6), to = random.Index(6);
      const Vec2f stub{static_cast<float>(random.Uniform(-1, 1)), static_cast<float>(random.Uniform(-1, 1))};
      std::vector<Vec2f> axis{nodes[from] + stub};
      for (size_t k = random.Index(4); k-- > 0;) axis.push_back(place());
      axis.push_back(nodes[to] - stub);
      const std::vector<RoadLane>& some = random.Chance(0.5) ? kOneLane : kTwoLanes;
      builder.AddRoad(
          {.from = from, .to = to, .axis = axis, .forward = some, .backward = random.Chance(0.3) ? std::vector<RoadLane>{} : some});
    }
    const RoadNetwork roads = builder.Build();
    EXPECT_NO_THROW(CheckRoads(roads)) << "town " << town << " of " << size << " m";
    lanes += roads.lanes.size();
  }
  EXPECT_GT(lanes, 10000u);
}

}  // namespace
}  // namespace airsim360

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

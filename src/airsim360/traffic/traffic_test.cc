#include "airsim360/traffic/traffic.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "airsim360/traffic/near_misses.h"
#include "airsim360/traffic/test_roads.h"

namespace airsim360 {
namespace {

TEST(CarFollowing, AtTheEquilibriumGapNobodyAccelerates) {
  const Driver driver;
  for (const double v : {0.0, 1.0, 5.0, 10.0, 13.0})
    EXPECT_NEAR(IdmAcceleration(driver, v, 13.9, EquilibriumGap(driver, v, 13.9), v), 0, 1e-12) << v;
}

TEST(CarFollowing, BrakesHarderForLessRoomAndNeverBeyondTheHardest) {
  const Driver driver;
  double before = INFINITY;
  for (double gap = 200; gap > 0.01; gap *= 0.7) {
    const double a = IdmAcceleration(driver, 13, 13.9, gap, 0);
    EXPECT_LE(a, before);
    EXPECT_GE(a, -kHardestBraking);
    before = a;
  }
  EXPECT_EQ(IdmAcceleration(driver, 13, 13.9, -5, 0), -kHardestBraking);
}

TEST(LaneChange, PaysOnlyForMoreThanItCostsOthersAndNeverForcesHardBraking) {
  const Driver driver{.politeness = 0.5};
  EXPECT_TRUE(PaysToChange(driver, {.own_before = -1, .own_after = 0.5}));
  EXPECT_FALSE(PaysToChange(driver, {.own_before = 0, .own_after = 0.1}));
  EXPECT_FALSE(PaysToChange(driver, {.own_before = -1, .own_after = 0.5, .new_follower_before = 0, .new_follower_after = -2.8}));
  EXPECT_FALSE(PaysToChange(driver, {.own_before = -9, .own_after = 1, .new_follower_before = 0, .new_follower_after = -3.5}));
}

// On a ring everybody comes to the same speed: that of which the equilibrium gap is the room that each has.
TEST(Traffic, FlowOverDensityOnARingIsTheModelsFundamentalDiagram) {
  constexpr double kLength = 1200;
  for (const size_t count : {10u, 30u, 60u, 90u, 120u}) {
    const TrafficModel model = ModelOf(RingRoad(kLength, 13.9f), count);
    TrafficState state = StartTraffic(ModelOf(RingRoad(kLength * 2, 13.9f), count));
    const double circumference = model.lanes.length(0) + model.lanes.length(1), room = circumference / static_cast<double>(count);
    for (size_t i = 0; i < count; ++i) {
      const double s = room * static_cast<double>(i);
      const bool second = s >= model.lanes.length(0);
      state.vehicles[i] = {
          .lane = second, .ahead = {!second, second}, .behind = {!second, second, !second}, .s = second ? s - model.lanes.length(0) : s};
    }
    Drive(model, 300, state);
    // Bisection of the equilibrium speed.
    double low = 0, high = 13.89;
    const double gap = room - model.vehicles[0].shape.length;
    for (int k = 0; k < 60; ++k) {
      const double v = (low + high) / 2;
      (EquilibriumGap(model.vehicles[0].driver, v, model.lanes.speed(0)) < gap ? low : high) = v;
    }
    double mean = 0;
    for (const DrivingVehicle& vehicle : state.vehicles) mean += vehicle.v / static_cast<double>(count);
    EXPECT_NEAR(mean, low, 0.02 * low + 0.02) << count;
  }
}

TEST(Traffic, StopsBeforeARedLightAndGoesAtGreen) {
  const TrafficModel model = ModelOf(Street(300, {{0, 40, 0, 0}, {1, 30, 3, 2}}), 1);
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 100, .v = 13}};
  double hardest = 0;
  while (state.t_ns < 39'000'000'000) {
    TickTraffic(model, {}, state);
    hardest = std::min(hardest, state.vehicles[0].a);
  }
  EXPECT_EQ(state.vehicles[0].lane, 0u);
  EXPECT_LT(state.vehicles[0].v, 0.05);
  EXPECT_NEAR(state.vehicles[0].s, 299, 1.5);
  EXPECT_GT(hardest, -3.5);
  EXPECT_TRUE(state.vehicles[0].braking);
  Drive(model, 10, state);
  EXPECT_NE(state.vehicles[0].lane, 0u);
}

// 100 m, a way of 10 m that no other meets, 6 m to the line of a junction with a red light, and a way back.
std::shared_ptr<const RoadNetwork> ShortRoadToARedLight(float length, float speed = 13.9f) {
  auto roads = std::make_shared<RoadNetwork>();
  const float line = 110 + length;
  roads->lanes = {{.points = {{0, 0, 0}, {100, 0, 0}}, .speed = speed, .next = {1}},
                  {.points = {{100, 0, 0}, {110, 0, 0}}, .speed = speed, .next = {2}, .junction = 0},
                  {.points = {{110, 0, 0}, {line, 0, 0}}, .next = {3}},
                  {.points = {{line, 0, 0}, {line + 10, 0, 0}}, .next = {4}, .junction = 1, .signal = 0},
                  {.points = {{line + 10, 0, 0}, {2000, 0, 0}, {2000, 900, 0}, {0, 900, 0}, {0, 0, 0}}, .next = {0}}};
  roads->junctions = {{.center = {105, 0, 0}, .radius = 5, .phases = {}},
                      {.center = {line + 5, 0, 0}, .radius = 5, .phases = {{2, 600, 3, 2}}}};
  return roads;
}

// On a road of 6 m nobody stops from 50 km/h.
TEST(Traffic, ComesToAShortRoadSoSlowlyThatItCanStopAtItsEnd) {
  for (const float length : {3.0f, 6.0f, 12.0f, 25.0f}) {
    const TrafficModel model = ModelOf(ShortRoadToARedLight(length), 1);
    TrafficState state;
    state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 20, .v = 13}};
    while (state.t_ns < 60'000'000'000) {
      TickTraffic(model, {}, state);
      ASSERT_NE(state.vehicles[0].lane, 3u) << length;
    }
    EXPECT_EQ(state.vehicles[0].lane, 2u) << length;
    EXPECT_LT(state.vehicles[0].v, 0.1) << length;
  }
}

// A junction is kept free for others. Where there are none, as between the pieces of one street, the queue stands on the way as well.
TEST(Traffic, AQueueStandsOnAWayThatNobodyElseUses) {
  const TrafficModel model = ModelOf(ShortRoadToARedLight(6, 5), 2);
  TrafficState state;
  for (const double s : {80.0, 10.0}) state.vehicles.push_back({.lane = 0, .ahead = {1, 2}, .s = s, .v = 5});
  Drive(model, 60, state);
  EXPECT_EQ(state.vehicles[0].lane, 2u);
  EXPECT_EQ(state.vehicles[1].lane, 1u);
}

TEST(Traffic, AtAmberWhoCanStopStopsAndWhoCannotGoesOn) {
  for (const double distance : {60.0, 15.0}) {
    const TrafficModel model = ModelOf(Street(300, {{1, 1, 3, 60}}), 1);
    TrafficState state;
    state.t_ns = 1'000'000'000;
    state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 300 - distance, .v = 13}};
    Drive(model, 20, state);
    EXPECT_EQ(state.vehicles[0].lane == 0, distance > 50) << distance;
  }
}

TEST(Traffic, StopsForSomebodyInTheStreetAndNotForSomebodyBesideOrAboveIt) {
  const TrafficModel model = ModelOf(Street(900, {}), 1);
  const auto passes = [&](Vec3d p, Vec3d v = {}) {
    TrafficState state;
    state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 100, .v = 12}};
    const TrafficObstacle obstacle{p, v};
    Drive(model, 40, state, std::span(&obstacle, 1));
    if (state.vehicles[0].s < p.x) {
      EXPECT_LT(state.vehicles[0].v, 0.05);
      EXPECT_GT(state.vehicles[0].s, p.x - 4);
    }
    return state.vehicles[0].s > p.x;
  };
  EXPECT_FALSE(passes({200, 0, 0}));
  EXPECT_FALSE(passes({200, 1, 0}));
  EXPECT_TRUE(passes({200, 2.5, 0}));
  EXPECT_TRUE(passes({200, 0, 6}));
  EXPECT_FALSE(passes({200, 2.4, 0}, {0, -1.4, 0}));  // about to step into the lane
  EXPECT_TRUE(passes({200, 1.2, 0}));                 // close beside it: at a walking pace
}

TEST(Traffic, CrawlsPastSomebodyWhoStandsCloseBesideIt) {
  const TrafficModel model = ModelOf(Street(900, {}), 1);
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 100, .v = 12}};
  const TrafficObstacle person{{200, 1.2, 0}, {}};
  const DrivingVehicle& car = state.vehicles[0];
  while (state.t_ns < 60'000'000'000) {
    TickTraffic(model, std::span(&person, 1), state);
    const bool beside = car.s > 199 && car.s - model.vehicles[0].shape.length < 199;
    EXPECT_TRUE(!beside || car.v < 2.5) << car.s;  // from 12
  }
  EXPECT_GT(car.s, 250);
}

// A bus that turns waits for somebody on the street that it comes to; a car behind it wants to go straight on. It does where the
// tail of the bus leaves room, and waits else; either way the two never touch.
TEST(Traffic, WhoGoesAnotherWayWaitsUntilTheTailInFrontIsOutOfIt) {
  TrafficModel model = ModelOf(Fork(), 2);
  model.vehicles[0].shape.length = 12.2, model.vehicles[0].shape.width = 3;
  const double way = model.lanes.length(2);
  for (const double rear : {0.5, 3.0, 6.0, 9.0, 12.0}) {
    const double front = rear + 12.2;
    TrafficState state;
    state.vehicles = {{.lane = 2, .ahead = {4, 0}, .behind = {0, 3, kNoLane}, .s = front}, {.lane = 0, .ahead = {1, 3}, .s = 20, .v = 10}};
    if (front > way) state.vehicles[0] = {.lane = 4, .ahead = {0, 1}, .behind = {2, 0, 3}, .s = front - way};
    const TrafficObstacle person{model.lanes.At(4, std::max(front - way, 0.0) + 1).p, {}};
    for (int tick = 0; tick < 40 * 20; ++tick) {
      TickTraffic(model, std::span(&person, 1), state);
      std::array<internal::GroundBox, 2> boxes;
      for (size_t i = 0; i < 2; ++i) {
        const RigidTransform X = PoseOf(model, state, i, state.t_ns);
        const VehicleShape& shape = model.vehicles[i].shape;
        boxes[i] = {{X.p.x, X.p.y}, {X.R.column(0).x, X.R.column(0).y}, shape.length / 2, shape.width / 2};
      }
      ASSERT_FALSE(internal::ContactOf(boxes[0], boxes[1], {0, 0}).has_value()) << rear << ", tick " << tick;
    }
    EXPECT_EQ(state.vehicles[1].lane == 3, rear > 8) << rear;
  }
}

// People do not look: somebody walks into a car that has stopped for them, through it and out at its tail.
TEST(Traffic, WaitsUntilWhoeverWalkedIntoItIsOutAgain) {
  const TrafficModel model = ModelOf(Street(900, {}), 1);
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 100, .v = 0}};
  const double length = model.vehicles[0].shape.length;
  for (double x = 103; x > 90; x -= 1.2 * 0.05) {
    const TrafficObstacle person{{x, 0.3, 0}, {-1.2, 0, 0}};
    TickTraffic(model, std::span(&person, 1), state);
    const bool inside = x > state.vehicles[0].s - length - 0.2;
    EXPECT_TRUE(!inside || state.vehicles[0].v < 0.01) << x;
  }
  EXPECT_GT(state.vehicles[0].v, 2);
}

// Its rear axle cuts the bend: who stands where the way of its middle is, beside the body, holds it up no longer. Behind, its tail swings out.
TEST(Traffic, ABusInABendGoesOnPastWhoStandsBesideItsBody) {
  TrafficModel model = ModelOf(Fork(), 1);
  model.vehicles[0].shape = {.length = 12.1, .width = 2.5, .height = 3.2, .bus = true};
  TrafficState state;
  state.vehicles = {{.lane = 2, .ahead = {4, 0}, .behind = {0, kNoLane, kNoLane}, .s = 14}};
  const internal::GroundBox body = FootprintOf(model, state, 0);
  int beside = 0;
  for (double back = 4; back <= 6.5; back += 0.5) {
    for (double out = -3; out <= 3; out += 0.1) {
      const LanePoint at = model.lanes.At(2, 14 - back);
      const Vec3d p = at.p + Vec3d{-at.direction.y, at.direction.x, 0} * out;
      // Clear of the body by more than a shoulder, yet nearer to the middle of the way than half of its width.
      if (internal::ContactOf(body, {p.x, p.y}, 0.35, {0, 0}) || std::abs(out) > 1.25) continue;
      ++beside;
      const TrafficObstacle person{.p = p, .v = {}};
      TrafficState driven = state;
      Drive(model, 20, driven, {&person, 1});
      EXPECT_EQ(driven.vehicles[0].lane, 4u) << back << " " << out;
    }
  }
  EXPECT_GT(beside, 0);
}

TEST(Traffic, InABendTheMiddleOfABusMovesSlowerThanItsFront) {
  constexpr double kRadius = 7;
  auto roads = std::make_shared<RoadNetwork>();
  for (int half = 0; half < 2; ++half) {
    Lane lane{.points = {}, .speed = 6, .next = {static_cast<LaneId>(1 - half)}};
    for (int i = 0; i <= 200; ++i) {
      const double a = std::numbers::pi * (half + i / 200.0);
      lane.points.push_back({static_cast<float>(kRadius * std::cos(a)), static_cast<float>(kRadius * std::sin(a)), 0});
    }
    roads->lanes.push_back(lane);
  }
  TrafficModel model = ModelOf(roads, 1);
  const VehicleShape shape = {.length = 12.1, .width = 2.5, .height = 3.2, .bus = true};
  model.vehicles[0].shape = shape;
  TrafficState state = StartTraffic(model);
  Drive(model, 30, state);
  // Both axles are on the circle; the middle of the bus is ahead of theirs by `ahead`.
  const double half = shape.wheelbase() / 2, ahead = shape.length / 2 - shape.front_overhang() - half;
  const double middle = std::sqrt(kRadius * kRadius - half * half + ahead * ahead);
  EXPECT_LT(middle, 0.95 * kRadius);
  for (int tick = 0; tick < 100; ++tick) {
    const TrafficState before = state;
    TickTraffic(model, {}, state);
    const Vec3d v = VelocityOf(model, before, 0), p = PoseOf(model, before, 0, before.t_ns).p;
    EXPECT_NEAR(Norm(v), before.vehicles[0].v * middle / kRadius, 0.02 * before.vehicles[0].v) << tick;
    EXPECT_LT(std::abs(Dot(Normalized(v), Normalized(p))), 0.05) << tick;  // it goes round
    const Vec3d moved = (PoseOf(model, state, 0, state.t_ns).p - p) / (kTrafficTickNs * 1e-9);
    EXPECT_LT(Norm(moved - v), 0.1) << tick;
  }
}

}  // namespace
}  // namespace airsim360

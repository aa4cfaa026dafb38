// Bicycles among vehicles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/traffic/near_misses.h"
#include "airsim360/traffic/test_roads.h"

namespace airsim360 {
namespace {

constexpr TrafficVehicle kBicycle{.shape = {.length = 1.8, .width = 0.65, .height = 1.75, .bicycle = true},
                                  .driver = {.top_speed = 5, .acceleration = 0.8}};

TEST(Bicycles, RideAMetreRightOfTheMiddleAtTheirOwnSpeed) {
  TrafficModel model = ModelOf(Street(900, {}), 1);
  model.vehicles[0] = kBicycle;
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 20}};
  Drive(model, 30, state);
  EXPECT_NEAR(state.vehicles[0].v, 5, 0.1);  // the street allows 13.9
  const RigidTransform X = PoseOf(model, state, 0, state.t_ns);
  EXPECT_NEAR(X.p.y, -1, 1e-9);
  EXPECT_NEAR(X.R.column(0).x, 1, 1e-9);
}

// Round a bend the way of a bicycle is a circle with another radius; it never turns on the spot.
TEST(Bicycles, KeepTheirDistanceFromTheMiddleInBends) {
  TrafficModel model = ModelOf(RingRoad(200, 13.9f), 1);
  model.vehicles[0] = kBicycle;
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {1, 0}, .behind = {1, 0, 1}, .s = 20}};
  for (int tick = 0; tick < 1000; ++tick) {
    TickTraffic(model, {}, state);
    const RigidTransform X = PoseOf(model, state, 0, state.t_ns);
    EXPECT_NEAR(std::hypot(X.p.x, X.p.y), 200 / (2 * M_PI) + 1, 0.1);
    EXPECT_GT(std::abs(X.R.column(0).x * X.p.y - X.R.column(0).y * X.p.x) / std::hypot(X.p.x, X.p.y), 0.99);
  }
}

// Of the forces on a rider none is to the side: tan(lean) = v^2 / (r g), into the bend.
TEST(Bicycles, LeanIntoBendsAsTheirWeightBalances) {
  for (const double top_speed : {3.0, 5.0}) {
    TrafficModel model = ModelOf(RingRoad(200, 13.9f), 1);
    model.vehicles[0] = kBicycle;
    model.vehicles[0].driver.top_speed = top_speed;
    TrafficState state;
    state.vehicles = {{.lane = 0, .ahead = {1, 0}, .behind = {1, 0, 1}, .s = 20}};
    Drive(model, 40, state);
    const double v = state.vehicles[0].v, radius = 200 / (2 * M_PI) + 1, expected = std::atan(v * v / (radius * 9.81));
    EXPECT_NEAR(v, top_speed, 0.1);
    for (int tick = 0; tick < 200; ++tick) {
      TickTraffic(model, {}, state);
      for (const int64_t later : {int64_t{0}, kTrafficTickNs / 2}) {
        const RigidTransform X = PoseOf(model, state, 0, state.t_ns + later);
        const Vec3d inwards = Normalized(Vec3d{-X.p.x, -X.p.y, 0}), up = X.R.column(2);
        EXPECT_NEAR(std::atan2(Dot(up, inwards), up.z), expected, 0.06 * expected);
        EXPECT_NEAR(X.R.determinant(), 1, 1e-12);
      }
    }
  }
}

TEST(Bicycles, StandUprightWhereItIsStraightAndLeanToTheRightInARightTurn) {
  TrafficModel model = ModelOf(Fork(), 1);
  model.vehicles[0] = kBicycle;
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {2, 4}, .s = 20, .v = 4}};
  double most = 0, last = 0;
  for (int tick = 0; tick < 50 * 20; ++tick) {
    TickTraffic(model, {}, state);
    const Mat3d R = PoseOf(model, state, 0, state.t_ns).R;
    const double right = std::atan2(R.column(1).z, R.column(2).z);
    EXPECT_LT(std::abs(right - last), 0.02) << tick;  // never at once
    EXPECT_GT(right, -1e-9);
    if (state.vehicles[0].lane == 0 && state.vehicles[0].s < 90) {
      EXPECT_NEAR(right, 0, 1e-9);
    }
    most = std::max(most, right);
    last = right;
  }
  EXPECT_EQ(state.vehicles[0].lane, 4u);
  EXPECT_NEAR(last, 0, 1e-9);
  // A metre right of a middle that bends with a radius of 10 m, at 2 m/s^2 sideways at most.
  EXPECT_GT(most, 0.6 * std::atan(2 / 9.81));
  EXPECT_LT(most, 1.15 * std::atan(2 / 9.81));
}

TEST(Bicycles, StopForWhoStandsAtTheEdgeAndNotForWhoStandsInTheMiddle) {
  TrafficModel model = ModelOf(Street(900, {}), 1);
  model.vehicles[0] = kBicycle;
  const auto passes = [&](double y) {
    TrafficState state;
    state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 100, .v = 5}};
    const TrafficObstacle person{{150, y, 0}, {}};
    Drive(model, 40, state, std::span(&person, 1));
    return state.vehicles[0].s > 160;
  };
  EXPECT_FALSE(passes(-1));
  EXPECT_TRUE(passes(0.2));
}

TEST(Bicycles, AreOvertakenWhereThereIsALaneForItAndFollowedElsewhere) {
  for (const bool wide : {true, false}) {
    TrafficModel model = ModelOf(wide ? TwoLanes() : Street(900, {}), 2);
    model.vehicles[0] = kBicycle;
    TrafficState state;
    const LaneId lane = wide ? 1 : 0;
    const std::array<LaneId, 2> ahead = wide ? std::array<LaneId, 2>{3, 1} : std::array<LaneId, 2>{1, 2};
    state.vehicles = {{.lane = lane, .ahead = ahead, .s = 80, .v = 5}, {.lane = lane, .ahead = ahead, .s = 30, .v = 12}};
    bool passed = false;
    double least = INFINITY;
    for (int tick = 0; tick < 60 * 20; ++tick) {
      TickTraffic(model, {}, state);
      const RigidTransform bicycle = PoseOf(model, state, 0, state.t_ns), car = PoseOf(model, state, 1, state.t_ns);
      const double beside = std::abs(car.p.y - bicycle.p.y) - (1.8 + 0.65) / 2, along = std::abs(car.p.x - bicycle.p.x) - (4.5 + 1.8) / 2;
      if (along < 0) least = std::min(least, beside);
      passed |= car.p.x - bicycle.p.x > 10;
    }
    EXPECT_EQ(passed, wide);
    EXPECT_GT(least, 1.0) << wide;  // a metre and more beside it, or never beside it
  }
}

// Two lanes of which that on the right is for bicycles alone.
std::shared_ptr<const RoadNetwork> WithCycleLane() {
  auto roads = std::make_shared<RoadNetwork>(*TwoLanes());
  for (const LaneId id : {1u, 3u}) roads->lanes[id].cycle = true;
  return roads;
}

TEST(Bicycles, TakeTheCycleLaneAndRideInItsMiddle) {
  TrafficModel model = ModelOf(WithCycleLane(), 1);
  model.vehicles[0] = kBicycle;
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {2, 0}, .s = 30, .v = 5}};
  double last = PoseOf(model, state, 0, 0).p.y;
  EXPECT_NEAR(last, -1, 1e-9);
  for (int tick = 0; tick < 40 * 20; ++tick) {
    TickTraffic(model, {}, state);
    const double y = PoseOf(model, state, 0, state.t_ns).p.y;
    EXPECT_LT(std::abs(y - last), 0.1) << tick;  // sideways without a jump
    last = y;
  }
  EXPECT_EQ(state.vehicles[0].lane, 1u);
  EXPECT_NEAR(last, -3.2, 1e-6);
}

TEST(Bicycles, CarsKeepOutOfCycleLanesAndPassThoseWhoRideThere) {
  TrafficModel model = ModelOf(WithCycleLane(), 3);
  model.vehicles[0] = kBicycle;
  TrafficState state;
  state.vehicles = {{.lane = 1, .ahead = {3, 1}, .s = 120, .v = 5},
                    {.lane = 0, .ahead = {2, 0}, .s = 100, .v = 5},
                    {.lane = 0, .ahead = {2, 0}, .s = 40, .v = 13}};
  model.vehicles[1].driver.speed_factor = 0.4;  // somebody whom the other would overtake
  for (int tick = 0; tick < 30 * 20; ++tick) {
    TickTraffic(model, {}, state);
    for (const size_t car : {1u, 2u}) EXPECT_FALSE(model.lanes.lane(state.vehicles[car].lane).cycle);
  }
  EXPECT_GT(state.vehicles[1].s + 600 * (state.vehicles[1].lane != 0), 255);  // 30 s behind the bicycle would be 120 + 150 at the most
  EXPECT_TRUE(model.lanes.lane(state.vehicles[0].lane).cycle);
}

// Where lanes for bicycles end they come back to the edge of the lane of all, over some metres.
TEST(Bicycles, ComeBackToTheEdgeWhereACycleLaneEnds) {
  auto roads = std::make_shared<RoadNetwork>();
  roads->lanes = {{.points = {{0, 0, 0}, {100, 0, 0}}, .next = {1}, .cycle = true},
                  {.points = {{100, 0, 0}, {400, 0, 0}}, .next = {2}},
                  {.points = {{400, 0, 0}, {400, 900, 0}, {0, 900, 0}, {0, 0, 0}}, .next = {0}}};
  TrafficModel model = ModelOf(std::shared_ptr<const RoadNetwork>(roads), 1);
  model.vehicles[0] = kBicycle;
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 60, .v = 5}};
  EXPECT_NEAR(PoseOf(model, state, 0, 0).p.y, 0, 1e-9);
  double last = 0;
  for (int tick = 0; tick < 20 * 20; ++tick) {
    TickTraffic(model, {}, state);
    const RigidTransform X = PoseOf(model, state, 0, state.t_ns);
    EXPECT_LT(std::abs(X.p.y - last), 0.08);
    EXPECT_GT(X.R.column(0).x, 0.95);
    last = X.p.y;
  }
  EXPECT_NEAR(last, -1, 1e-9);
}

TEST(Bicycles, ChangeToTheLaneOnTheRightAndStayThere) {
  TrafficModel model = ModelOf(TwoLanes(), 2);
  model.vehicles = {kBicycle, kBicycle};
  model.vehicles[1].driver.top_speed = 3.5;
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {2, 0}, .s = 30, .v = 5}, {.lane = 1, .ahead = {3, 1}, .s = 120, .v = 3.5}};
  Drive(model, 60, state);
  EXPECT_EQ(state.vehicles[0].lane, 1u);
  EXPECT_LT(state.vehicles[0].s, state.vehicles[1].s);  // not past the slower one
}

}  // namespace
}  // namespace airsim360

// Wheels and cranks of bicycles.
#include "airsim360/traffic/pedalling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "airsim360/traffic/test_roads.h"

namespace airsim360 {
namespace {

constexpr TrafficVehicle kCyclist{.shape = {.length = 1.8, .width = 0.65, .height = 1.75, .bicycle = true},
                                  .driver = {.top_speed = 5, .acceleration = 0.8}};

TrafficModel OneCyclist(std::shared_ptr<const RoadNetwork> roads) {
  TrafficModel model = ModelOf(std::move(roads), 1);
  model.vehicles[0] = kCyclist;
  return model;
}

// Round a circle the wheels roll along the circle of the bicycle, which is a metre wider than that of its lane.
TEST(Pedalling, WheelsRollWithoutSlip) {
  const TrafficModel model = OneCyclist(RingRoad(200, 13.9f));
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {1, 0}, .behind = {1, 0, 1}, .s = 20}};
  double way = 0, angle = 0, last_angle = 0;
  Vec3d last = PoseOf(model, state, 0, 0).p;
  for (int tick = 0; tick < 1200; ++tick) {
    // Between ticks too, at four times the rate: a chord is as long as what rolls over it.
    for (int k = 1; k <= 4; ++k) {
      if (k == 4) TickTraffic(model, {}, state);
      const int64_t t_ns = state.t_ns + (k == 4 ? 0 : k * kTrafficTickNs / 4);
      const Vec3d p = PoseOf(model, state, 0, t_ns).p;
      const double wheel = CyclingOf(model, state, 0, t_ns).wheel;
      EXPECT_NEAR((wheel - last_angle) * kCyclist.shape.wheel_radius, Norm(p - last), 2e-3) << tick << ' ' << k;
      way += Norm(p - last);
      last = p;
      last_angle = wheel;
    }
  }
  angle = CyclingOf(model, state, 0, state.t_ns).wheel;
  EXPECT_GT(way, 250);
  EXPECT_NEAR(angle * kCyclist.shape.wheel_radius, way, 0.002 * way);
}

TEST(Pedalling, CranksTurnWithTheWheelsThroughTheGearWhileOnePushes) {
  const TrafficModel model = OneCyclist(Street(900, {}));
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 20}};
  for (int tick = 0; tick < 400; ++tick) {
    TickTraffic(model, {}, state);
    const Cycling now = CyclingOf(model, state, 0, state.t_ns);
    ASSERT_NEAR(now.crank * kCyclist.shape.gear, now.wheel, 1e-9);
  }
  // 5 m/s in this gear: 63 turns a minute.
  const double before = state.vehicles[0].crank;
  Drive(model, 60, state);
  EXPECT_NEAR((state.vehicles[0].crank - before) / (2 * M_PI), 5 * 60 / (2 * M_PI * 0.345 * 2.2), 1);
}

TEST(Pedalling, WhoSlowsDownCoastsAndCranksNeverOutrunTheWheels) {
  const TrafficModel model = OneCyclist(Street(900, {}));
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 20, .v = 5}};
  const TrafficObstacle person{{120, -1, 0}, {}};
  bool coasted = false;
  double last_crank = 0, last_wheel = 0;
  for (int k = 0; k < 2 * 60 * 20; ++k) {
    // At each tick and 49 ms after it: between ticks the bicycle goes on at its speed, so that one that brakes is a few millimetres
    // farther than where the next tick finds it.
    const bool between = k % 2 == 1;
    if (!between) TickTraffic(model, std::span(&person, 1), state);
    const Cycling now = CyclingOf(model, state, 0, state.t_ns + (between ? 49'000'000 : 0));
    // Cranks never turn back, but for what the wheels do, nor faster than the wheels drive them.
    const double turned = (now.crank - last_crank) * kCyclist.shape.gear, rolled = now.wheel - last_wheel;
    EXPECT_GE(turned, std::min(0.0, rolled) - 1e-9) << k;
    EXPECT_LE(turned, std::max(0.0, rolled) + 1e-9) << k;
    EXPECT_GT(rolled * kCyclist.shape.wheel_radius, -0.02) << k;
    coasted |= now.crank == last_crank && rolled > 0.1;
    last_crank = now.crank;
    last_wheel = now.wheel;
  }
  EXPECT_TRUE(coasted);
  EXPECT_LT(state.vehicles[0].v, 0.1);
}

TEST(Pedalling, CranksStopAtLevelWhereverTheyComeFrom) {
  for (double crank = 0; crank < 4 * M_PI; crank += 0.37) {
    const double after = internal::CrankAfter(kCyclist.shape, crank, 100, 4, -1);
    EXPECT_NEAR(std::cos(after), 0, 1e-9);
    EXPECT_GE(after, crank);
    EXPECT_LT(after, crank + M_PI + 1e-9);
    EXPECT_EQ(internal::CrankAfter(kCyclist.shape, after, 100, 4, -1), after);
    // In many steps as in one.
    double steps = crank;
    for (int k = 0; k < 1000; ++k) steps = internal::CrankAfter(kCyclist.shape, steps, 0.1, 4, -1);
    EXPECT_NEAR(steps, after, 1e-9);
    EXPECT_NEAR(internal::CrankAfter(kCyclist.shape, crank, 1, 4, 0.5), crank + 1 / (0.345 * 2.2), 1e-12);
    EXPECT_EQ(internal::CrankAfter(kCyclist.shape, crank, -1, 4, 0.5), crank);
  }
}

}  // namespace
}  // namespace airsim360

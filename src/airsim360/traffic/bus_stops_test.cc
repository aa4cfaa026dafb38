#include "airsim360/traffic/bus_stops.h"

#include <gtest/gtest.h>

#include <array>

#include "airsim360/traffic/test_roads.h"

namespace airsim360 {
namespace {

constexpr VehicleShape kBus{.length = 12, .width = 2.5, .height = 3, .bus = true};

TrafficModel WithStops(std::shared_ptr<const RoadNetwork> roads, std::vector<BusStop> stops, size_t buses = 1) {
  TrafficModel model = ModelOf(std::move(roads), buses);
  for (TrafficVehicle& vehicle : model.vehicles) vehicle.shape = kBus;
  model.bus_stops = std::move(stops);
  return model;
}

struct Halt {
  double s = 0, seconds = 0;
  LaneId lane = kNoLane;
};

// Every rest of a vehicle within so many seconds.
std::vector<Halt> HaltsOf(const TrafficModel& model, TrafficState state, double seconds, size_t vehicle = 0) {
  std::vector<Halt> halts;
  bool rests = false;
  for (int tick = 0; tick < static_cast<int>(seconds * 20); ++tick) {
    TickTraffic(model, {}, state);
    const DrivingVehicle& v = state.vehicles[vehicle];
    if (v.v < 0.01 && !rests) halts.push_back({v.s, 0, v.lane});
    rests = v.v < 0.01;
    if (rests) halts.back().seconds += 0.05;
  }
  return halts;
}

TEST(BusStops, ABusHaltsAtEachStopOnceAndACarAtNone) {
  TrafficModel model = WithStops(Street(300, {}), {{0, 150}, {0, 250}, {2, 60}});
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 50, .v = 12}};
  const std::vector<Halt> halts = HaltsOf(model, state, 120);
  ASSERT_EQ(halts.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(halts[i].lane, model.bus_stops[i].lane);
    EXPECT_NEAR(halts[i].s, model.bus_stops[i].s - 0.7, 0.8) << i;
    EXPECT_GT(halts[i].seconds, 7.9);
    EXPECT_LT(halts[i].seconds, 21);
  }
  model.vehicles[0].shape.bus = false;
  EXPECT_TRUE(HaltsOf(model, state, 120).empty());
}

TEST(BusStops, ABusBrakesComfortablyAndPassesAStopThatComesTooSoon) {
  const TrafficModel model = WithStops(Street(900, {}), {{0, 110}});
  for (const double s : {0.0, 95.0}) {
    TrafficState state;
    state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = s, .v = 13}};
    EXPECT_EQ(HaltsOf(model, state, 40).size(), s < 50) << s;
    double hardest = 0;
    for (int tick = 0; tick < 600; ++tick) {
      TickTraffic(model, {}, state);
      hardest = std::min(hardest, state.vehicles[0].a);
    }
    EXPECT_GT(hardest, -3.5) << s;
  }
}

TEST(BusStops, WhoDrivesBehindWaitsAndTwoBusesHaltOneAfterTheOther) {
  const TrafficModel model = WithStops(Street(900, {}), {{0, 200}}, 2);
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 80, .v = 12}, {.lane = 0, .ahead = {1, 2}, .s = 50, .v = 12}};
  double nearest = 1000;
  for (TrafficState driven = state; driven.t_ns < 40'000'000'000;) {
    TickTraffic(model, {}, driven);
    nearest = std::min(nearest, driven.vehicles[0].s - kBus.length - driven.vehicles[1].s);
  }
  EXPECT_GT(nearest, 1);
  const std::vector<Halt> second = HaltsOf(model, state, 90, 1);
  ASSERT_FALSE(second.empty());
  EXPECT_NEAR(second.back().s, 199.3, 0.8);
}

// The stop is 12 m before a junction: meanwhile its way is free for others.
TEST(BusStops, AHaltDoesNotHoldTheJunctionThatComes) {
  const TrafficModel model = WithStops(Street(300, {}), {{0, 288}});
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 150, .v = 12}};
  int halted = 0;
  while (state.vehicles[0].lane == 0) {
    TickTraffic(model, {}, state);
    if (state.vehicles[0].halts_until_ns < 0) continue;
    ++halted;
    EXPECT_FALSE(state.vehicles[0].granted);
    EXPECT_EQ(state.vehicles[0].indicator, -1);
    ASSERT_LT(state.t_ns, 120'000'000'000);
  }
  EXPECT_GE(halted, 8 * 20);
}

TEST(BusStops, ABusChangesToTheLaneOfItsStopAndACarDoesNot) {
  for (const bool bus : {true, false}) {
    TrafficModel model = WithStops(TwoLanes(), {{1, 400}});
    model.vehicles[0].shape.bus = bus;
    TrafficState state;
    state.vehicles = {{.lane = 0, .ahead = {2, 0}, .s = 40, .v = 12}};
    const std::vector<Halt> halts = HaltsOf(model, state, 60);
    EXPECT_EQ(halts.size(), bus);
    for (const Halt& halt : halts) EXPECT_EQ(halt.lane, 1u);
  }
}

TEST(BusStops, SignsAreServedFromTheLaneBesideThem) {
  const LaneMap lanes(TwoLanes());
  const auto stops = [&](Vec3d p) { return BusStopsBeside(lanes, std::array{p}); };
  ASSERT_EQ(stops({300, -7, 0}).size(), 1u);
  EXPECT_EQ(stops({300, -7, 0})[0].lane, 1u);
  EXPECT_NEAR(stops({300, -7, 0})[0].s, 302, 1e-9);
  EXPECT_TRUE(stops({300, 4, 0}).empty());    // on the left
  EXPECT_TRUE(stops({300, -13, 0}).empty());  // too far
  EXPECT_TRUE(stops({300, -7, 10}).empty());  // of a street below
  EXPECT_TRUE(stops({5, -7, 0}).empty());     // a bus would stand in the junction
  ASSERT_EQ(stops({597, -6, 0}).size(), 1u);
  EXPECT_NEAR(stops({597, -6, 0})[0].s, 598, 1e-9);  // not beyond the end
}

}  // namespace
}  // namespace airsim360

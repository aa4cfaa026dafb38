#include <gtest/gtest.h>

#include "airsim360/traffic/near_misses.h"
#include "airsim360/traffic/test_roads.h"

namespace airsim360 {
namespace {

using internal::ContactOf;

// A quarter of a circle from (x, y) with the heading `from` degrees, `turn` +1 to the left.
std::vector<Vec3f> Quarter(double x, double y, double from, double radius, int turn) {
  std::vector<Vec3f> points;
  const double a0 = from * std::numbers::pi / 180, cx = x - turn * radius * std::sin(a0), cy = y + turn * radius * std::cos(a0);
  for (int i = 0; i <= 12; ++i) {
    const double a = a0 + turn * std::numbers::pi / 2 * i / 12;
    points.push_back({static_cast<float>(cx + turn * radius * std::sin(a)), static_cast<float>(cy - turn * radius * std::cos(a)), 0});
  }
  return points;
}

// From the west a way turns right into the outer of two lanes to the south, from the east one turns left into the inner one.
std::shared_ptr<const RoadNetwork> TwoTurnsIntoOneStreet() {
  auto roads = std::make_shared<RoadNetwork>();
  roads->lanes = {{.points = {{-120, -2, 0}, {-15.2f, -2, 0}}, .speed = 9, .next = {1}},
                  {.points = Quarter(-15.2, -2, 0, 10, -1), .speed = 6, .next = {2}, .junction = 0},
                  {.points = {{-5.2f, -12, 0}, {-5.2f, -900, 0}, {-120, -900, 0}, {-120, -2, 0}}, .speed = 9, .next = {0}},
                  {.points = {{120, 2, 0}, {12, 2, 0}}, .speed = 9, .next = {4}},
                  {.points = Quarter(12, 2, 180, 14, 1), .speed = 6, .next = {5}, .junction = 0},
                  {.points = {{-2, -12, 0}, {-2, -900, 0}, {120, -900, 0}, {120, 2, 0}}, .speed = 9, .next = {3}}};
  roads->junctions = {{.center = {0, 0, 0}, .radius = 20, .phases = {}}};
  return roads;
}

// Seconds until both are 20 m past the junction; looks at each tick that they do not touch.
double SecondsThrough(const VehicleShape& shape, double later) {
  TrafficModel model = ModelOf(TwoTurnsIntoOneStreet(), 2);
  for (TrafficVehicle& vehicle : model.vehicles) vehicle.shape = shape;
  TrafficState state;
  state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 50, .v = 8}, {.lane = 3, .ahead = {4, 5}, .s = 44 - later, .v = 8}};
  for (int tick = 0; tick < 1200; ++tick) {
    TickTraffic(model, {}, state);
    EXPECT_FALSE(ContactOf(FootprintOf(model, state, 0), FootprintOf(model, state, 1), {0, 0})) << "at " << tick * 0.05 << " s, " << later;
    const auto past = [&](size_t i, LaneId exit) { return state.vehicles[i].lane == exit && state.vehicles[i].s > 20; };
    if (past(0, 2) && past(1, 5)) return tick * 0.05;
  }
  ADD_FAILURE() << "they stand";
  return INFINITY;
}

TEST(RightOfWay, BusesThatTurnBesideEachOtherGoOneAfterTheOther) {
  const VehicleShape bus{.length = 12.1, .width = 3.0, .height = 3.2, .bus = true};
  for (double later = -15; later <= 15; later += 2.5) SecondsThrough(bus, later);
}

// A street round a corner, its lanes `apart` metres from each other: to the right on the inner one (0 to 2), to the left on the outer
// one (3 to 5).
std::shared_ptr<const RoadNetwork> Corner(double apart) {
  constexpr double kInner = 7;
  auto roads = std::make_shared<RoadNetwork>();
  const auto at = [](double x, double y) { return Vec3f{static_cast<float>(x), static_cast<float>(y), 0}; };
  roads->lanes = {{.points = {at(-120, 0), at(0, 0)}, .speed = 9, .next = {1}},
                  {.points = Quarter(0, 0, 0, kInner, -1), .speed = 6, .next = {2}, .junction = 0},
                  {.points = {at(kInner, -kInner), at(kInner, -900), at(-120, -900), at(-120, 0)}, .speed = 9, .next = {0}},
                  {.points = {at(kInner + apart, -120), at(kInner + apart, -kInner)}, .speed = 9, .next = {4}},
                  {.points = Quarter(kInner + apart, -kInner, 90, kInner + apart, 1), .speed = 6, .next = {5}, .junction = 0},
                  {.points = {at(0, apart), at(-900, apart), at(-900, -2000), at(kInner + apart, -2000), at(kInner + apart, -120)},
                   .speed = 9,
                   .next = {3}}};
  roads->junctions = {{.center = {}, .radius = 20, .phases = {}}};
  return roads;
}

// Their front corners come out of their lanes by 0.3 m: one waits where the other comes round.
TEST(RightOfWay, VansDoNotMeetInANarrowBend) {
  for (const double later : {-12.0, -9.0, -6.0, -3.0, 0.0, 3.0, 6.0, 9.0, 12.0}) {
    TrafficModel model = ModelOf(Corner(2.6), 2);
    for (TrafficVehicle& vehicle : model.vehicles) vehicle.shape = {.length = 6, .width = 2.4, .height = 2.5};
    TrafficState state;
    state.vehicles = {{.lane = 0, .ahead = {1, 2}, .s = 70, .v = 6}, {.lane = 3, .ahead = {4, 5}, .s = 63 - later, .v = 6}};
    for (int tick = 0; tick < 800; ++tick) {
      TickTraffic(model, {}, state);
      ASSERT_FALSE(ContactOf(FootprintOf(model, state, 0), FootprintOf(model, state, 1), {0, 0}))
          << "at " << tick * 0.05 << " s, " << later;
    }
    EXPECT_EQ(state.vehicles[0].lane, 2u) << later;
    EXPECT_EQ(state.vehicles[1].lane, 5u) << later;
  }
}

// A street from west to east (0 to 2) and one from south to north (5 to 7); 14 m behind their crossing a red light.
std::shared_ptr<const RoadNetwork> RoomForTwo() {
  auto roads = std::make_shared<RoadNetwork>();
  roads->lanes = {{.points = {{-150, 0, 0}, {-20, 0, 0}}, .speed = 9, .next = {1}},
                  {.points = {{-20, 0, 0}, {20, 0, 0}}, .speed = 9, .next = {2}, .junction = 0},
                  {.points = {{20, 0, 0}, {34, 0, 0}}, .speed = 9, .next = {3}},
                  {.points = {{34, 0, 0}, {44, 0, 0}}, .speed = 9, .next = {4}, .junction = 1, .signal = 0},
                  {.points = {{44, 0, 0}, {900, 0, 0}, {900, 900, 0}, {-150, 900, 0}, {-150, 0, 0}}, .speed = 9, .next = {0}},
                  {.points = {{0, -150, 0}, {0, -20, 0}}, .speed = 9, .next = {6}},
                  {.points = {{0, -20, 0}, {0, 20, 0}}, .speed = 9, .next = {7}, .junction = 0},
                  {.points = {{0, 20, 0}, {0, 800, 0}, {-500, 800, 0}, {-500, -150, 0}, {0, -150, 0}}, .speed = 9, .next = {5}}};
  roads->junctions = {{.center = {}, .radius = 20, .phases = {}}, {.center = {39, 0, 0}, .radius = 5, .phases = {{2, 600, 3, 2}}}};
  return roads;
}

// The road behind a junction is still empty as the first are let go: it holds two all the same.
TEST(RightOfWay, NoMoreAreLetIntoAJunctionThanTheRoadBehindItHolds) {
  const TrafficModel model = ModelOf(RoomForTwo(), 5);
  TrafficState state;
  for (int i = 0; i < 4; ++i) state.vehicles.push_back({.lane = 0, .ahead = {1, 2}, .s = 120.0 - 9 * i, .v = 8});
  state.vehicles.push_back({.lane = 5, .ahead = {6, 7}, .s = 20, .v = 8});
  Drive(model, 60, state);
  const auto on = [&](LaneId lane) { return std::ranges::count(state.vehicles, lane, &DrivingVehicle::lane); };
  EXPECT_EQ(on(2), 2);
  EXPECT_EQ(on(1), 0);
  EXPECT_EQ(state.vehicles[4].lane, 7u);
}

TEST(RightOfWay, CarsTurnBesideEachOther) {
  double together = 0;
  for (double later = -5; later <= 5; later += 2.5) together = std::max(together, SecondsThrough({}, later));
  EXPECT_LT(together, 16);
}

}  // namespace
}  // namespace airsim360

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

TEST(RightOfWay, CarsTurnBesideEachOther) {
  double together = 0;
  for (double later = -5; later <= 5; later += 2.5) together = std::max(together, SecondsThrough({}, later));
  EXPECT_LT(together, 16);
}

}  // namespace
}  // namespace airsim360

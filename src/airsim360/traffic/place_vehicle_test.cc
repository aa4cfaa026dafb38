#include "airsim360/traffic/place_vehicle.h"

#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/traffic/test_roads.h"

namespace airsim360 {
namespace {

std::string Refusal(const TrafficModel& model, const TrafficState& state, Vec3d p) {
  try {
    WithVehicleAt(model, state, 0, p);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(WithVehicleAt, StandsOnTheNearestLaneWithItsMiddleThereAndDrivesOn) {
  const TrafficModel model = ModelOf(Street(500, {}), 3);
  TrafficState state = StartTraffic(model);
  Drive(model, 5, state);
  // 4 m beside the street towards the east: not on it, but near.
  TrafficState put = WithVehicleAt(model, state, 0, {250, -4, 0.3});
  const RigidTransform X_WB = PoseOf(model, put, 0, put.t_ns);
  EXPECT_NEAR(X_WB.p.x, 250, 1e-6);
  EXPECT_NEAR(X_WB.p.y, 0, 1e-6);
  EXPECT_NEAR(X_WB.R.column(0).x, 1, 1e-9);
  EXPECT_EQ(put.vehicles[0].v, 0);
  // The others are where they were.
  for (size_t i = 1; i < 3; ++i) EXPECT_EQ(PoseOf(model, put, i, put.t_ns).p, PoseOf(model, state, i, state.t_ns).p);
  Drive(model, 20, put);
  EXPECT_GT(PoseOf(model, put, 0, put.t_ns).p.x, 300);
}

TEST(WithVehicleAt, RefusesPlacesWithoutALaneAndWithSomebodyOnIt) {
  const TrafficModel model = ModelOf(Street(500, {}), 2);
  const TrafficState state = StartTraffic(model);
  EXPECT_NE(Refusal(model, state, {250, -4 - kFarthestLane, 0}).find("no lane"), std::string::npos);
  EXPECT_NE(Refusal(model, state, {0, 0, 1e5}).find("no lane"), std::string::npos);
  // In a junction that before or behind it counts.
  const Vec3d beside = PoseOf(model, WithVehicleAt(model, state, 0, {504, 0, 0}), 0, state.t_ns).p;
  EXPECT_TRUE(beside.x <= 500 || beside.x >= 510) << beside.x;
  const Vec3d other = PoseOf(model, state, 1, state.t_ns).p;
  EXPECT_NE(Refusal(model, state, other).find("in the way"), std::string::npos);
  // Where it stands itself it may stand.
  EXPECT_EQ(Refusal(model, state, PoseOf(model, state, 0, state.t_ns).p), "");
}

TEST(WithVehicleAt, IsTheSameEveryTime) {
  const TrafficModel model = ModelOf(RingRoad(400, 13.9f), 5);
  const TrafficState state = StartTraffic(model);
  TrafficState a = WithVehicleAt(model, state, 0, PoseOf(model, state, 0, state.t_ns).p),
               b = WithVehicleAt(model, state, 0, PoseOf(model, state, 0, state.t_ns).p);
  EXPECT_EQ(HashTraffic(a), HashTraffic(b));
}

}  // namespace
}  // namespace airsim360

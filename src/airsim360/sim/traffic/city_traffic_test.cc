// Traffic on the streets of a built-in world.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/traffic/test_roads.h"
#include "airsim360/worlds/kit/street_plan.h"
#include "airsim360/worlds/town/street_lanes.h"

namespace airsim360 {
namespace {

TrafficModel Manhattan(size_t count, uint64_t seed) {
  TrafficModel model = ModelOf(std::make_shared<const RoadNetwork>(RoadsOf(PlanNewYorkCity())), count, seed);
  for (size_t i = 0; i < count; ++i) {
    if (i % 12 == 0) model.vehicles[i].shape = {.length = 12, .width = 2.5, .height = 3.1, .bus = true};
    model.vehicles[i].driver.speed_factor = 0.85 + 0.3 * static_cast<double>(i % 7) / 6;
  }
  // A bus stop on every third lane at the kerb.
  for (LaneId id = 0; id < model.lanes.size(); id += 3)
    if (const Lane& lane = model.lanes.lane(id); lane.junction < 0 && lane.right == kNoLane && model.lanes.length(id) > 50)
      model.bus_stops.push_back({id, model.lanes.length(id) / 2});
  return model;
}

// Corners of the body on the ground, a little inside of it.
std::array<Vec2d, 4> CornersOf(const TrafficModel& model, const TrafficState& state, size_t i) {
  const RigidTransform X = PoseOf(model, state, i, state.t_ns);
  const double l = model.vehicles[i].shape.length / 2 - 0.05, w = model.vehicles[i].shape.width / 2 - 0.05;
  std::array<Vec2d, 4> corners;
  for (size_t k = 0; k < 4; ++k) {
    const Vec3d p = X * Vec3d{k < 2 ? l : -l, k % 3 == 0 ? w : -w, 0};
    corners[k] = {p.x, p.y};
  }
  return corners;
}

bool Overlap(const std::array<Vec2d, 4>& a, const std::array<Vec2d, 4>& b) {
  for (const auto* box : {&a, &b}) {
    for (size_t k = 0; k < 2; ++k) {
      const Vec2d axis = (*box)[k + 1] - (*box)[k];
      const auto range = [&](const std::array<Vec2d, 4>& corners) {
        std::pair<double, double> r{INFINITY, -INFINITY};
        for (const Vec2d c : corners) r = {std::min(r.first, c.x * axis.x + c.y * axis.y), std::max(r.second, c.x * axis.x + c.y * axis.y)};
        return r;
      };
      const auto ra = range(a), rb = range(b);
      if (ra.second < rb.first || rb.second < ra.first) return false;
    }
  }
  return true;
}

TEST(CityTraffic, InManhattanNobodyDrivesThroughAnotherOrStandsForMoreThanThreeCycles) {
  const TrafficModel model = Manhattan(300, 3);
  TrafficState state = StartTraffic(model);
  int overlaps = 0, stuck = 0;
  double hardest = 0, driven = 0;
  for (int second = 0; second < 600; ++second) {
    for (int k = 0; k < 20; ++k) {
      TickTraffic(model, {}, state);
      for (const DrivingVehicle& v : state.vehicles) hardest = std::min(hardest, v.a);
    }
    std::vector<std::array<Vec2d, 4>> bodies;
    for (size_t i = 0; i < state.vehicles.size(); ++i) {
      bodies.push_back(CornersOf(model, state, i));
      stuck += state.vehicles[i].stopped_ns >= 0 && state.t_ns - state.vehicles[i].stopped_ns > 132'000'000'000;
      driven += state.vehicles[i].v;
    }
    for (size_t i = 0; i < bodies.size(); ++i)
      for (size_t k = i + 1; k < bodies.size(); ++k)
        if (std::hypot(bodies[i][0].x - bodies[k][0].x, bodies[i][0].y - bodies[k][0].y) < 30 && Overlap(bodies[i], bodies[k])) {
          if (++overlaps < 8)
            ADD_FAILURE() << second << " s: " << i << " on " << state.vehicles[i].lane << " at " << state.vehicles[i].s << " and " << k
                          << " on " << state.vehicles[k].lane << " at " << state.vehicles[k].s;
        }
  }
  EXPECT_EQ(overlaps, 0);
  EXPECT_EQ(stuck, 0);
  EXPECT_GT(driven / 300 / 600, 2.5);  // m/s on the average: it flows
  EXPECT_GT(hardest, -6.5);            // m/s^2: nobody is surprised
}

// On the boulevard, whose east side has a green lane: those who ride there do so in it, and no car ever does.
TEST(CityTraffic, BicyclesRideInTheCycleLaneOfTheBoulevardAndCarsDoNot) {
  TrafficModel model = Manhattan(240, 4);
  for (size_t i = 0; i < 240; i += 4) {
    model.vehicles[i].shape = {.length = 1.8, .width = 0.65, .height = 1.75, .bicycle = true};
    model.vehicles[i].driver = {.top_speed = 5, .acceleration = 0.8};
  }
  TrafficState state = StartTraffic(model);
  int apart = 0, beside = 0, overlaps = 0;
  for (int second = 0; second < 400; ++second) {
    Drive(model, 1, state);
    for (size_t i = 0; i < state.vehicles.size(); ++i) {
      const Lane& lane = model.lanes.lane(state.vehicles[i].lane);
      if (!model.vehicles[i].shape.bicycle) {
        EXPECT_FALSE(lane.cycle) << i;
        continue;
      }
      if (!lane.cycle || lane.junction >= 0) {
        beside += lane.junction < 0 && lane.right != kNoLane && model.lanes.lane(lane.right).cycle;
        continue;
      }
      ++apart;
      // Within the paint: 8.75 to 10.45 m right of the axis, which is x = 0.
      if (state.vehicles[i].s > 12 && state.t_ns - state.vehicles[i].changed_ns > kLaneChangeNs) {
        EXPECT_NEAR(PoseOf(model, state, i, state.t_ns).p.x, 9.6, 0.5) << i;
      }
      for (size_t k = 0; k < state.vehicles.size(); ++k)
        overlaps += k != i && std::abs(state.vehicles[k].s - state.vehicles[i].s) < 20 &&
                    Overlap(CornersOf(model, state, i), CornersOf(model, state, k));
    }
  }
  EXPECT_GT(apart, 200);
  EXPECT_GT(apart, 4 * beside);
  EXPECT_EQ(overlaps, 0);
}

TEST(CityTraffic, IsTheSameForTheSameSeedAndGoesOnTheSameFromASnapshot) {
  const TrafficModel model = Manhattan(120, 5);
  TrafficState state = StartTraffic(model);
  Drive(model, 40, state);
  TrafficState snapshot = state, again = StartTraffic(model);
  Drive(model, 40, again);
  EXPECT_EQ(HashTraffic(state), HashTraffic(again));
  Drive(model, 40, state);
  Drive(model, 40, snapshot);
  EXPECT_EQ(HashTraffic(state), HashTraffic(snapshot));
  TrafficState other = StartTraffic(Manhattan(120, 6));
  EXPECT_NE(HashTraffic(other), HashTraffic(StartTraffic(model)));
}

TEST(CityTraffic, MoreThanTheRoadsHoldAreRefusedByNumber) {
  const size_t most = TrafficCapacity(Manhattan(0, 0).lanes);
  EXPECT_GT(most, 500u);
  EXPECT_EQ(StartTraffic(Manhattan(most, 0)).vehicles.size(), most);
  try {
    StartTraffic(Manhattan(most + 1, 0));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(most)), std::string::npos);
  }
}

TEST(CityTraffic, AxlesStandOnTheRoadAndTheFrontLooksWhereItDrives) {
  const TrafficModel model = Manhattan(200, 9);
  TrafficState state = StartTraffic(model);
  Drive(model, 60, state);
  for (size_t i = 0; i < state.vehicles.size(); ++i) {
    const RigidTransform X = PoseOf(model, state, i, state.t_ns), later = PoseOf(model, state, i, state.t_ns + kTrafficTickNs);
    EXPECT_NEAR(X.R.determinant(), 1, 1e-12);
    EXPECT_GT(X.R.column(2).z, 0.98);
    const Vec3d moved = later.p - X.p;
    if (state.vehicles[i].v > 2) {
      EXPECT_GT(Dot(Normalized(moved), X.R.column(0)), 0.97) << i;
      EXPECT_NEAR(Norm(moved), state.vehicles[i].v * 0.05, 0.02);
    }
  }
}

}  // namespace
}  // namespace airsim360

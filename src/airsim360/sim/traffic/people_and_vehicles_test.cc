// People and vehicles who share a road: each looks at the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/people/crowd/test_crowd.h"
#include "airsim360/people/crowd/vehicle_dodging.h"
#include "airsim360/sim/living_world.h"
#include "airsim360/sim/people/people.h"
#include "airsim360/sim/people/populate.h"
#include "airsim360/sim/step.h"
#include "airsim360/sim/traffic/traffic.h"
#include "airsim360/traffic/test_roads.h"

namespace airsim360 {
namespace {

using internal::ReserveOf;
using internal::TestCrowd;
using internal::TestGround;

constexpr PersonIndex kPeople = 16;
constexpr double kRing = 300, kRadius = kRing / (2 * std::numbers::pi);

struct Shared {
  int hit = 0, near_misses = 0, crossings = 0;
  double longest = 0;  // seconds that a vehicle stood
  std::vector<int> crossed = std::vector<int>(kPeople);
};

// For three minutes people cross a ring road to and fro, wherever they are.
Shared CrossARing(bool look, size_t cars) {
  TestGround ground;
  const auto edge = static_cast<float>(kRadius + 12);
  ground.Floor("ground/sidewalk", -edge, -edge, edge, edge);
  TestCrowd crowd(ground.Build(), ReserveOf(kPeople));
  SimTraffic traffic(ModelOf(RingRoad(kRing, 10), cars));
  TrafficState state = StartTraffic(traffic.model);
  std::vector<bool> outside(kPeople);
  const auto send = [&](PersonIndex i) {
    const double angle = 2 * std::numbers::pi * i / kPeople, r = kRadius + (outside[i] ? -7 : 7);
    crowd.Do(i, SendPerson{{r * std::cos(angle), r * std::sin(angle), 0}, 1.34});
    outside[i] = !outside[i];
  };
  for (PersonIndex i = 0; i < kPeople; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPeople, r = kRadius - 7;
    crowd.Do(i, SpawnPerson{{r * std::cos(angle), r * std::sin(angle), 0}, 0});
    send(i);
  }
  Shared shared;
  PeopleState people;
  std::vector<NearMiss> over;
  for (int tick = 0; tick < 180 * 20; ++tick) {
    people.crowd = crowd.state;
    const std::vector<CrowdVehicle> vehicles = VehiclesNear(traffic, state, people);
    StepCrowd(*crowd.model, crowd.state, kCrowdTickNs, {}, nullptr, look ? vehicles : std::vector<CrowdVehicle>{});
    people.crowd = crowd.state;
    TickTraffic(traffic.model, ObstaclesOf(people), state, &over);
    for (PersonIndex i = 0; i < kPeople; ++i) {
      const Vec3d p = crowd[i].p_WP;
      for (const CrowdVehicle& vehicle : VehiclesNear(traffic, state, people))
        shared.hit += !vehicle.stands && internal::DistanceTo(vehicle, {p.x, p.y}) < 0;
      if ((std::hypot(p.x, p.y) > kRadius) != outside[i] || std::abs(std::hypot(p.x, p.y) - kRadius) < 6) continue;
      ++shared.crossed[i];
      send(i);
    }
    for (const DrivingVehicle& vehicle : state.vehicles)
      if (vehicle.stopped_ns >= 0) shared.longest = std::max(shared.longest, static_cast<double>(state.t_ns - vehicle.stopped_ns) * 1e-9);
  }
  shared.near_misses = static_cast<int>(std::ranges::count(over, RoadUser::Kind::kPerson, [](const NearMiss& m) { return m.b.kind; }));
  return shared;
}

TEST(PeopleAndVehicles, WhoCrossesARoadWithoutACrossingIsNotHitAndNobodyWaitsForEver) {
  const Shared blind = CrossARing(false, 14), seeing = CrossARing(true, 14);
  EXPECT_GT(blind.hit, 0);
  EXPECT_EQ(seeing.hit, 0);
  EXPECT_LE(seeing.near_misses, blind.near_misses / 5);
  EXPECT_LT(seeing.longest, 40);
  for (PersonIndex i = 0; i < kPeople; ++i) EXPECT_GE(seeing.crossed[i], 3) << i;
}

// A ring road on a square where people stroll, and a car that others look like.
SimModel RingWithPeople(int64_t dt_ns) {
  TestGround ground("ring with people");
  const auto edge = static_cast<float>(kRadius + 6);
  ground.Floor("ground/sidewalk", -edge, -edge, edge, edge);
  ground.Box("vehicle/car", {-0.9f, 80, 0}, {0.9f, 84.4f, 1.5f});
  ground.builder().SetRoads(RingRoad(kRing, 8));
  const PopulatedScene populated = Populate(ground.Build(), {.count = 60, .warm_up = 10, .level = 3, .seed = 3});
  const TrafficScene driven = AddTraffic(populated.scene, {.count = 12, .seed = 2}, populated.people->epoch_ns);
  SimModel model{.tracer = std::make_shared<const RayTracer>(driven.scene), .dt_ns = dt_ns};
  model.people = populated.people;
  model.traffic = driven.traffic;
  return model;
}

TEST(PeopleAndVehicles, TheStepTheThreadsAndASnapshotChangeNothing) {
  const auto run = [](const SimModel& model, bool snapshot) {
    SimState state = StartState(model), kept;
    const int64_t steps = 30'000'000'000 / model.dt_ns;
    for (int64_t i = 0; i < steps; ++i) {
      if (snapshot && i == steps / 2) kept = state;
      Step(model, {}, state);
    }
    for (int64_t i = steps / 2; snapshot && i < steps; ++i) Step(model, {}, kept);
    if (snapshot) state = kept;
    return std::pair(HashPeople(*state.people), HashTraffic(*state.traffic));
  };
  const SimModel model = RingWithPeople(50'000'000);
  const auto hashes = run(model, false);
  EXPECT_EQ(run(model, true), hashes);
  EXPECT_EQ(run(RingWithPeople(150'000'000), false), hashes);  // three ticks of both in a step
  EXPECT_EQ(run(RingWithPeople(10'000'000), false), hashes);
  const ThreadLimit one(1);
  EXPECT_EQ(run(model, false), hashes);
  // The two do look at each other.
  SimModel alone = model;
  alone.traffic = nullptr;
  SimState state = StartState(alone);
  for (int i = 0; i < 600; ++i) Step(alone, {}, state);
  EXPECT_NE(HashPeople(*state.people), hashes.first);
}

}  // namespace
}  // namespace airsim360

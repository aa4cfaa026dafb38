#include "airsim360/people/crowd/vehicle_dodging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "airsim360/base/parallel.h"
#include "airsim360/math/plane.h"
#include "airsim360/people/crowd/test_crowd.h"

namespace airsim360::internal {
namespace {

/// A vehicle 4.4 m long and 1.8 m wide whose middle is at `x(t)`, y; it looks to the east.
class Driver1d {
 public:
  Driver1d(double y, std::function<double(double)> x) : y_(y), x_(std::move(x)) {}
  CrowdVehicle At(double t) const {
    CrowdVehicle vehicle;
    for (size_t k = 0; k < vehicle.places.size(); ++k)
      vehicle.places[k] = {{x_(t + kCrowdVehicleStep * static_cast<double>(k)), y_}, {1, 0}};
    vehicle.stands = std::abs(x_(t + 0.05) - x_(t)) < 0.015;
    return vehicle;
  }

 private:
  double y_;
  std::function<double(double)> x_;
};

struct Walk1 {
  double seconds = 0, closest = INFINITY, length = 0;  ///< until arrival; to the side of a vehicle; of the way
  bool arrived = false;
};

std::shared_ptr<const Scene> Square() {
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, 60, 30);
  return ground.Build();
}

// Somebody goes from a to b among vehicles.
Walk1 WalkAmong(const std::vector<Driver1d>& drivers, Vec3d a, Vec3d b, bool see = true) {
  TestCrowd crowd(Square(), ReserveOf(1));
  crowd.Do(0, SpawnPerson{a, 0});
  crowd.Do(0, SendPerson{b, 1.34});
  Walk1 walk;
  Vec3d last = crowd[0].p_WP;
  while (walk.seconds < 90 && !walk.arrived) {
    std::vector<CrowdVehicle> vehicles;
    for (const Driver1d& driver : drivers) vehicles.push_back(driver.At(walk.seconds));
    StepCrowd(*crowd.model, crowd.state, kCrowdTickNs, {}, nullptr, see ? vehicles : std::vector<CrowdVehicle>{});
    walk.seconds += 0.05;
    const Vec3d p = crowd[0].p_WP;
    for (const Driver1d& driver : drivers) walk.closest = std::min(walk.closest, DistanceTo(driver.At(walk.seconds), {p.x, p.y}));
    walk.length += Norm(p - last);
    last = p;
    walk.arrived = std::hypot(p.x - b.x, p.y - b.y) < 0.6;
  }
  return walk;
}

TEST(Dodging, WhoIsToldOfAVehicleWaitsForItAndGoesOnBehindIt) {
  // Whoever does not see it is inside of it at x = 30.
  const std::vector<Driver1d> drivers = {{15, [](double t) { return 30 + 8 * (t - 5.2); }}};
  EXPECT_LT(WalkAmong(drivers, {30, 8, 0}, {30, 22, 0}, false).closest, 0);
  const Walk1 walk = WalkAmong(drivers, {30, 8, 0}, {30, 22, 0});
  EXPECT_TRUE(walk.arrived);
  EXPECT_GT(walk.closest, 0.25);
  EXPECT_LT(walk.seconds, 16);  // 10.5 without it
}

TEST(Dodging, WhereThereIsTimeNobodyWaits) {
  for (const double meets : {-4.0, 16.0}) {
    const std::vector<Driver1d> drivers = {{15, [=](double t) { return 30 + 8 * (t - meets); }}};
    const double alone = WalkAmong({}, {30, 8, 0}, {30, 22, 0}).seconds;
    EXPECT_NEAR(WalkAmong(drivers, {30, 8, 0}, {30, 22, 0}).seconds, alone, 0.2) << meets;
  }
}

TEST(Dodging, WhoSeesAVehicleBrakeInTimeGoesOnBeforeIt) {
  // It comes from x = 0 at 8 m/s and is at rest with its nose at x = 25 after 6 s.
  const auto x = [](double t) {
    const double v = 8, length = 24, brakes = 2 * length / v;
    return t < brakes ? v * t - v * t * t / (2 * brakes) - 1.4 : length - 1.4;
  };
  const Walk1 walk = WalkAmong({{15, x}}, {30, 8, 0}, {30, 22, 0});
  EXPECT_TRUE(walk.arrived);
  EXPECT_LT(walk.seconds, 11.5);
  EXPECT_GT(walk.closest, 0.5);
}

TEST(Dodging, AVehicleThatStandsAcrossTheWayIsWalkedAroundByTheShorterEnd) {
  for (const double middle : {28.8, 30.0, 31.2}) {
    const std::vector<Driver1d> drivers = {{15, [=](double) { return middle; }}};
    EXPECT_LT(WalkAmong(drivers, {30, 8, 0}, {30, 22, 0}, false).closest, -0.8);
    const Walk1 walk = WalkAmong(drivers, {30, 8, 0}, {30, 22, 0});
    EXPECT_TRUE(walk.arrived) << middle;
    EXPECT_GT(walk.closest, 0.15) << middle;
    // The way over two corners half a metre off the shorter end, and a little more.
    const double aside = 2.2 + 0.5 - std::abs(middle - 30);
    EXPECT_LT(walk.length, 2 * std::hypot(aside, 5.6) + 2 * 1.4 + 1.5) << middle;
  }
}

TEST(Dodging, BetweenTheVehiclesOfAQueuePeopleFindTheGap) {
  std::vector<Driver1d> drivers;
  for (const double middle : {20.0, 26.6, 33.2, 39.8}) drivers.push_back({15, [=](double) { return middle; }});
  const Walk1 walk = WalkAmong(drivers, {27, 8, 0}, {27, 22, 0});
  EXPECT_TRUE(walk.arrived);
  EXPECT_GT(walk.closest, 0.15);
  EXPECT_LT(walk.length, 19);
}

TEST(Dodging, WhoStandsInTheWayOfAVehicleGetsOutOfIt) {
  for (const double y : {14.2, 14.9, 15.1, 15.8}) {
    TestCrowd crowd(Square(), ReserveOf(1));
    crowd.Do(0, SpawnPerson{{30, y, 0}, 0});
    crowd.Do(0, SetPersonState{"standing", 60});
    const Driver1d driver(15, [](double t) { return 15 + 1.5 * t; });
    double closest = INFINITY;
    for (double t = 0; t < 20; t += 0.05) {
      const CrowdVehicle vehicle = driver.At(t);
      StepCrowd(*crowd.model, crowd.state, kCrowdTickNs, {}, nullptr, {&vehicle, 1});
      closest = std::min(closest, DistanceTo(driver.At(t + 0.05), {crowd[0].p_WP.x, crowd[0].p_WP.y}));
    }
    EXPECT_GT(closest, 0.15) << y;
    EXPECT_LT(std::abs(crowd[0].p_WP.y - 15), 2.5) << y;  // not farther than needed
  }
}

TEST(Dodging, OfAVehicleOnABridgeAboveNobodyTakesNotice) {
  const Driver1d driver(15, [](double) { return 30.0; });
  CrowdVehicle above = driver.At(0);
  above.z = 5;
  const Vehicles vehicles({&above, 1});
  EXPECT_TRUE(vehicles.Near({30, 14}, 0).empty());
  EXPECT_EQ(vehicles.Near({30, 14}, 5).size(), 1u);
}

TEST(Dodging, NearFindsWhatASearchOfAllFinds) {
  RngStream rng(3, "vehicles");
  std::vector<CrowdVehicle> all;
  for (int i = 0; i < 60; ++i) {
    const double v = rng.Uniform(0, 14), y = rng.Uniform(0, 100), x = rng.Uniform(0, 100);
    all.push_back(Driver1d(y, [=](double t) { return x + v * t; }).At(0));
  }
  const Vehicles vehicles(all);
  for (int i = 0; i < 200; ++i) {
    const Vec2d p{rng.Uniform(0, 100), rng.Uniform(0, 100)};
    const auto near = vehicles.Near(p, 0);
    for (const CrowdVehicle& vehicle : all) {
      double least = INFINITY;
      for (const CrowdVehicle::Footprint& place : vehicle.places) {
        CrowdVehicle then = vehicle;
        then.places[0] = place;
        least = std::min(least, DistanceTo(then, p));
      }
      EXPECT_TRUE(least > 3 || std::ranges::count(near, &vehicle) == 1) << i;
    }
  }
}

TEST(Dodging, TheSameBytesForOneThreadAndManyAndFromASnapshot) {
  const auto run = [](bool restore) {
    CrowdRequest request;
    request.count = 200;
    request.seed = 4;
    TestCrowd crowd(Square(), request);
    const Driver1d driver(15, [](double t) { return 30 + 25 * std::sin(t / 4); });
    CrowdState kept;
    for (int tick = 0; tick < 600; ++tick) {
      const CrowdVehicle vehicle = driver.At(tick * 0.05);
      if (restore && tick == 300) kept = crowd.state;
      StepCrowd(*crowd.model, crowd.state, kCrowdTickNs, {}, nullptr, {&vehicle, 1});
      if (restore && tick == 330) crowd.state = kept, tick = 299, restore = false;
    }
    return HashCrowd(crowd.state);
  };
  const uint64_t hash = run(false);
  EXPECT_EQ(run(true), hash);
  const ThreadLimit one(1);
  EXPECT_EQ(run(false), hash);
}

}  // namespace
}  // namespace airsim360::internal

#include "airsim360/planning/trajectory_limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/planning/time_allocation.h"

namespace airsim360 {
namespace {

PolynomialTrajectory RandomTrajectory(uint64_t id) {
  RngStream random(7, "limits", id);
  const size_t segments = 1 + random.Index(8);
  std::vector<Vec3d> waypoints;
  std::vector<double> durations;
  for (size_t i = 0; i <= segments; ++i) {
    waypoints.push_back({random.Uniform(-16, 16), random.Uniform(-16, 16), random.Uniform(0, 16)});
  }
  for (size_t i = 0; i < segments; ++i) durations.push_back(random.Uniform(0.5, 5));
  return SolveMinimumSnap({.waypoints = waypoints, .durations = durations});
}

TEST(TrajectoryLimits, PeaksAreNeverBelowASampleAndAtMostSlightlyAbove) {
  for (uint64_t id = 0; id < 100; ++id) {
    const PolynomialTrajectory trajectory = RandomTrajectory(id);
    const TrajectoryPeaks peaks = CertifiedPeaks(trajectory);
    double speed = 0, acceleration = 0;
    for (int i = 0; i <= 10000; ++i) {
      const TrajectoryPoint point = trajectory.At(trajectory.duration() * i / 10000);
      speed = std::max(speed, Norm(point.v));
      acceleration = std::max(acceleration, Norm(point.a));
    }
    EXPECT_LE(speed, peaks.speed.value);
    EXPECT_LE(acceleration, peaks.acceleration.value);
    EXPECT_NEAR(Norm(trajectory.At(peaks.speed.time).v) / peaks.speed.value, 1, 1e-10);
    EXPECT_NEAR(Norm(trajectory.At(peaks.acceleration.time).a) / peaks.acceleration.value, 1, 1e-10);
  }
}

TEST(TrajectoryLimits, StraightFlightTakesTheClosedFormDuration) {
  const std::vector<Vec3d> waypoints = {{0, 0, 0}, {100, 0, 0}};
  const AllocatedTrajectory fast = AllocateTimes(waypoints, {.speed = 16, .acceleration = 1000});
  EXPECT_NEAR(fast.trajectory.duration(), 35.0 / 16 * 100 / 16, 1e-9);
  const AllocatedTrajectory strong = AllocateTimes(waypoints, {.speed = 1000, .acceleration = 3});
  EXPECT_NEAR(strong.trajectory.duration(), std::sqrt(84 * std::sqrt(5.0) / 25 * 100 / 3), 1e-9);
}

}  // namespace
}  // namespace airsim360

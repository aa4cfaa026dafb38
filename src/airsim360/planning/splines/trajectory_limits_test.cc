#include "airsim360/planning/splines/trajectory_limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/planning/splines/time_allocation.h"

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

TEST(TrajectoryLimits, BothMethodsOfThePeaksAgree) {
  for (uint64_t id = 200; id < 300; ++id) {
    const PolynomialTrajectory trajectory = RandomTrajectory(id);
    const TrajectoryPeaks peaks = CertifiedPeaks(trajectory);
    EXPECT_NEAR(peaks.speed.value / PeakOfNorm(trajectory, 1).value, 1, 1e-10);
    EXPECT_NEAR(peaks.acceleration.value / PeakOfNorm(trajectory, 2).value, 1, 1e-10);
  }
}

TEST(TrajectoryLimits, AxisPeaksBoundTheComponentsTightly) {
  for (uint64_t id = 0; id < 20; ++id) {
    const PolynomialTrajectory trajectory = RandomTrajectory(id);
    const CertifiedPeak climb = PeakAlong(trajectory, 1, {0, 0, 1}), side = PeakOfAxis(trajectory, 2, 1);
    for (int i = 0; i <= 5000; ++i) {
      const TrajectoryPoint point = trajectory.At(trajectory.duration() * i / 5000);
      EXPECT_LE(point.v.z, climb.value);
      EXPECT_LE(std::abs(point.a.y), side.value);
    }
    // A path that never climbs has its largest climb rate, zero, at its ends.
    EXPECT_NEAR(trajectory.At(climb.time).v.z, climb.value, 1e-9 * CertifiedPeaks(trajectory).speed.value);
    EXPECT_NEAR(std::abs(trajectory.At(side.time).a.y) / side.value, 1, 1e-9);
  }
}

TEST(TrajectoryLimits, ScaledPathsTouchALimitAndAnyFasterOneBreaksIt) {
  for (uint64_t id = 0; id < 50; ++id) {
    RngStream random(9, "limits", id);
    const TrajectoryLimits limits = {.speed = random.Uniform(1, 20),
                                     .acceleration = random.Uniform(1, 10),
                                     .axis_speed = {random.Uniform(1, 20), 1e9, 1e9},
                                     .climb = random.Uniform(0.5, 5),
                                     .descent = random.Uniform(0.5, 5)};
    const PolynomialTrajectory scaled = ScaleToLimits(RandomTrajectory(id), limits);
    EXPECT_TRUE(WithinLimits(scaled, limits));
    EXPECT_FALSE(WithinLimits(Slowed(scaled, 1 - 1e-6), limits));
  }
}

TEST(TrajectoryLimits, DroneLimitsHoldAtEverySample) {
  const TrajectoryLimits limits = {.speed = 20, .acceleration = 20, .thrust_per_mass = 14, .body_rate = 1.5};
  for (uint64_t id = 0; id < 10; ++id) {
    const PolynomialTrajectory path = ScaleToLimits(RandomTrajectory(id), limits);
    EXPECT_TRUE(WithinLimits(path, limits));
    EXPECT_FALSE(WithinLimits(Slowed(path, 1 - 1e-5), limits));
    for (int i = 0; i <= 2000; ++i) {
      const TrajectoryPoint point = path.At(path.duration() * i / 2000);
      const Vec3d thrust = point.a + Vec3d{0, 0, 9.80665};
      EXPECT_LE(Norm(thrust), 14);
      EXPECT_LE(Norm(Cross(point.jerk, thrust)) / Dot(thrust, thrust), 1.5);
    }
  }
}

TEST(TrajectoryLimits, MovingEndsAreSolvedAgainUntilTheLimitsHold) {
  const std::vector<Vec3d> waypoints = {{0, 0, 0}, {10, 4, 0}, {20, -5, 3}};
  const std::vector<double> durations = {1, 1};
  const TrajectoryLimits limits = {.speed = 8, .acceleration = 6};
  const MinimumSnapProblem problem = {
      .waypoints = waypoints, .durations = durations, .start = {{3, 0, 0}, {}, {}}, .end = {{0, 2, 0}, {}, {}}};
  const PolynomialTrajectory path = SolveWithinLimits(problem, limits);
  EXPECT_TRUE(WithinLimits(path, limits));
  EXPECT_NEAR(path.At(0).v.x, 3, 1e-12);
  const TrajectoryPeaks peaks = CertifiedPeaks(path);
  EXPECT_GT(std::max(peaks.speed.value / 8, peaks.acceleration.value / 6), 1 - 1e-4);
  const TrajectoryLimits impossible = {.speed = 2};
  EXPECT_THROW(SolveWithinLimits(problem, impossible), InputError);
}

TEST(TrajectoryLimits, BadLimitsAreRefused) {
  EXPECT_THROW(CheckLimits({.speed = 0}), InputError);
  EXPECT_THROW(CheckLimits({.acceleration = -1}), InputError);
  EXPECT_THROW(CheckLimits({.climb = NAN}), InputError);
  EXPECT_THROW(CheckLimits({.thrust_per_mass = 9}), InputError);
}

}  // namespace
}  // namespace airsim360

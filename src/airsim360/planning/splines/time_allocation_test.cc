#include "airsim360/planning/splines/time_allocation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

std::vector<Vec3d> RandomWalk(size_t segments, uint64_t id) {
  RngStream random(4, "walk", id);
  std::vector<Vec3d> waypoints = {{0, 0, 0}};
  for (size_t i = 0; i < segments; ++i) {
    const Vec3d step = {random.Uniform(-10, 10), random.Uniform(-10, 10), random.Uniform(-3, 3)};
    waypoints.push_back(waypoints.back() + step);
  }
  return waypoints;
}

TEST(TimeAllocation, StaysWithinTheLimitsAboveTheBoundAndBelowTheTrapezoids) {
  for (const SplineKind kind : {SplineKind::kMinimumSnap, SplineKind::kPaperQuintic, SplineKind::kMinimumJerk}) {
    for (uint64_t id = 0; id < 6; ++id) {
      const std::vector<Vec3d> waypoints = RandomWalk(2 + 3 * id, id);
      const TrajectoryLimits limits = {.speed = 16, .acceleration = 3};
      const AllocatedTrajectory best = AllocateTimes(waypoints, limits, {.kind = kind});
      const AllocatedTrajectory plain = AllocateTimes(waypoints, limits, {.kind = kind, .optimise = false});
      EXPECT_TRUE(WithinLimits(best.trajectory, limits));
      EXPECT_GE(best.trajectory.duration(), best.lower_bound);
      // Two segments leave little to gain.
      EXPECT_LE(best.trajectory.duration(), (id == 0 ? 1 : 0.95) * plain.trajectory.duration());
    }
  }
}

TEST(TimeAllocation, NoSingleDurationCanBeImprovedMuch) {
  const std::vector<Vec3d> waypoints = RandomWalk(6, 11);
  const TrajectoryLimits limits = {.speed = 5, .acceleration = 3};
  const PolynomialTrajectory best = AllocateTimes(waypoints, limits).trajectory;
  for (size_t i = 0; i < best.segments(); ++i) {
    for (const double factor : {0.97, 1.03}) {
      std::vector<double> durations(best.durations().begin(), best.durations().end());
      durations[i] *= factor;
      const PolynomialTrajectory other = ScaleToLimits(SolveMinimumSnap({.waypoints = waypoints, .durations = durations}), limits);
      EXPECT_GT(other.duration(), best.duration() * (1 - 2e-3));
    }
  }
}

// Against points on the line that a user would add: evenly, or where the fastest flight is at even times.
TEST(TimeAllocation, AStraightFlightIsAsShortAsWithPointsBetween) {
  struct Leg {
    double length, speed, acceleration;
  };
  for (const SplineKind kind : {SplineKind::kMinimumSnap, SplineKind::kPaperQuintic, SplineKind::kMinimumJerk}) {
    for (const Leg leg : {Leg{61.5, 8, 4}, {136.8, 8, 4}, {5, 8, 4}, {20, 8, 4}, {61.5, 30, 4}, {0.3, 2, 9}, {47, 5, 1.3}}) {
      const TrajectoryLimits limits = {.speed = leg.speed, .acceleration = leg.acceleration};
      const Vec3d a{1, -2, 3}, way = Vec3d{0.6, -0.64, 0.48} * leg.length;
      const std::vector<Vec3d> ends = {a, a + way};
      const AllocatedTrajectory split = AllocateTimes(ends, limits, {.kind = kind, .split = true});
      EXPECT_TRUE(WithinLimits(split.trajectory, limits));
      EXPECT_GE(split.trajectory.duration(), split.lower_bound);
      EXPECT_LT(Norm(split.trajectory.At(split.trajectory.duration()).p - ends[1]), 1e-9);
      EXPECT_LT(split.trajectory.duration(), AllocateTimes(ends, limits, {.kind = kind}).trajectory.duration());
      for (int n = 1; n <= 12; ++n) {
        std::vector<Vec3d> even = {a};
        for (int i = 1; i <= n; ++i) even.push_back(a + way * (static_cast<double>(i) / (n + 1)));
        even.push_back(ends[1]);
        const double other = AllocateTimes(even, limits, {.kind = kind}).trajectory.duration();
        EXPECT_LE(split.trajectory.duration(), 1.02 * other) << leg.length << " m with " << n << " between";
      }
    }
  }
}

TEST(TimeAllocation, OnlyTwoWaypointsAreSplitAndNotWhereTheyAreTooNear) {
  const TrajectoryLimits limits = {.speed = 8, .acceleration = 4};
  const std::vector<Vec3d> three = {{0, 0, 0}, {10, 0, 0}, {20, 5, 0}};
  EXPECT_EQ(AllocateTimes(three, limits, {.split = true}).trajectory.segments(), 2u);
  const std::vector<Vec3d> near = {{1, 0, 0}, {1 + 4e-16, 0, 0}};
  EXPECT_EQ(AllocateTimes(near, limits, {.split = true}).trajectory.segments(), 1u);
}

TEST(TimeAllocation, SingleSegmentsTakeTheClosedFormDuration) {
  const std::vector<Vec3d> waypoints = {{0, 0, 0}, {100, 0, 0}};
  const AllocatedTrajectory septic = AllocateTimes(waypoints, {.speed = 16, .acceleration = 3});
  EXPECT_NEAR(septic.trajectory.duration(), std::sqrt(84 * std::sqrt(5.0) / 25 * 100 / 3), 1e-8);
  const AllocatedTrajectory quintic = AllocateTimes(waypoints, {.speed = 16, .acceleration = 3}, {.kind = SplineKind::kPaperQuintic});
  EXPECT_NEAR(quintic.trajectory.duration(), std::sqrt(10 / std::sqrt(3.0) * 100 / 3), 1e-8);
}

TEST(TimeAllocation, ScalingLengthsAndLimitsScalesTheTimes) {
  std::vector<Vec3d> waypoints = RandomWalk(5, 3);
  const double time = AllocateTimes(waypoints, {.speed = 5, .acceleration = 3}).trajectory.duration();
  for (Vec3d& p : waypoints) p = p * 4.0;
  // Lengths times 4, speed times 2: times times 2, acceleration as before.
  const double scaled = AllocateTimes(waypoints, {.speed = 10, .acceleration = 3}).trajectory.duration();
  EXPECT_NEAR(scaled / time, 2, 1e-6);
}

TEST(TimeAllocation, WholeSamplesFitTheFlight) {
  const AllocatedTrajectory path = AllocateTimes(RandomWalk(4, 5), {.speed = 16, .acceleration = 3}, {.sample_interval = 0.5});
  const double steps = path.trajectory.duration() / 0.5;
  EXPECT_NEAR(steps, std::round(steps), 1e-9);
  EXPECT_TRUE(WithinLimits(path.trajectory, {.speed = 16, .acceleration = 3}));
}

TEST(TimeAllocation, BadRoutesAreRefused) {
  const TrajectoryLimits limits = {.speed = 16, .acceleration = 3};
  const std::vector<Vec3d> one = {{0, 0, 0}}, same = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  EXPECT_THROW(AllocateTimes(one, limits), InputError);
  EXPECT_THROW(AllocateTimes(same, limits), InputError);
  EXPECT_THROW(AllocateTimes(RandomWalk(2, 1), {.speed = 16}), InputError);
}

TEST(TimeAllocation, OtherLimitsAreTouchedByAFlightNoLongerThanTheFastestSlowedDown) {
  const std::vector<Vec3d> waypoints = {{0, 0, 0}, {0, 0, 30}, {40, 30, 5}};
  const TrajectoryLimits norms = {.speed = 50, .acceleration = 50};
  TrajectoryLimits limits = norms;
  limits.axis_speed.x = 3;
  const PolynomialTrajectory fast = AllocateTimes(waypoints, norms).trajectory;
  const PolynomialTrajectory slow = AllocateTimes(waypoints, limits).trajectory;
  EXPECT_NEAR(PeakOfAxis(slow, 1, 0).value, 3, 1e-8);
  EXPECT_LE(slow.duration(), ScaleToLimits(fast, limits).duration() * (1 + 1e-9));
}

}  // namespace
}  // namespace airsim360

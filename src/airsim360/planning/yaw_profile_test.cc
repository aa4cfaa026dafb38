#include "airsim360/planning/yaw_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/planning/splines/minimum_snap.h"

namespace airsim360 {
namespace {

PolynomialTrajectory Straight(Vec3d to) {
  const std::vector<Vec3d> waypoints = {{0, 0, 0}, to};
  const std::vector<double> durations = {4};
  return SolveMinimumSnap({.waypoints = waypoints, .durations = durations});
}

TEST(YawProfile, FollowsTheVelocityAndHoldsItsHeadingAtRest) {
  const PolynomialTrajectory trajectory = Straight({-3, 3, 1});
  const YawProfile yaw(trajectory, YawAlongVelocity{});
  for (const double t : {0.0, 1.0, 2.0, 4.0}) EXPECT_NEAR(yaw.At(t), 3 * kPi / 4, 1e-9);
}

TEST(YawProfile, StraightUpHasHeadingZero) {
  const PolynomialTrajectory trajectory = Straight({0, 0, 5});
  EXPECT_EQ(YawProfile(trajectory, YawAlongVelocity{}).At(2), 0);
}

TEST(YawProfile, LooksAtAPointFromEverywhere) {
  const PolynomialTrajectory trajectory = Straight({10, 0, 0});
  const YawProfile yaw(trajectory, YawTowards{{5, 5, 0}});
  EXPECT_NEAR(yaw.At(0), kPi / 4, 1e-12);
  EXPECT_NEAR(yaw.At(2), kPi / 2, 1e-9);
  EXPECT_NEAR(yaw.At(4), 3 * kPi / 4, 1e-12);
}

TEST(YawProfile, GivenHeadingsTurnTheShortWay) {
  const PolynomialTrajectory trajectory = Straight({1, 0, 0});
  const YawProfile yaw(trajectory, GivenYaw{{0, 2}, {0.9 * kPi, -0.9 * kPi}});
  EXPECT_NEAR(std::abs(yaw.At(1)), kPi, 1e-12);
  EXPECT_NEAR(yaw.At(0.5), 0.95 * kPi, 1e-12);
  EXPECT_NEAR(yaw.At(3), -0.9 * kPi, 1e-12);
}

TEST(YawProfile, PowersReproduceAHeadingThatIsAPolynomialInTime) {
  const PolynomialTrajectory trajectory = Straight({1, 0, 0});
  const YawProfile yaw(trajectory, GivenYaw{{0, 4}, {3.0, 4.2}});  // crosses pi
  const std::array<double, 8> powers = yaw.Powers(1, 2, 3.3 - 2 * kPi);
  EXPECT_NEAR(powers[0], 3.3 - 2 * kPi, 1e-12);
  EXPECT_NEAR(powers[1], 0.3, 1e-12);
  for (size_t i = 2; i < 8; ++i) EXPECT_NEAR(powers[i], 0, 1e-10);
}

TEST(YawProfile, BadRulesAreRefused) {
  const PolynomialTrajectory trajectory = Straight({1, 0, 0});
  EXPECT_THROW(YawProfile(trajectory, ConstantYaw{NAN}), InputError);
  EXPECT_THROW(YawProfile(trajectory, GivenYaw{{0, 0}, {1, 2}}), InputError);
  EXPECT_THROW(YawProfile(trajectory, GivenYaw{{0}, {}}), InputError);
}

TEST(YawProfile, AVehicleAtRestDoesNotTurn) {
  const Vec3d points[] = {{-4, -4, 1}, {0, -3, 2}, {4, 4, 3}};
  const double durations[] = {2.3, 3.2};
  const PolynomialTrajectory trajectory = SolveMinimumSnap({.waypoints = points, .durations = durations});
  const YawProfile yaw(trajectory, YawAlongVelocity{});
  // Below 1e-3 m/s for about the first and last twentieth of a second: the heading is that of the moment where that ends.
  for (const double end : {0.0, trajectory.duration()}) {
    for (const double inwards : {1e-4, 0.01, 0.02})
      EXPECT_NEAR(yaw.At(end), yaw.At(std::abs(end - inwards)), 1e-9) << end << " " << inwards;
  }
}

}  // namespace
}  // namespace airsim360

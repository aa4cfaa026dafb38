#include "airsim360/flight/control/attitude.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/flight/control/reference.h"

namespace airsim360::internal {
namespace {

Vec3d VeeOf(const Mat3d& M) { return Vec3d{M.m[2][1] - M.m[1][2], M.m[0][2] - M.m[2][0], M.m[1][0] - M.m[0][1]} * 0.5; }

TEST(Attitude, HasTheThrustAxisAndTheHeadingThatWereAsked) {
  RngStream rng(1, "attitude");
  for (int i = 0; i < 200; ++i) {
    const Vec3d up = Normalized(Vec3d{rng.Normal(), rng.Normal(), 0.2 + std::abs(rng.Normal())});
    const double yaw = rng.Uniform(-3.1, 3.1);
    const Mat3d R = AttitudeFor(up, yaw);
    EXPECT_NEAR(Norm(R.column(2) - up), 0, 1e-12);
    EXPECT_NEAR(WrapAngle(HeadingOf(R) - yaw), 0, 1e-9);
    EXPECT_NEAR(R.determinant(), 1, 1e-12);
  }
}

TEST(Attitude, RollAndPitchAreThoseOfBodyPose) {
  const Mat3d R = BodyPose({}, 0.7, 0.3, -0.4).R;
  EXPECT_NEAR(RollPitchOf(R).roll, -0.4, 1e-12);
  EXPECT_NEAR(RollPitchOf(R).pitch, 0.3, 1e-12);
  EXPECT_NEAR(HeadingOf(R), 0.7, 1e-12);
}

TEST(Attitude, ErrorIsTheTurnThatIsMissing) {
  // About one axis of the body the error is that angle; it vanishes only when the attitude is reached.
  const Mat3d R = BodyPose({}, 0.5, 0.2, -0.3).R;
  EXPECT_NEAR(Norm(AttitudeError(R, R)), 0, 1e-12);
  EXPECT_NEAR(Norm(AttitudeError(R, R * RotationX(0.4)) - Vec3d{0.4, 0, 0}), 0, 1e-12);
  EXPECT_NEAR(Norm(AttitudeError(R, R * RotationY(-1.4)) - Vec3d{0, -1.4, 0}), 0, 1e-12);
  EXPECT_NEAR(Norm(AttitudeError(R, R * RotationZ(2.8)) - Vec3d{0, 0, 2.8}), 0, 1e-12);
  EXPECT_NEAR(AttitudeError(R, R * RotationX(3.14159)).x, 3.14159, 1e-9);
}

TEST(Attitude, RatesAreTheDerivativesOfTheFlatAttitude) {
  const Lemniscate curve({}, 2, 4, 1, 2);
  const double yaw0 = 0.3, yaw_rate = 0.5;
  const auto attitude = [&](double t) { return AttitudeFor(curve.At(t).a + Vec3d{0, 0, 9.8}, yaw0 + yaw_rate * t); };
  const auto rates = [&](double t) {
    const ReferencePoint p = curve.At(t);
    const Vec3d f = p.a + Vec3d{0, 0, 9.8};
    return RatesOf(attitude(t), Norm(f), p.jerk, p.snap, yaw0 + yaw_rate * t, yaw_rate);
  };
  const double h = 1e-5;
  for (double t = 0.5; t < 6; t += 0.37) {
    const Mat3d turn = attitude(t - h).transpose() * attitude(t + h);
    const Vec3d w = VeeOf(turn) * (1 / (2 * h));
    EXPECT_NEAR(Norm(w - rates(t).w), 0, 1e-6);
    const Vec3d alpha = (rates(t + h).w - rates(t - h).w) * (1 / (2 * h));
    EXPECT_NEAR(alpha.x, rates(t).alpha.x, 1e-5);
    EXPECT_NEAR(alpha.y, rates(t).alpha.y, 1e-5);
  }
}

TEST(Lemniscate, DerivativesAreThoseOfItsPositionAndItStartsAndEndsAtRest) {
  const Lemniscate curve({1, 2, 3}, 1.5, 3, 1, 2.5);
  const double h = 1e-4;
  for (double t = 0.1; t < curve.duration() - 0.1; t += 0.171) {
    const ReferencePoint a = curve.At(t - h), b = curve.At(t + h), m = curve.At(t);
    EXPECT_NEAR(Norm((b.p - a.p) / (2 * h) - m.v), 0, 1e-5);
    EXPECT_NEAR(Norm((b.v - a.v) / (2 * h) - m.a), 0, 1e-5);
    EXPECT_NEAR(Norm((b.a - a.a) / (2 * h) - m.jerk), 0, 1e-4);
    EXPECT_NEAR(Norm((b.jerk - a.jerk) / (2 * h) - m.snap), 0, 1e-3);
  }
  for (const double t : {0.0, curve.duration()}) {
    EXPECT_NEAR(Norm(curve.At(t).p - Vec3d{1, 2, 3}), 0, 1e-9);
    EXPECT_NEAR(Norm(curve.At(t).v) + Norm(curve.At(t).a) + Norm(curve.At(t).jerk), 0, 1e-9);
  }
}

TEST(Lemniscate, ReachesItsPeakSpeedInTheMiddle) {
  const Lemniscate curve({}, 2, 5, 2, 3);
  double fastest = 0;
  for (double t = 0; t < curve.duration(); t += 1e-3) fastest = std::max(fastest, Norm(curve.At(t).v));
  EXPECT_NEAR(fastest, 5, 1e-3);
}

}  // namespace
}  // namespace airsim360::internal

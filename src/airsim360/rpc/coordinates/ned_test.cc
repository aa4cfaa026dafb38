#include "airsim360/rpc/coordinates/ned.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

void ExpectNear(Vec3d a, Vec3d b, double tolerance = 1e-6) { EXPECT_LT(Norm(a - b), tolerance) << a.x << " " << a.y << " " << a.z; }

TEST(Ned, NorthEastDownAreWhereTheNamesSay) {
  ExpectNear(NedFromWorld({0, 1, 0}), {1, 0, 0});   // north
  ExpectNear(NedFromWorld({1, 0, 0}), {0, 1, 0});   // east
  ExpectNear(NedFromWorld({0, 0, 1}), {0, 0, -1});  // up
  ExpectNear(NedFromWorld(NedFromWorld({1, 2, 3})), {1, 2, 3});
}

TEST(Ned, HeadingsGoFromEastCounterClockwiseToNorthClockwise) {
  EXPECT_NEAR(SwapHeading(0), kPi / 2, 1e-12);  // facing east is yaw 90 of N
  EXPECT_NEAR(SwapHeading(kPi / 2), 0, 1e-12);  // facing north
  EXPECT_NEAR(SwapHeading(SwapHeading(1.234)), 1.234, 1e-12);
  // The same through the quaternion: a body that faces yaw 0.3 of N.
  const airsim::Pose pose = airsim::ToPose(BodyPose({}, SwapHeading(0.3), 0, 0), {});
  EXPECT_NEAR(pose.orientation.w_val, std::cos(0.15), 1e-6);
  EXPECT_NEAR(pose.orientation.z_val, std::sin(0.15), 1e-6);
}

TEST(Ned, NoseUpAndRightSideDownArePositivePitchAndRollOfF) {
  // AirSim: q = (cos, sin about F's y axis) for pitch, about x for roll.
  const airsim::Pose pitched = airsim::ToPose(BodyPose({}, kPi / 2, 0.4, 0), {});
  EXPECT_NEAR(pitched.orientation.y_val, std::sin(0.2), 1e-6);
  const airsim::Pose rolled = airsim::ToPose(BodyPose({}, kPi / 2, 0, 0.4), {});
  EXPECT_NEAR(rolled.orientation.x_val, std::sin(0.2), 1e-6);
}

TEST(Ned, PosesComeBackAsTheyWent) {
  for (int i = 0; i < 50; ++i) {
    const RigidTransform X = BodyPose({i * 0.7 - 3, 2.0 - i, 0.3 * i}, i * 0.37, std::sin(i) * 1.2, i * 0.11 - 2);
    const Vec3d origin{3, -4, 5};
    const RigidTransform back = airsim::FromPose(airsim::ToPose(X, origin), origin);
    ExpectNear(back.p, X.p, 1e-5);
    for (int j = 0; j < 3; ++j) ExpectNear(back.R.column(j), X.R.column(j));
    const RigidTransform mount = airsim::FromMount(airsim::ToMount(X));
    ExpectNear(mount.p, X.p, 1e-5);
    for (int j = 0; j < 3; ++j) ExpectNear(mount.R.column(j), X.R.column(j));
  }
}

// A second way: the direction a body looks in, through N, is what W says.
TEST(Ned, RotationsAgreeWithTheirDirections) {
  const RigidTransform X = BodyPose({}, 0.8, -0.3, 1.1);
  const Mat3d R_NF = NedRotation(X.R);
  const Vec3d in_body{0.2, -0.5, 0.9};
  ExpectNear(R_NF * FrdFromBody(in_body), NedFromWorld(X.R * in_body));
  EXPECT_NEAR(R_NF.determinant(), 1, 1e-12);
}

TEST(Ned, WhatIsNoRotationIsRefused) {
  airsim::Quaternionr q{0, 0, 0, 0};
  EXPECT_THROW(airsim::FromQuaternionr(q), std::invalid_argument);
  q.w_val = std::numeric_limits<float>::infinity();
  EXPECT_THROW(airsim::FromQuaternionr(q), std::invalid_argument);
}

}  // namespace
}  // namespace airsim360

#include "airsim360/math/transform.h"

#include <gtest/gtest.h>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

void ExpectNear(Vec3d a, Vec3d b, double tolerance) { EXPECT_LT(Norm(a - b), tolerance); }

TEST(Transform, QuaternionAndMatrixAreInverses) {
  RngStream rng(3, "quaternion");
  for (int i = 0; i < 1000; ++i) {
    const Mat3d R = RotationZ(rng.Uniform(-kPi, kPi)) * RotationY(rng.Uniform(-kPi, kPi)) * RotationX(rng.Uniform(-kPi, kPi));
    const Mat3d back = ToMatrix(ToQuaternion(R));
    for (int j = 0; j < 3; ++j) ExpectNear(R.column(j), back.column(j), 1e-14);
    EXPECT_GE(ToQuaternion(R).w, 0);
  }
}

TEST(Transform, BodyAnglesFollowTheContract) {
  // yaw 90 deg faces north (+Y); pitch up raises the nose; roll right lowers the right side.
  ExpectNear(BodyPose({}, kPi / 2, 0, 0).R * Vec3d{1, 0, 0}, {0, 1, 0}, 1e-15);
  EXPECT_GT((BodyPose({}, 0, 0.1, 0).R * Vec3d{1, 0, 0}).z, 0);
  EXPECT_LT((BodyPose({}, 0, 0, 0.1).R * Vec3d{0, -1, 0}).z, 0);  // body right is -Y
}

TEST(Transform, CameraLooksForwardWithItsTopUp) {
  const RigidTransform X_WC = BodyPose({1, 2, 3}, 0, 0, 0) * CameraInBody();
  ExpectNear(X_WC * Vec3d{0, 0, 1}, {2, 2, 3}, 1e-15);   // forward is east
  ExpectNear(X_WC * Vec3d{1, 0, 0}, {1, 1, 3}, 1e-15);   // right is south
  ExpectNear(X_WC * Vec3d{0, -1, 0}, {1, 2, 4}, 1e-15);  // up is up
  EXPECT_NEAR(X_WC.R.determinant(), 1, 1e-15);
}

TEST(Transform, InverseUndoesAPose) {
  const RigidTransform X = BodyPose({4, -5, 6}, 0.3, -0.2, 1.1);
  ExpectNear(X.inverse() * (X * Vec3d{1, 2, 3}), {1, 2, 3}, 1e-14);
}

}  // namespace
}  // namespace airsim360

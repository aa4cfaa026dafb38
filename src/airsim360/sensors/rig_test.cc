#include "airsim360/sensors/rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "airsim360/math/angles.h"
#include "airsim360/sensors/solid_angles.h"

namespace airsim360 {
namespace {

void ExpectSamePlace(Vec3d a, Vec3d b, double tolerance = 1e-12) { EXPECT_LT(Norm(a - b), tolerance); }

TEST(CameraPose, BodyFrameLooksAlongTheBodysForwardAxisWithItsUp) {
  const RigidTransform X_WB = BodyPose({1, 2, 3}, 90 * kDegree, 0, 0);
  const RigidTransform X_WC = CameraPose(PanoramicRig{}, X_WB);
  ExpectSamePlace(X_WC.R.column(2), {0, 1, 0});   // +Z forward: north
  ExpectSamePlace(X_WC.R.column(1), {0, 0, -1});  // +Y down
  ExpectSamePlace(X_WC.R.column(0), {1, 0, 0});   // +X right: east
  ExpectSamePlace(X_WC.p, {1, 2, 3});
}

TEST(CameraPose, LevelFrameKeepsOnlyTheHeading) {
  PanoramicRig rig;
  rig.pano_frame = PanoFrame::kLevel;
  const RigidTransform tilted = BodyPose({1, 2, 3}, 0.7, 0.4, -0.3);
  const RigidTransform flat = BodyPose({1, 2, 3}, 0.7, 0, 0);
  const RigidTransform X_WC = CameraPose(rig, tilted);
  const RigidTransform expected = CameraPose(PanoramicRig{}, flat);
  for (int j = 0; j < 3; ++j) ExpectSamePlace(X_WC.R.column(j), expected.R.column(j));
}

TEST(CameraPose, LevelAndBodyAgreeForALevelBody) {
  PanoramicRig level;
  level.pano_frame = PanoFrame::kLevel;
  const RigidTransform X_WB = BodyPose({0, 0, 5}, -2.1, 0, 0);
  for (int j = 0; j < 3; ++j) {
    ExpectSamePlace(CameraPose(level, X_WB).R.column(j), CameraPose(PanoramicRig{}, X_WB).R.column(j));
  }
}

TEST(CameraPose, LevelFrameHasAHeadingWhenTheBodyPointsStraightUp) {
  PanoramicRig rig;
  rig.pano_frame = PanoFrame::kLevel;
  const RigidTransform X_WC = CameraPose(rig, BodyPose({0, 0, 5}, 0.9, 90 * kDegree, 0));
  ExpectSamePlace(X_WC.R.column(2), {std::cos(0.9), std::sin(0.9), 0}, 1e-6);
}

TEST(Extrapolate, FliesOnAndKeepsTurningAboutTheBodysAxes) {
  // Half a radian a second to the left while flying east.
  const Kinematics body{BodyPose({1, 2, 3}, 0.4, 0, 0), {5, 0, 0}, {0, 0, 0.5}};
  const RigidTransform X = Extrapolate(body, 0.6), expected = BodyPose({4, 2, 3}, 0.7, 0, 0);
  ExpectSamePlace(X.p, expected.p);
  for (int j = 0; j < 3; ++j) ExpectSamePlace(X.R.column(j), expected.R.column(j));
  const Kinematics still{BodyPose({1, 2, 3}, 0.4, 0.1, 0.2), {}, {}};
  for (int j = 0; j < 3; ++j) ExpectSamePlace(Extrapolate(still, 1).R.column(j), still.X_WB.R.column(j));
}

TEST(CaptureRig, CarriesTimeAndExactPoseOfTheTrigger) {
  SceneBuilder builder("empty");
  builder.AddSky();
  const auto renderer = MakeNullRenderer(builder.Build());
  PanoramicRig rig;
  rig.camera = Equirectangular{16, 8};
  const Kinematics body{BodyPose({4, 5, 6}, 1.0, 0, 0), {1, 0, 0}, {0, 0, 0.5}};
  Capture capture;
  CaptureRig(rig, body, 123'000'000, *renderer, capture);
  EXPECT_EQ(capture.t_ns, 123'000'000);
  ExpectSamePlace(capture.X_WC.p, {4, 5, 6});
  ExpectSamePlace(capture.body.w_WB_B, {0, 0, 0.5});
  EXPECT_EQ(capture.frame.entity.width(), 16);
  EXPECT_EQ(capture.frame.entity.height(), 8);
}

TEST(PixelSolidAngles, OfAFullPanoramaSumToFourPi) {
  const PixelSolidAngles solid(Equirectangular{64, 32});
  double sum = 0;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) sum += solid(x, y);
  }
  EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-10);
}

TEST(PixelSolidAngles, OfACubeFaceSumToASixthOfTheSphere) {
  const PixelSolidAngles solid(CubeFace{CubeFaceName::kPosX, 32});
  double sum = 0;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) sum += solid(x, y);
  }
  EXPECT_NEAR(sum, 4 * std::numbers::pi / 6, 1e-10);
}

}  // namespace
}  // namespace airsim360

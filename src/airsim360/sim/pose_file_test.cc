#include "airsim360/sim/pose_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

double Difference(const RigidTransform& a, const RigidTransform& b) {
  double most = Norm(a.p - b.p);
  for (int j = 0; j < 3; ++j) most = std::max(most, Norm(a.R.column(j) - b.R.column(j)));
  return most;
}

TEST(PoseFile, AnglesQuaternionsAndTumOfRandomPosesAreTheSame) {
  RngStream rng(1, "poses");
  for (int i = 0; i < 200; ++i) {
    const Vec3d p{rng.Uniform(-1e4, 1e4), rng.Uniform(-1e4, 1e4), rng.Uniform(-100, 100)};
    const double yaw = rng.Uniform(-180, 180), pitch = rng.Uniform(-90, 90), roll = rng.Uniform(-180, 180);
    const double k = std::numbers::pi / 180;
    const RigidTransform X_WB = BodyPose(p, yaw * k, pitch * k, roll * k);
    const Quaternion q = ToQuaternion((X_WB * CameraInBody()).R);
    char angles[400], quaternion[400], tum[400];
    std::snprintf(angles, sizeof angles, "x,y,z,yaw_deg,pitch_deg,roll_deg\n%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", p.x, p.y, p.z, yaw,
                  pitch, roll);
    std::snprintf(quaternion, sizeof quaternion, "qx,qy,qz,qw,x,y,z\n%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g", q.x, q.y, q.z, q.w, p.x,
                  p.y, p.z);
    std::snprintf(tum, sizeof tum, "# a comment\n\n12.5\t%.17g %.17g %.17g  %.17g %.17g %.17g %.17g\r\n", p.x, p.y, p.z, q.x, q.y, q.z,
                  q.w);
    for (const char* text : {angles, quaternion, tum}) {
      const auto poses = ParsePoses(text, "x");
      ASSERT_EQ(poses.size(), 1u);
      EXPECT_LT(Difference(poses[0].body.X_WB, X_WB), 1e-9);
      EXPECT_EQ(poses[0].t_ns, 0);
    }
  }
}

TEST(PoseFile, FramesOfADatasetKeepTheirTimesVelocitiesAndBody) {
  const char text[] =
      R"({"t_ns": 40, "X_WC": {"p": [1, 2, 3], "q_wxyz": [0.5, -0.5, 0.5, -0.5]}, "v_WB": [1, 0, 2], "w_WB_B": [0, 0, 0.5]})"
      "\n"
      R"({"t_ns": 1000000040, "X_WC": {"p": [9, 9, 9], "q_wxyz": [1, 0, 0, 0]}, "X_WB": {"p": [4, 5, 6], "q_wxyz": [1, 0, 0, 0]}})";
  const auto poses = ParsePoses(text, "x");
  ASSERT_EQ(poses.size(), 2u);
  // The camera of a body that faces east, and the body itself.
  EXPECT_LT(Difference(poses[0].body.X_WB, {Mat3d{}, {1, 2, 3}}), 1e-12);
  EXPECT_EQ(poses[0].body.v_WB, (Vec3d{1, 0, 2}));
  EXPECT_EQ(poses[0].body.w_WB_B, (Vec3d{0, 0, 0.5}));
  EXPECT_LT(Difference(poses[1].body.X_WB, {Mat3d{}, {4, 5, 6}}), 1e-12);
  EXPECT_EQ(poses[1].t_ns, 1'000'000'000);
}

TEST(PoseFile, AByteOrderMarkIsLeftOut) {
  for (const char* text : {"x,y,z\n1,2,3\n", "1,2,3\n", "0 1 2 3 0 0 0 1\n", "{\"x\": 1, \"y\": 2, \"z\": 3}\n"}) {
    const auto poses = ParsePoses("\xef\xbb\xbf" + std::string(text), "x");
    ASSERT_EQ(poses.size(), 1u);
    EXPECT_EQ(poses[0].body.X_WB.p, ParsePoses(text, "x")[0].body.X_WB.p);
  }
}

TEST(PoseFile, WithoutTimesPosesAreASecondApart) {
  const auto poses = ParsePoses("1,2,3\n4,5,6\n7,8,9\n", "x");
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(poses[2].t_ns, 2'000'000'000);
  EXPECT_EQ(poses[1].body.v_WB, Vec3d{});
}

TEST(PoseFile, WhatIsWrongIsNamedWithItsLine) {
  const auto message = [](const char* text) -> std::string {
    try {
      ParsePoses(text, "f");
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_EQ(message("# only a comment\n"), "f: no poses");
  EXPECT_TRUE(message("x,y,z\n1,2,inf\n").starts_with("f:2: 'inf'"));
  EXPECT_TRUE(message("x,y,z\n1,2,\n").starts_with("f:2: ''"));
  EXPECT_TRUE(message("x,y\n1,2\n").starts_with("f:2: x, y and z"));
  EXPECT_TRUE(message("x,y,z,x\n").starts_with("f:1: column 'x'"));
  EXPECT_TRUE(message("1 2 3 4 5 6 7\n").starts_with("f:1: 7 values"));
  EXPECT_TRUE(message("x,y,z,yaw_deg,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n").starts_with("f:2: give angles or"));
  EXPECT_TRUE(message("x,y,z,t\n0,0,0,5\n0,0,0,4\n").starts_with("f:3: t does not grow"));
  EXPECT_TRUE(message("{\"x\":0,\"y\":0,\"z\":0,\"t\":5}\n{\"x\":0,\"y\":0,\"z\":0}\n").starts_with("f:2: some poses"));
  EXPECT_TRUE(message("1e8,0,0\n").starts_with("f:1: a place farther"));
}

}  // namespace
}  // namespace airsim360

// Keypoint orders, sockets of users and boxes on the sphere.
#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/people/keypoints/keypoint_orders.h"
#include "airsim360/people/keypoints/sphere_box.h"

namespace airsim360 {
namespace {

std::string NameAt(const KeypointOrder& order, size_t i) {
  return order.sockets[i] < 0 ? "" : std::string(kSocketNames[static_cast<size_t>(order.sockets[i])]);
}

TEST(KeypointOrders, HaveThePublishedLengthsAndPlaces) {
  const std::pair<const char*, size_t> sizes[] = {{"coco17", 17}, {"coco133", 133}, {"openpose25", 25},
                                                  {"h36m17", 17}, {"smpl24", 24},   {"jta22", 22}};
  for (const auto& [name, size] : sizes) EXPECT_EQ(OrderByName(name).sockets.size(), size) << name;
  EXPECT_EQ(NameAt(OrderByName("coco17"), 0), "nose");
  EXPECT_EQ(NameAt(OrderByName("coco17"), 9), "left_wrist");
  EXPECT_EQ(NameAt(OrderByName("coco17"), 16), "right_ankle");
  EXPECT_EQ(NameAt(OrderByName("coco133"), 19), "left_heel");
  EXPECT_EQ(NameAt(OrderByName("coco133"), 112), "right_wrist");
  EXPECT_EQ(NameAt(OrderByName("openpose25"), 8), "mid_hip");
  EXPECT_EQ(NameAt(OrderByName("openpose25"), 24), "right_heel");
  EXPECT_EQ(NameAt(OrderByName("h36m17"), 10), "head_top");
  EXPECT_EQ(NameAt(OrderByName("smpl24"), 17), "right_shoulder");
  EXPECT_EQ(NameAt(OrderByName("jta22"), 21), "left_ankle");
}

TEST(KeypointOrders, NoSocketIsNamedTwiceInOneOrder) {
  for (const KeypointOrder& order : KeypointOrders()) {
    if (order.name == "coco133") continue;  // has the nose in body and face, the wrists in body and hands
    std::vector<int> uses(kSocketCount);
    for (const int8_t socket : order.sockets) {
      if (socket < 0) continue;
      EXPECT_EQ(++uses[static_cast<size_t>(socket)], 1) << order.name << " " << int{socket};
    }
  }
  EXPECT_THROW(OrderByName("coco18"), InputError);
}

TEST(Sockets, AreReadWithJointOffsetAndRadius) {
  const auto sockets = ParseSockets(
      R"({"sockets": [{"name": "phone_screen", "joint": "right_wrist", "offset": {"x": 0.1, "z": -0.02}, "radius": 0.01}]})", "mine.json");
  ASSERT_EQ(sockets.size(), 1u);
  EXPECT_EQ(sockets[0].joint, Joint::kRightWrist);
  EXPECT_EQ(sockets[0].p_J, (Vec3d{0.1, 0, -0.02}));
  SkeletonPose pose;
  pose[Joint::kRightWrist] = {RotationZ(kPi / 2), {1, 2, 3}};
  const Vec3d p = SocketPosition(sockets[0], pose);
  EXPECT_NEAR(Norm(p - Vec3d{1, 2.1, 2.98}), 0, 1e-12);
}

TEST(Sockets, MistakesAreNamedWithTheFile) {
  const auto message = [](const char* text) {
    try {
      ParseSockets(text, "mine.yaml");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message("sockets: [{name: a, joint: right_wirst}]").find("did you mean 'right_wrist'"), std::string::npos);
  EXPECT_NE(message("sockets: [{name: nose, joint: head}]").find("the name is taken"), std::string::npos);
  EXPECT_NE(message("sockets: [{name: a, joint: head}, {name: a, joint: neck}]").find("taken"), std::string::npos);
  EXPECT_NE(message("sockets:\n  - {name: a, joint: head, radius: 7}").find("mine.yaml:2"), std::string::npos);
}

// Random directions within `spread` radians of a place.
std::vector<Vec3d> Cloud(double lon, double lat, double spread, uint64_t seed) {
  RngStream rng(seed, "cloud");
  std::vector<Vec3d> cloud;
  for (int i = 0; i < 60; ++i)
    cloud.push_back(Normalized(DirectionOf(lon, lat) + Vec3d{rng.Normal(), rng.Normal(), rng.Normal()} * (spread / 2)));
  return cloud;
}

bool Contains(const FieldOfView& view, Vec3d d, double slack = 1e-9) {
  const ViewAxes axes = AxesOf(view);
  const double z = Dot(d, axes.forward);
  return z > 0 && std::abs(std::atan(Dot(d, axes.right) / z)) <= view.width / 2 + slack &&
         std::abs(std::atan(Dot(d, axes.down) / z)) <= view.height / 2 + slack;
}

TEST(FieldOfView, ContainsEverythingAndTouchesAllFourSides) {
  // Ahead, across the seam, close to a pole.
  const Vec2d places[] = {{0.3, 0.1}, {kPi, -0.2}, {1.0, 1.4}, {-2.0, -1.5}};
  for (const Vec2d& place : places) {
    const auto cloud = Cloud(place.x, place.y, 0.15, 4);
    const FieldOfView view = FitFieldOfView(cloud);
    double left = 0, right = 0, up = 0, down = 0;
    for (const Vec3d& d : cloud) {
      EXPECT_TRUE(Contains(view, d)) << place.x << " " << place.y;
      const ViewAxes axes = AxesOf(view);
      const double x = std::atan2(Dot(d, axes.right), Dot(d, axes.forward)), y = std::atan2(Dot(d, axes.down), Dot(d, axes.forward));
      left = std::min(left, x), right = std::max(right, x), up = std::min(up, y), down = std::max(down, y);
    }
    // Around a pole there may be no upright box that touches all sides: north turns with the centre.
    if (std::abs(place.y) > 1.2) continue;
    EXPECT_NEAR(-left, view.width / 2, 1e-6);
    EXPECT_NEAR(right, view.width / 2, 1e-6);
    EXPECT_NEAR(-up, view.height / 2, 1e-6);
    EXPECT_NEAR(down, view.height / 2, 1e-6);
  }
}

TEST(FieldOfView, TheRotatedOneFindsATurnedRectangleAgain) {
  for (const double gamma : {0.0, 0.4, -1.1, 1.5}) {
    const FieldOfView truth{.lon = 3.0, .lat = 0.7, .width = 0.5, .height = 0.1, .gamma = gamma};
    const ViewAxes axes = AxesOf(truth);
    std::vector<Vec3d> corners;
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0})
        corners.push_back(Normalized(axes.forward + axes.right * (x * std::tan(0.25)) + axes.down * (y * std::tan(0.05))));
    }
    const FieldOfView found = FitRotatedFieldOfView(corners);
    EXPECT_NEAR(SolidAngleOf(found), SolidAngleOf(truth), 1e-6) << gamma;
    for (const Vec3d& d : corners) EXPECT_TRUE(Contains(found, d, 1e-6));
    EXPECT_NEAR(found.lon, truth.lon, 1e-4);
    EXPECT_NEAR(found.lat, truth.lat, 1e-4);
  }
}

TEST(FieldOfView, TheRotatedOneIsNeverLargerAndContainsEverything) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const auto cloud = Cloud(0.5 * static_cast<double>(seed), std::sin(static_cast<double>(seed)), 0.2, seed);
    const FieldOfView upright = FitFieldOfView(cloud), turned = FitRotatedFieldOfView(cloud);
    EXPECT_LE(SolidAngleOf(turned), SolidAngleOf(upright) + 1e-12);
    for (const Vec3d& d : cloud) EXPECT_TRUE(Contains(turned, d, 1e-6));
    EXPECT_GE(turned.gamma, -kPi / 2);
    EXPECT_LT(turned.gamma, kPi / 2 + 1e-12);
  }
}

TEST(LonLat, IsTheInverseOfDirectionAndLeavesOutPi) {
  for (const double lon : {-3.1, -0.5, 0.0, 2.9}) {
    const Vec2d place = LonLat(DirectionOf(lon, 0.8) * 7.0);
    EXPECT_NEAR(place.x, lon, 1e-12);
    EXPECT_NEAR(place.y, 0.8, 1e-12);
  }
  EXPECT_EQ(LonLat({0, 0, -1}).x, -kPi);
}

}  // namespace
}  // namespace airsim360

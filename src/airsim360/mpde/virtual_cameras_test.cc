// Virtual cameras and what is made of keypoints.
#include "airsim360/mpde/virtual_cameras.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/mpde/test_people.h"

namespace airsim360 {
namespace {

using internal::StickPerson;

const ViewDraw kExact{.slope = 0, .noise = 0, .noise_px = 0};

TEST(MpdeViews, TheSceneIsThatOfAPinholeAtTheDrawnHeight) {
  // All keypoints of an upright person are at one depth but for a few centimetres, so rays give back height and stature.
  const PersonShape shape = StickPerson(1.8);
  for (uint64_t i = 0; i < 200; ++i) {
    RngStream random(1, "views", i);
    const MpdeSample sample = DrawView(shape, kExact, random);
    const double slant = std::sqrt(1 + std::pow(sample.rays[22], 2) + std::pow(sample.rays[23], 2));
    const double z = sample.truth.distance / slant;
    EXPECT_NEAR((sample.rays[31] - sample.rays[3]) * z, (0.94 - 0.04) * 1.8, 0.1);
    const double below = sample.rays[31] * z + 0.04 * 1.8;  // of the ground under the camera
    EXPECT_GT(below, 1.4 - 0.15);
    EXPECT_LT(below, 1.95 + 0.15);
    EXPECT_LE(std::abs(std::atan(sample.rays[22])), 37.5 * kPi / 180);
    EXPECT_GE(sample.truth.distance, 3.4);
    EXPECT_LE(sample.truth.distance, 50.1);
  }
}

TEST(MpdeViews, OnesBackShowsTheRightShoulderAtTheRight) {
  // Allocentric angle -90 degrees: the heading is that of the line of sight, away from the camera.
  const PersonShape shape = StickPerson(1.7);
  int away = 0, towards = 0;
  for (uint64_t i = 0; i < 400; ++i) {
    RngStream random(2, "views", i);
    const MpdeSample sample = DrawView(shape, kExact, random);
    const float across = sample.rays[12] - sample.rays[10];  // right shoulder minus left, to the right
    const double from_away = std::abs(WrapAngle(sample.truth.angle + kPi / 2));
    if (from_away < 1.2) {
      EXPECT_GT(across, 0);
      ++away;
    }
    if (from_away > kPi - 1.2) {
      EXPECT_LT(across, 0);
      ++towards;
    }
  }
  EXPECT_GT(away, 50);
  EXPECT_GT(towards, 50);
}

TEST(MpdeViews, PitchTurnsThePictureAndKeepsDistances) {
  const PersonShape shape = StickPerson(1.7);
  ViewDraw down = kExact;
  down.pitch_deg = 20, down.half_height_deg = 80;
  ViewDraw level = down;
  level.pitch_deg = 0;
  for (uint64_t i = 0; i < 50; ++i) {
    RngStream a(3, "views", i), b(3, "views", i);
    const MpdeSample flat = DrawView(shape, level, a), pitched = DrawView(shape, down, b);
    EXPECT_NEAR(flat.truth.distance, pitched.truth.distance, 1e-9);
    // A ray turned down by 20 degrees about the axis to the right.
    const double c = std::cos(20 * kPi / 180), s = std::sin(20 * kPi / 180);
    for (size_t k = 0; k < flat.rays.size(); k += 2) {
      const double z = c + flat.rays[k + 1] * s;
      EXPECT_NEAR(pitched.rays[k], flat.rays[k] / z, 1e-5);
      EXPECT_NEAR(pitched.rays[k + 1], (c * flat.rays[k + 1] - s) / z, 1e-5);
    }
  }
}

TEST(MpdeViews, TheMirrorIsItsOwnInverseAndTurnsTheHeading) {
  RngStream random(4, "views");
  const MpdeSample sample = DrawView(StickPerson(1.7), kExact, random), mirrored = Mirrored(sample), twice = Mirrored(mirrored);
  EXPECT_EQ(twice.rays, sample.rays);
  EXPECT_NEAR(WrapAngle(twice.truth.angle - sample.truth.angle), 0, 1e-12);
  EXPECT_NEAR(std::sin(mirrored.truth.angle), std::sin(sample.truth.angle), 1e-12);
  EXPECT_NEAR(std::cos(mirrored.truth.angle), -std::cos(sample.truth.angle), 1e-12);
  EXPECT_EQ(mirrored.rays[2], -sample.rays[4]);  // left eye from the right one
}

TEST(MpdeViews, ThePersonOfTheBaselineIsToldExactly) {
  // Straight ahead, eyes at 0.936 and ankles at 0.039 of 1.72 m: the baseline's own proportions, without depth.
  PersonShape shape = StickPerson(1.72);
  for (Vec3d& p : shape.keypoints) p.x = 0;
  shape.keypoints[1].z = shape.keypoints[2].z = 0.936 * 1.72;
  shape.keypoints[15].z = shape.keypoints[16].z = 0.039 * 1.72;
  shape.center.z = 0.5 * (0.936 + 0.039) * 1.72;
  ViewDraw draw = kExact;
  draw.bearing_deg = 0;
  for (uint64_t i = 0; i < 50; ++i) {
    RngStream random(5, "views", i);
    const MpdeSample sample = DrawView(shape, draw, random);
    // Ear, shoulder and hip pairs turn with the person; the vertical span does not.
    EXPECT_NEAR(ConstantHeightDistance(sample.rays) / sample.truth.distance, 1, 0.02);
  }
}

// Apparent lengths in metres of real people over ours, as measured: medians of whole detections within 20 m and of our adults.
TEST(MpdeViews, AnnotatorsWidenHipsAndShortenLimbs) {
  const PersonShape joints = StickPerson(1.7), marked = AsAnnotated(joints);
  const auto ratio = [&](size_t a, size_t b) {
    return Norm(marked.keypoints[a] - marked.keypoints[b]) / Norm(joints.keypoints[a] - joints.keypoints[b]);
  };
  EXPECT_NEAR(ratio(11, 12), 0.178 / 0.129, 3e-3);
  EXPECT_NEAR(ratio(5, 6), 0.265 / 0.257, 3e-3);
  EXPECT_NEAR(ratio(3, 4), 0.136 / 0.099, 3e-3);
  EXPECT_NEAR(ratio(5, 7), 0.264 / 0.310, 3e-3);
  EXPECT_NEAR(ratio(8, 10), 0.217 / 0.236, 3e-3);
  EXPECT_NEAR(ratio(11, 13), 0.386 / 0.405, 3e-3);
  EXPECT_NEAR(ratio(14, 16), 0.373 / 0.398, 3e-3);
  const auto middle = [](const PersonShape& s, size_t a) { return (s.keypoints[a] + s.keypoints[a + 1]) * 0.5; };
  EXPECT_NEAR(Norm(middle(marked, 5) - middle(marked, 11)) / Norm(middle(joints, 5) - middle(joints, 11)), 0.499 / 0.487, 3e-3);
}

TEST(MpdeViews, NoiseHasItsSize) {
  RngStream random(6, "views");
  const MpdeSample sample = DrawView(StickPerson(1.7), kExact, random);
  const double height = sample.rays[31] - sample.rays[3];
  double square = 0;
  constexpr int kDraws = 500;
  for (int i = 0; i < kDraws; ++i) {
    KeypointRays rays = sample.rays;
    AddKeypointNoise({.noise = 0.05, .noise_px = 0}, random, rays);
    for (size_t k = 0; k < rays.size(); ++k) square += std::pow(rays[k] - sample.rays[k], 2) / (kDraws * 34.0);
  }
  EXPECT_NEAR(std::sqrt(square) / height, 0.05, 0.003);
}

TEST(MpdeViews, ShapeInputsDoNotDependOnSizeButForOne) {
  RngStream random(7, "views");
  const MpdeSample sample = DrawView(StickPerson(1.7), kExact, random);
  KeypointRays half = sample.rays;
  for (float& v : half) v *= 0.5f;
  std::vector<float> a(37), b(37);
  Encode(sample.rays, MpdeEncoding::kShape, a);
  Encode(half, MpdeEncoding::kShape, b);
  for (size_t i = 0; i < 34; ++i) EXPECT_NEAR(a[i], b[i], 1e-4);
  EXPECT_NEAR(a[34], 2 * b[34], 1e-6);
  EXPECT_NEAR(a[36] - b[36], std::log(2), 1e-5);
}

TEST(MpdeViews, AnUnknownNameIsRefusedWithTheNearest) {
  EXPECT_THROW(NamedViews("kity"), InputError);
  EXPECT_EQ(NamedViews("kitti").focal_px, 721);
}

}  // namespace
}  // namespace airsim360

#include "airsim360/projection/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

// Angle between unit vectors, good for small angles.
double Angle(Vec3d a, Vec3d b) { return std::atan2(Norm(Cross(a, b)), Dot(a, b)); }

std::vector<Camera> Cameras() {
  std::vector<Camera> cameras;
  for (int h : {1, 2, 33, 64}) cameras.push_back(Equirectangular{2 * h, h});
  for (int f = 0; f < 6; ++f) {
    for (int size : {1, 2, 31, 64}) cameras.push_back(CubeFace{static_cast<CubeFaceName>(f), size});
  }
  cameras.push_back(Pinhole{64, 48, 32, 32, 32, 24});
  cameras.push_back(Pinhole{51, 37, 20.5, 31.25, 11.5, 40.75});  // skewed centre, unequal focal lengths
  for (double fov_deg : {60.0, 180.0, 235.0, 360.0}) {
    cameras.push_back(Fisheye::Equidistant(63, 48, fov_deg * kPi / 180));
  }
  // Figures of the size that calibrations of real lenses give.
  cameras.push_back(Fisheye{65, 64, 20.5, 21.0, 32.25, 31.5, {-0.0131, 0.0123, -0.0078, 0.0012}, 1.6});
  cameras.push_back(Fisheye{65, 64, 9.5, 10.0, 32.25, 31.5, {0.4, 0.05, 0.01, 0.001}, kPi});
  return cameras;
}

TEST(Camera, PixelToRayToPixelAndBackIsExactAtEveryPixelCentre) {
  for (const Camera& camera : Cameras()) {
    CheckCamera(camera);
    int seen = 0;
    for (int y = 0; y < Height(camera); ++y) {
      for (int x = 0; x < Width(camera); ++x) {
        const Vec2d pixel{x + 0.5, y + 0.5};
        const auto ray = PixelToRay(camera, pixel);
        if (!ray) continue;
        ++seen;
        ASSERT_NEAR(Norm(*ray), 1, 1e-14);
        const auto back = RayToPixel(camera, *ray);
        ASSERT_TRUE(back) << camera.index() << " at " << x << "," << y;
        ASSERT_NEAR(back->x, pixel.x, 1e-9);
        ASSERT_NEAR(back->y, pixel.y, 1e-9);
        const auto again = PixelToRay(camera, *back);
        ASSERT_TRUE(again);
        ASSERT_LT(Angle(*ray, *again), 1e-12);
      }
    }
    EXPECT_GT(seen, 0);
  }
}

TEST(Camera, RayToPixelToRayIsExactForRandomRaysOfAnyLength) {
  RngStream rng(1, "rays");
  for (const Camera& camera : Cameras()) {
    for (int n = 0; n < 2000; ++n) {
      const Vec3d ray{rng.Normal(), rng.Normal(), rng.Normal()};
      const auto pixel = RayToPixel(camera, ray * std::exp(3 * rng.Normal()));
      if (!pixel) continue;
      EXPECT_GE(pixel->x, 0);
      EXPECT_LE(pixel->x, Width(camera));
      EXPECT_GE(pixel->y, 0);
      EXPECT_LE(pixel->y, Height(camera));
      const auto back = PixelToRay(camera, *pixel);
      ASSERT_TRUE(back);
      // Where r(theta) is almost flat (real lenses at the rim) the last bits of r are less of theta.
      ASSERT_LT(Angle(Normalized(ray), *back), 1e-9);
    }
  }
}

TEST(Equirectangular, FollowsTheConventionOfTheFrames) {
  const Camera erp = Equirectangular{8, 4};
  const auto expect_ray = [&](Vec2d pixel, Vec3d expected) {
    EXPECT_LT(Norm(*PixelToRay(erp, pixel) - expected), 1e-15) << pixel.x << "," << pixel.y;
  };
  expect_ray({4, 2}, {0, 0, 1});   // centre: forward
  expect_ray({6, 2}, {1, 0, 0});   // to the right
  expect_ray({2, 2}, {-1, 0, 0});  // to the left
  expect_ray({0, 2}, {0, 0, -1});  // seam: back
  expect_ray({4, 0}, {0, -1, 0});  // top: up
  expect_ray({4, 4}, {0, 1, 0});   // bottom: down
  // Beyond the seam columns wrap; beyond a pole the other side comes into view.
  EXPECT_LT(Norm(*PixelToRay(erp, {9, 1.5}) - *PixelToRay(erp, {1, 1.5})), 1e-15);
  EXPECT_LT(Norm(*PixelToRay(erp, {1, -0.5}) - *PixelToRay(erp, {5, 0.5})), 1e-15);
}

TEST(Equirectangular, EveryDirectionHasAColumnBelowW) {
  const Camera erp = Equirectangular{8, 4};
  for (const Vec3d ray : {Vec3d{0, 0, -1}, Vec3d{-0.0, 0, -1}, Vec3d{1e-300, 0, -1}, Vec3d{0, 1, 0}, Vec3d{0, -1, -0.0}}) {
    const auto pixel = RayToPixel(erp, ray);
    ASSERT_TRUE(pixel);
    EXPECT_GE(pixel->x, 0);
    EXPECT_LT(pixel->x, 8);
  }
  EXPECT_NEAR(RayToPixel(erp, {0, -1, 0})->y, 0, 1e-15);
  EXPECT_NEAR(RayToPixel(erp, {0, 1, 0})->y, 4, 1e-15);
}

TEST(CubeFace, FacesAreNamedByTheAxisTheyLookAlongAndRotationsAreProper) {
  const Vec3d axis[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int f = 0; f < 6; ++f) {
    const auto face = static_cast<CubeFaceName>(f);
    EXPECT_EQ(*PixelToRay(CubeFace{face, 4}, {2, 2}), axis[f]);
    const Mat3d R = CubeFaceRotation(face);
    EXPECT_EQ(R.determinant(), 1);
    EXPECT_EQ(R * R.transpose(), Mat3d{});
  }
}

TEST(CubeFace, SideFacesStandUprightAndUpAndDownAreReachedByPitching) {
  const auto top = [](CubeFaceName face) { return *PixelToRay(CubeFace{face, 4}, {2, -1e9}); };
  for (const auto face : {CubeFaceName::kPosZ, CubeFaceName::kPosX, CubeFaceName::kNegZ, CubeFaceName::kNegX}) {
    EXPECT_LT(Norm(top(face) - Vec3d{0, -1, 0}), 1e-6);
  }
  EXPECT_LT(Norm(top(CubeFaceName::kNegY) - Vec3d{0, 0, -1}), 1e-6);  // up face: back at its top
  EXPECT_LT(Norm(top(CubeFaceName::kPosY) - Vec3d{0, 0, 1}), 1e-6);   // down face: front at its top
  // Pitching up by a quarter turn is a rotation about +X that takes +Z to -Y.
  EXPECT_EQ(CubeFaceRotation(CubeFaceName::kNegY), RotationX(kPi / 2));
  EXPECT_EQ(CubeFaceRotation(CubeFaceName::kPosY), RotationX(-kPi / 2));
  EXPECT_EQ(CubeFaceRotation(CubeFaceName::kPosX), RotationY(kPi / 2));
  EXPECT_EQ(CubeFaceRotation(CubeFaceName::kNegX), RotationY(-kPi / 2));
  EXPECT_EQ(CubeFaceRotation(CubeFaceName::kNegZ), RotationY(kPi));
}

TEST(CubeFace, ExactlyOneFaceSeesARayAndRayToCubeAgreesWithItsCamera) {
  RngStream rng(2, "cube");
  for (int n = 0; n < 5000; ++n) {
    const Vec3d ray{rng.Normal(), rng.Normal(), rng.Normal()};
    const auto [face, at] = RayToCube(ray, 96);
    for (int f = 0; f < 6; ++f) {
      const auto pixel = RayToPixel(CubeFace{static_cast<CubeFaceName>(f), 96}, ray);
      ASSERT_EQ(pixel.has_value(), f == static_cast<int>(face));
      if (pixel) {
        ASSERT_NEAR(pixel->x, at.x, 1e-11);
        ASSERT_NEAR(pixel->y, at.y, 1e-11);
      }
    }
  }
}

TEST(Camera, PinholeAndCubeFaceOfNinetyDegreesAreTheSame) {
  const Camera face = CubeFace{CubeFaceName::kPosZ, 32}, pinhole = Pinhole{32, 32, 16, 16, 16, 16};
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      EXPECT_LT(Angle(*PixelToRay(face, {x + 0.5, y + 0.5}), *PixelToRay(pinhole, {x + 0.5, y + 0.5})), 1e-15);
      EXPECT_DOUBLE_EQ(SolidAngle(face, x, y), SolidAngle(pinhole, x, y));
    }
  }
}

TEST(Camera, NothingIsSeenBehindAPinholeOrOutsideAFisheyeCircle) {
  EXPECT_FALSE(RayToPixel(Pinhole{}, {0, 0, -1}));
  EXPECT_FALSE(RayToPixel(Pinhole{}, {5, 0, 1}));
  EXPECT_FALSE(RayToPixel(CubeFace{}, {1.01, 0, 1}));
  const Camera fisheye = Fisheye::Equidistant(100, 100, kPi);
  EXPECT_FALSE(PixelToRay(fisheye, {0.5, 0.5}));
  EXPECT_FALSE(RayToPixel(fisheye, {0, 0, -1}));
  EXPECT_TRUE(RayToPixel(fisheye, {1, 0, 1e-3}));
  EXPECT_TRUE(RayToPixel(Fisheye::Equidistant(100, 100, 2 * kPi), {0, 0, -1}));
  // Directions that are none are seen by no one.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(RayToPixel(Pinhole{}, {nan, nan, nan}));
  EXPECT_FALSE(RayToPixel(fisheye, {nan, nan, nan}));
  EXPECT_FALSE(RayToPixel(CubeFace{}, {0, 0, 0}));
}

TEST(Fisheye, EquidistantRadiusIsProportionalToTheAngle) {
  const Fisheye fisheye = Fisheye::Equidistant(200, 100, kPi);
  for (double theta : {0.1, 0.7, 1.5}) {
    const auto pixel = RayToPixel(fisheye, {std::sin(theta), 0, std::cos(theta)});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x - 100, 50 * theta / (kPi / 2), 1e-12);
    EXPECT_NEAR(pixel->y, 50, 1e-12);
  }
}

TEST(Fisheye, MatchesAProjectionWorkedOutByHand) {
  // theta = pi / 4; theta^2 = 0.6168502750680849; r = theta (1 + 0.1 t - 0.02 t^2).
  const Fisheye c{640, 480, 300, 310, 320, 240, {0.1, -0.02, 0, 0}, 1.4};
  const double t = 0.6168502750680849, r = 0.7853981633974483 * (1 + 0.1 * t - 0.02 * t * t);
  const auto pixel = RayToPixel(c, {std::sqrt(0.5), std::sqrt(0.5), 1});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x, 300 * r * std::sqrt(0.5) + 320, 1e-10);
  EXPECT_NEAR(pixel->y, 310 * r * std::sqrt(0.5) + 240, 1e-10);
}

TEST(CheckCamera, RefusesCamerasThatMakeNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(CheckCamera(Equirectangular{100, 51}), InputError);
  EXPECT_THROW(CheckCamera(Equirectangular{0, 0}), InputError);
  EXPECT_THROW(CheckCamera(CubeFace{CubeFaceName::kPosX, -4}), InputError);
  EXPECT_THROW(CheckCamera(Pinhole{64, 64, 0, 32, 32, 32}), InputError);
  EXPECT_THROW(CheckCamera(Pinhole{64, 64, 32, 32, nan, 32}), InputError);
  const Fisheye good{64, 64, 20, 20, 32, 32, {}, 1.5};
  CheckCamera(good);
  for (const auto& k : {std::array{-0.5, 0.0, 0.0, 0.0}, std::array{0.0, 0.0, 0.0, -1.0}, std::array{nan, 0.0, 0.0, 0.0},
                        std::array{1e308, 1e308, 1e308, 1e308}, std::array{0.0, inf, 0.0, 0.0},
                        // Falls in the middle of the range and grows again: both ends have a positive slope.
                        std::array{-1.0, 0.4, 0.0, 0.0}}) {
    Fisheye bad = good;
    bad.k = k;
    EXPECT_THROW(CheckCamera(bad), InputError) << k[0] << " " << k[1] << " " << k[2] << " " << k[3];
  }
  for (double theta : {0.0, -1.0, 3.2, nan}) {
    Fisheye bad = good;
    bad.max_theta = theta;
    EXPECT_THROW(CheckCamera(bad), InputError);
  }
  EXPECT_THROW(Fisheye::Equidistant(64, 64, 7), InputError);
}

TEST(CheckCamera, AgreesWithASampledSlopeForRandomPolynomials) {
  RngStream rng(3, "poly");
  int grows = 0;
  for (int n = 0; n < 500; ++n) {
    Fisheye c{64, 64, 20, 20, 32, 32, {}, rng.Uniform(0.5, 3.1)};
    for (double& k : c.k) k = 0.1 * rng.Normal();
    double least = 1;
    for (int i = 0; i <= 20000; ++i) {
      const double theta = c.max_theta * i / 20000, t = theta * theta;
      least = std::min(least, 1 + 3 * c.k[0] * t + 5 * c.k[1] * t * t + 7 * c.k[2] * t * t * t + 9 * c.k[3] * t * t * t * t);
    }
    if (std::abs(least) < 1e-4) continue;
    grows += least > 0;
    if (least > 0) {
      EXPECT_NO_THROW(CheckCamera(c));
    } else {
      EXPECT_THROW(CheckCamera(c), InputError);
    }
  }
  EXPECT_GT(grows, 50);
}

double Sum(const Camera& camera) {
  double sum = 0;
  for (int j = 0; j < Height(camera); ++j) {
    double row = 0;
    for (int i = 0; i < Width(camera); ++i) row += SolidAngle(camera, i, j);
    sum += row;
  }
  return sum;
}

TEST(SolidAngle, TheWholeSphereIsFourPi) {
  for (int h : {1, 7, 64, 333}) EXPECT_NEAR(Sum(Equirectangular{2 * h, h}) / (4 * kPi), 1, 1e-12);
  for (int size : {1, 7, 64, 200}) {
    for (int f = 0; f < 6; ++f) {
      EXPECT_NEAR(Sum(CubeFace{static_cast<CubeFaceName>(f), size}) / (4 * kPi / 6), 1, 1e-12);
    }
  }
}

TEST(SolidAngle, AFisheyeCircleIsASphericalCap) {
  for (double fov : {0.5, kPi / 2, kPi, 4.5, 2 * kPi}) {
    EXPECT_NEAR(Sum(Fisheye::Equidistant(61, 61, fov)) / (2 * kPi * (1 - std::cos(fov / 2))), 1, 1e-9) << fov;
  }
  // Any radial polynomial and unequal focal lengths: still the cap of max_theta when the circle fits the
  // picture.
  const Fisheye c{90, 80, 20, 18, 44.2, 39.1, {-0.01, 0.02, -0.005, 0.001}, 1.7};
  EXPECT_NEAR(Sum(c) / (2 * kPi * (1 - std::cos(1.7))), 1, 1e-9);
}

TEST(SolidAngle, OfAPinholeMatchesTheArctangentFormula) {
  // A second closed form: the angle of the rectangle from the axis to (u, v) is atan(u v / sqrt(1 + u^2 +
  // v^2)).
  const Pinhole c{40, 30, 22, 25, 17.3, 16.1};
  const auto corner = [](double u, double v) { return std::atan(u * v / std::sqrt(1 + u * u + v * v)); };
  for (int j = 0; j < c.height; ++j) {
    for (int i = 0; i < c.width; ++i) {
      const double u0 = (i - c.cx) / c.fx, u1 = (i + 1 - c.cx) / c.fx, v0 = (j - c.cy) / c.fy, v1 = (j + 1 - c.cy) / c.fy;
      const double expected = corner(u1, v1) - corner(u0, v1) - corner(u1, v0) + corner(u0, v0);
      EXPECT_NEAR(SolidAngle(c, i, j) / expected, 1, 1e-11);
    }
  }
}

TEST(SolidAngle, MatchesTheAreaSpannedByTheCornerRaysForEveryModel) {
  // Second method: a small pixel is nearly a flat parallelogram between its corner rays.
  for (const Camera& camera : std::vector<Camera>{Equirectangular{2000, 1000}, CubeFace{CubeFaceName::kNegX, 700},
                                                  Fisheye{700, 700, 200, 210, 350.5, 349, {0.02, -0.003, 0, 0}, 2}}) {
    for (int j = 101; j < Height(camera); j += 97) {
      for (int i = 99; i < Width(camera); i += 101) {
        const auto ray = [&](double x, double y) { return PixelToRay(camera, {i + x, j + y}); };
        if (!ray(0, 0) || !ray(1, 0) || !ray(0, 1) || !ray(1, 1)) continue;
        const double area = Norm(Cross(*ray(1, 1) - *ray(0, 0), *ray(1, 0) - *ray(0, 1))) / 2;
        EXPECT_NEAR(SolidAngle(camera, i, j) / area, 1, 1e-4) << camera.index() << " " << i << "," << j;
      }
    }
  }
}

TEST(SolidAngle, PixelsOutsideTheCircleOfAFisheyeHaveNone) {
  const Camera fisheye = Fisheye::Equidistant(100, 100, kPi);
  EXPECT_NEAR(SolidAngle(fisheye, 0, 0), 0, 1e-15);
  EXPECT_GT(SolidAngle(fisheye, 50, 50), 0);
}

}  // namespace
}  // namespace airsim360

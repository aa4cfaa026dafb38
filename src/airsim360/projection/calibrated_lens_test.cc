// Calibrated lenses against the formulas of their publications, written here anew, and against their closed-form inverses.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/projection/calibrated_lens.h"
#include "airsim360/projection/camera_model_names.h"
#include "airsim360/projection/solid_angle_rows.h"

namespace airsim360 {
namespace {

using Numbers = std::vector<double>;

// The pixel of a point as its publication has it; p are the parameters after fx fy cx cy.
using Published = std::function<Vec2d(const Numbers& p, Vec3d X)>;

// OpenCV, "Camera calibration and 3D reconstruction": k = k1 … k6 of the rational model, p1 p2, s1 … s4.
Vec2d OpenCv(const Numbers& k, double p1, double p2, const Numbers& s, double x, double y) {
  const double r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
  const double radial = (1 + k[0] * r2 + k[1] * r4 + k[2] * r6) / (1 + k[3] * r2 + k[4] * r4 + k[5] * r6);
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x) + s[0] * r2 + s[1] * r4,
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y + s[2] * r2 + s[3] * r4};
}
Vec2d RadTan(const Numbers& p, double x, double y) { return OpenCv({p[0], p[1], 0, 0, 0, 0}, p[2], p[3], {0, 0, 0, 0}, x, y); }

struct Lens {
  const char* model;
  int width, height;
  Numbers parameters;
  Published published;
};

double Theta(Vec3d X) { return std::atan2(std::hypot(X.x, X.y), X.z); }

std::vector<Lens> Lenses() {
  const auto along = [](Vec3d X, double r) {
    const double across = std::hypot(X.x, X.y);
    return across > 0 ? Vec2d{r * X.x / across, r * X.y / across} : Vec2d{0, 0};
  };
  return {
      // EuRoC's left camera.
      {"OPENCV",
       752,
       480,
       {458.654, 457.296, 367.715, 248.875, -0.28340811, 0.07395907, 0.00019359, 1.76187114e-05},
       [](const Numbers& p, Vec3d X) { return RadTan(p, X.x / X.z, X.y / X.z); }},
      {"SIMPLE_RADIAL",
       640,
       480,
       {500, 320, 240, 0.11},
       [](const Numbers& p, Vec3d X) {
         const double x = X.x / X.z, y = X.y / X.z;
         return Vec2d{x * (1 + p[0] * (x * x + y * y)), y * (1 + p[0] * (x * x + y * y))};
       }},
      {"FULL_OPENCV",
       800,
       600,
       {600, 610, 390, 310, 12.1, 5.2, 0.001, -0.0007, 0.31, 12.4, 8.1, 1.2},
       [](const Numbers& p, Vec3d X) {
         return OpenCv({p[0], p[1], p[4], p[5], p[6], p[7]}, p[2], p[3], {0, 0, 0, 0}, X.x / X.z, X.y / X.z);
       }},
      {"OPENCV_THIN_PRISM",
       800,
       600,
       {600, 610, 390, 310, -0.1, 0.02, 0.001, -0.0007, 0, 0, 0, 0, 0.003, -0.001, -0.002, 0.0015},
       [](const Numbers& p, Vec3d X) {
         return OpenCv({p[0], p[1], p[4], p[5], p[6], p[7]}, p[2], p[3], {p[8], p[9], p[10], p[11]}, X.x / X.z, X.y / X.z);
       }},
      // TUM-VI's left camera.
      {"OPENCV_FISHEYE",
       512,
       512,
       {190.97847715128717, 190.9733070521226, 255.43170605935475, 257.3974428996504, 0.0034823894022493434, 0.0007150348452162257,
        -0.0020532361418706202, 0.00020293673591811182},
       [=](const Numbers& p, Vec3d X) {
         const double t = Theta(X);
         return along(X, t * (1 + p[0] * t * t + p[1] * std::pow(t, 4) + p[2] * std::pow(t, 6) + p[3] * std::pow(t, 8)));
       }},
      {"THIN_PRISM_FISHEYE",
       640,
       480,
       {310, 312, 318, 243, 0.02, -0.004, 0.0012, -0.0008, 0.0007, -0.0001, 0.0011, -0.0009},
       [=](const Numbers& p, Vec3d X) {
         const Vec2d u = along(X, Theta(X));
         const double r2 = u.x * u.x + u.y * u.y;
         const double radial = p[0] * r2 + p[1] * r2 * r2 + p[4] * std::pow(r2, 3) + p[5] * std::pow(r2, 4);
         return Vec2d{u.x + u.x * radial + 2 * p[2] * u.x * u.y + p[3] * (r2 + 2 * u.x * u.x) + p[6] * r2,
                      u.y + u.y * radial + 2 * p[3] * u.x * u.y + p[2] * (r2 + 2 * u.y * u.y) + p[7] * r2};
       }},
      // Project Aria's FisheyeRadTanThinPrism: tangential and prism terms of the distorted radius.
      {"RAD_TAN_THIN_PRISM_FISHEYE",
       704,
       704,
       {305, 306, 352, 351, -0.02, 0.1, -0.06, 0.01, 0.002, -0.0006, 0.0004, -0.0002, 0.0003, -0.0001, 0.0002, -0.00005},
       [=](const Numbers& p, Vec3d X) {
         const double t = Theta(X);
         double series = 1;
         for (int i = 0; i < 6; ++i) series += p[static_cast<size_t>(i)] * std::pow(t, 2 * i + 2);
         const Vec2d u = along(X, t * series);
         const double r2 = u.x * u.x + u.y * u.y, p0 = p[6], p1 = p[7];
         return Vec2d{u.x + p0 * (2 * u.x * u.x + r2) + 2 * p1 * u.x * u.y + p[8] * r2 + p[9] * r2 * r2,
                      u.y + p1 * (2 * u.y * u.y + r2) + 2 * p0 * u.x * u.y + p[10] * r2 + p[11] * r2 * r2};
       }},
      {"FOV",
       640,
       480,
       {250, 251, 322, 238, 0.92},
       [=](const Numbers& p, Vec3d X) {
         const double r = std::hypot(X.x / X.z, X.y / X.z);
         return along(X, std::atan(2 * r * std::tan(p[0] / 2)) / p[0]);
       }},
      {"EUCM",
       640,
       480,
       {220, 221, 319, 241, 0.62, 1.1},
       [](const Numbers& p, Vec3d X) {
         const double d = std::sqrt(p[1] * (X.x * X.x + X.y * X.y) + X.z * X.z), below = p[0] * d + (1 - p[0]) * X.z;
         return Vec2d{X.x / below, X.y / below};
       }},
      {"DOUBLE_SPHERE",
       512,
       512,
       {158, 159, 255, 257, -0.18, 0.59},
       [](const Numbers& p, Vec3d X) {
         const double d1 = Norm(X), z = p[0] * d1 + X.z, d2 = std::sqrt(X.x * X.x + X.y * X.y + z * z);
         const double below = p[1] * d2 + (1 - p[1]) * z;
         return Vec2d{X.x / below, X.y / below};
       }},
      {"OMNI",
       752,
       480,
       {670, 672, 370, 245, 1.27, -0.21, 0.13, 0.0006, -0.0004},
       [](const Numbers& p, Vec3d X) {
         const Vec3d S = X / Norm(X);
         return RadTan({p[1], p[2], p[3], p[4]}, S.x / (S.z + p[0]), S.y / (S.z + p[0]));
       }},
      {"F_THETA",
       1920,
       1208,
       {1, 1, 958.3, 604.1, 930.5, -12.2, 8.1, -33.7, 10.4, -1.5},
       [=](const Numbers& p, Vec3d X) {
         const double t = Theta(X);
         double r = 0;
         for (int i = 0; i < 6; ++i) r += p[static_cast<size_t>(i)] * std::pow(t, i + 1);
         return along(X, r);
       }},
  };
}

// fx fy cx cy and the rest of a model's parameters.
std::pair<Numbers, Numbers> Split(const Lens& lens) {
  Numbers head = lens.parameters, rest;
  if (std::string(lens.model).starts_with("SIMPLE")) head.insert(head.begin(), head.front());
  rest.assign(head.begin() + 4, head.end());
  head.resize(4);
  return {head, rest};
}

TEST(CalibratedLens, EveryPixelsRayProjectsBackByThePublishedFormula) {
  for (const Lens& lens : Lenses()) {
    SCOPED_TRACE(lens.model);
    const Camera camera = MakeCamera(lens.model, lens.width, lens.height, lens.parameters);
    const auto [K, rest] = Split(lens);
    double worst = 0, worst_own = 0;
    int seen = 0, all = 0;
    for (int y = 0; y < lens.height; y += 3) {
      for (int x = 0; x < lens.width; x += 3) {
        const Vec2d pixel{x + 0.5, y + 0.5};
        ++all;
        const auto ray = PixelToRay(camera, pixel);
        if (!ray) continue;
        ++seen;
        EXPECT_NEAR(Norm(*ray), 1, 1e-14);
        const Vec2d m = lens.published(rest, *ray), at{K[0] * m.x + K[2], K[1] * m.y + K[3]};
        worst = std::max(worst, std::hypot(at.x - pixel.x, at.y - pixel.y));
        const auto own = RayToPixel(camera, *ray);
        ASSERT_TRUE(own);
        worst_own = std::max(worst_own, std::hypot(own->x - pixel.x, own->y - pixel.y));
      }
    }
    EXPECT_LT(worst, 1e-9);
    EXPECT_LT(worst_own, 1e-9);
    EXPECT_GT(seen, 0.78 * all);
  }
}

TEST(CalibratedLens, TheRaysOfSphericalModelsAreThoseOfTheirClosedFormInverses) {
  // Usenko et al. 2018, equations for unprojection.
  const double xi = -0.18, alpha = 0.59;
  const Camera sphere = MakeCamera("DOUBLE_SPHERE", 512, 512, Numbers{158, 159, 255, 257, xi, alpha});
  // Khomutenko et al. 2016.
  const double a = 0.62, beta = 1.1;
  const Camera unified = MakeCamera("EUCM", 640, 480, Numbers{220, 221, 319, 241, a, beta});
  // Mei and Rives 2007, without distortion.
  const Camera omni = MakeCamera("OMNI", 752, 480, Numbers{670, 672, 370, 245, 1.27, 0, 0, 0, 0});
  for (int y = 20; y < 480; y += 23) {
    for (int x = 20; x < 500; x += 23) {
      const Vec2d pixel{x + 0.5, y + 0.5};
      {
        const double mx = (pixel.x - 255) / 158, my = (pixel.y - 257) / 159, r2 = mx * mx + my * my;
        const double mz = (1 - alpha * alpha * r2) / (alpha * std::sqrt(1 - (2 * alpha - 1) * r2) + 1 - alpha);
        const double f = (mz * xi + std::sqrt(mz * mz + (1 - xi * xi) * r2)) / (mz * mz + r2);
        if (const auto ray = PixelToRay(sphere, pixel)) {
          EXPECT_LT(Norm(*ray - Vec3d{f * mx, f * my, f * mz - xi}), 1e-12);
        }
      }
      {
        const double mx = (pixel.x - 319) / 220, my = (pixel.y - 241) / 221, r2 = mx * mx + my * my;
        const double mz = (1 - beta * a * a * r2) / (a * std::sqrt(1 - (2 * a - 1) * beta * r2) + 1 - a);
        if (const auto ray = PixelToRay(unified, pixel)) {
          EXPECT_LT(Norm(*ray - Normalized(Vec3d{mx, my, mz})), 1e-12);
        }
      }
      {
        const double mx = (pixel.x - 370) / 670, my = (pixel.y - 245) / 672, r2 = mx * mx + my * my;
        const double f = (1.27 + std::sqrt(1 + (1 - 1.27 * 1.27) * r2)) / (1 + r2);
        const auto ray = PixelToRay(omni, pixel);
        ASSERT_TRUE(ray);
        EXPECT_LT(Norm(*ray - Vec3d{f * mx, f * my, f - 1.27}), 1e-12);
      }
    }
  }
}

TEST(CalibratedLens, WithoutDistortionItIsThePinholeOrTheFisheyeItself) {
  const Camera pinhole = Pinhole{640, 480, 500, 510, 320, 240};
  EXPECT_EQ(MakeCamera("FULL_OPENCV", 640, 480, Numbers{500, 510, 320, 240, 0, 0, 0, 0, 0, 0, 0, 0}), pinhole);
  EXPECT_EQ(MakeCamera("SIMPLE_PINHOLE", 640, 480, Numbers{500, 320, 240}), Camera(Pinhole{640, 480, 500, 500, 320, 240}));
  const Camera fisheye = Fisheye{640, 480, 200, 210, 320, 240, {0.01, 0.002, 0, 0}, kPi};
  EXPECT_EQ(MakeCamera("OPENCV_FISHEYE", 640, 480, Numbers{200, 210, 320, 240, 0.01, 0.002, 0, 0}), fisheye);
  EXPECT_EQ(MakeCamera("THIN_PRISM_FISHEYE", 640, 480, Numbers{200, 210, 320, 240, 0.01, 0.002, 0, 0, 0, 0, 0, 0}), fisheye);
  // The general projection agrees with both.
  CalibratedLens lens{
      .law = LensLaw::kPerspective, .width = 640, .height = 480, .fx = 500, .fy = 510, .cx = 320, .cy = 240, .max_theta = 1.5};
  CalibratedLens round = lens;
  round.law = LensLaw::kEquidistant, round.fx = 200, round.fy = 210, round.max_theta = kPi, round.shape = {0.01, 0.002};
  for (int y = 0; y < 480; y += 7) {
    for (int x = 0; x < 640; x += 7) {
      const Vec2d pixel{x + 0.5, y + 0.5};
      EXPECT_LT(Norm(*PixelToRay(lens, pixel) - *PixelToRay(pinhole, pixel)), 1e-15);
      EXPECT_LT(Norm(*PixelToRay(round, pixel) - *PixelToRay(fisheye, pixel)), 1e-15);
    }
  }
}

TEST(CalibratedLens, ALensThatFoldsOverInsideThePictureIsRefusedUnlessItsFieldIsSaid) {
  // r (1 - r^2 / 2) grows to r = sqrt(2 / 3): 39.2315 degrees.
  const Numbers parameters{400, 400, 512, 384, -0.5, 0, 0, 0};
  try {
    MakeCamera("OPENCV", 1024, 768, parameters);
    FAIL() << "a lens that folds over is taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("folds over 39.2315 degrees"), std::string::npos) << error.what();
  }
  EXPECT_THROW(MakeCamera("OPENCV", 1024, 768, parameters, 79), InputError);
  const Camera camera = MakeCamera("OPENCV", 1024, 768, parameters, 78);
  EXPECT_TRUE(PixelToRay(camera, {512, 384}));
  EXPECT_FALSE(PixelToRay(camera, {1.5, 1.5}));
  EXPECT_FALSE(RayToPixel(camera, {std::sin(0.69), 0, std::cos(0.69)}));
  EXPECT_TRUE(RayToPixel(camera, {std::sin(0.67), 0, std::cos(0.67)}));
  // In a picture that ends before, nothing is wrong with it.
  EXPECT_TRUE(std::holds_alternative<CalibratedLens>(MakeCamera("OPENCV", 256, 192, Numbers{400, 400, 128, 96, -0.5, 0, 0, 0})));
  // r / (1 + r^2) folds over at 45 degrees.
  EXPECT_THROW(MakeCamera("FULL_OPENCV", 1024, 768, Numbers{400, 400, 512, 384, 0, 0, 0, 0, 0, 1, 0, 0}), InputError);
}

TEST(CalibratedLens, WrongNumbersAreRefusedByName) {
  const auto says = [](const char* model, const Numbers& parameters, const char* text) {
    try {
      MakeCamera(model, 640, 480, parameters);
      FAIL() << model << " is taken";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  says("OPENCV", {500, 500, 320, 240, 0, 0, 0}, "8 parameters (fx fy cx cy k1 k2 p1 p2), not 7");
  says("OPENCVV", {}, "did you mean 'OPENCV'");
  says("OPENCV", {-500, 500, 320, 240, 0, 0, 0, 0}, "fx -500 is not in 0.64 … 640000");
  says("OPENCV", {500, 0, 320, 240, 0, 0, 0, 0}, "fy 0 is not in");
  says("OPENCV", {500, 1e308, 320, 240, 0, 0, 0, 0}, "fy 1e+308 is not in");
  says("SIMPLE_PINHOLE", {1e-300, 320, 240}, "f 1e-300 is not in");
  says("F_THETA", {1, 1, 320, 240, 1e8, 0, 0, 0, 0, 0}, "fx 1 is not in");
  says("OPENCV", {500, 500, 1e7, 240, 0, 0, 0, 0}, "cx 10000000 is not in -6400 … 7040");
  says("OPENCV", {500, 500, 320, -4801, 0, 0, 0, 0}, "cy -4801 is not in -4800 … 5280");
  says("OPENCV", {500, 500, 320, 240, NAN, 0, 0, 0}, "k1 must be finite");
  says("DOUBLE_SPHERE", {158, 159, 255, 257, 0, 1.2}, "alpha 1.2");
  says("FOV", {250, 250, 320, 240, 1e-4}, "omega 0.0001");
}

TEST(CalibratedLens, TheParameterToBlameIsSaid) {
  const auto blamed = [](const char* model, const Numbers& parameters) {
    try {
      MakeCamera(model, 1024, 768, parameters);
    } catch (const LensError& error) {
      return static_cast<int>(error.parameter);
    }
    return -1;
  };
  EXPECT_EQ(blamed("OPENCV", {400, -1, 512, 384, 0, 0, 0, 0}), 1);
  EXPECT_EQ(blamed("OPENCV", {400, 400, 512, 384, 0, -0.5, 0, 0}), 5);
  EXPECT_EQ(blamed("DOUBLE_SPHERE", {400, 400, 512, 384, 0.1, 1.5}), 4);
  EXPECT_EQ(blamed("OMNI", {400, 400, 512, 384, 1, -0.9, 0, 0, 0}), 5);
}

TEST(CalibratedLens, ALensThatNoPixelSeesThroughIsRefused) {
  // An axis 20 focal lengths beside the picture: a fisheye of 360 degrees ends after pi of them.
  const Numbers parameters{50, 50, 1640, 240, 0, 0, 0, 0};
  try {
    MakeCamera("OPENCV_FISHEYE", 640, 480, parameters);
    FAIL() << "a black picture is taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no pixel has a ray"), std::string::npos) << error.what();
  }
  // A pinhole sees there.
  EXPECT_TRUE(PixelToRay(MakeCamera("PINHOLE", 640, 480, Numbers{50, 50, 1640, 240}), {320, 240}));
  EXPECT_TRUE(PixelToRay(MakeCamera("OPENCV_FISHEYE", 640, 480, Numbers{500, 500, 1640, 240, 0, 0, 0, 0}), {600, 240}));
}

TEST(CalibratedLens, TheLongestLensesHaveARayForEveryPixel) {
  const double f = 999 * 640;
  const Camera camera = MakeCamera("OPENCV", 640, 480, Numbers{f, f, -3000, 240, 0.3, 0.1, 0.001, -0.002});
  for (int y = 0; y < 480; y += 13) {
    for (int x = 0; x < 640; x += 13) {
      const auto ray = PixelToRay(camera, {x + 0.5, y + 0.5});
      ASSERT_TRUE(ray);
      const Vec2d m = RadTan({0.3, 0.1, 0.001, -0.002}, ray->x / ray->z, ray->y / ray->z);
      EXPECT_LT(std::hypot(m.x * f - 3000 - x - 0.5, m.y * f + 240 - y - 0.5), 1e-8);
    }
  }
}

TEST(CalibratedLens, FovWithoutOmegaIsThePinhole) {
  EXPECT_EQ(MakeCamera("FOV", 640, 480, Numbers{500, 510, 320, 240, 0}), Camera(Pinhole{640, 480, 500, 510, 320, 240}));
}

TEST(CalibratedLens, ALensThatFoldsOnOneSideSaysSo) {
  // u - 0.2 u^2 folds over at u = 2.5 to the right alone; the picture is to the left of it.
  try {
    MakeCamera("OPENCV_THIN_PRISM", 160, 20, Numbers{30, 30, 150, 10, 0, 0, 0, 0, 0, 0, 0, 0, -0.2, 0, 0, 0});
    FAIL() << "taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("folds over 68.1986 degrees from its axis on a side that is outside of the picture"),
              std::string::npos)
        << error.what();
  }
}

TEST(CalibratedLens, SolidAnglesSumToThoseOfTheWholeField) {
  // A double sphere and a fisheye with prism terms, of 150 degrees: the cap is 2 pi (1 - cos 75 degrees).
  const double cap = 2 * kPi * (1 - std::cos(75 * kPi / 180));
  const Camera a = MakeCamera("DOUBLE_SPHERE", 240, 240, Numbers{63, 64, 122, 121, -0.18, 0.59}, 150);
  const Camera b =
      MakeCamera("THIN_PRISM_FISHEYE", 240, 240, Numbers{80, 81, 121, 119, 0.02, -0.004, 0.0012, -0.0008, 0, 0, 0.001, -0.001}, 150);
  for (const Camera& camera : {a, b}) {
    double sum = 0;
    for (int y = 0; y < 240; ++y) {
      for (int x = 0; x < 240; ++x) sum += SolidAngle(camera, x, y);
    }
    EXPECT_NEAR(sum / cap, 1, 3e-4);
  }
  // A distorted pinhole: the pixel in the middle is 1 / (fx fy).
  const Camera c = MakeCamera("OPENCV", 641, 481, Numbers{500, 510, 320.5, 240.5, 0.1, 0, 0, 0});
  EXPECT_NEAR(SolidAngle(c, 320, 240) * 500 * 510, 1, 1e-5);
}

TEST(CalibratedLens, SolidAnglesOfRowsAreThoseOfTheirPixels) {
  const Camera cameras[] = {MakeCamera("DOUBLE_SPHERE", 60, 50, Numbers{16, 17, 30, 25, -0.18, 0.59}, 150),
                            MakeCamera("OPENCV", 64, 48, Numbers{50, 51, 32, 24, 0.1, 0, 0.001, 0}), Fisheye::Equidistant(40, 40, 3)};
  for (const Camera& camera : cameras) {
    const auto width = static_cast<size_t>(Width(camera));
    for (const auto& [first, last] : {std::pair{0, Height(camera)}, std::pair{7, 9}}) {
      std::vector<double> rows(width * static_cast<size_t>(last - first));
      internal::SolidAnglesOfRows(camera, first, last, rows);
      for (size_t k = 0; k < rows.size(); ++k)
        ASSERT_EQ(rows[k], SolidAngle(camera, static_cast<int>(k % width), first + static_cast<int>(k / width))) << k;
    }
  }
}

TEST(CalibratedLens, ItsNameAndParametersMakeItAgain) {
  for (const Lens& lens : Lenses()) {
    SCOPED_TRACE(lens.model);
    const Camera camera = MakeCamera(lens.model, lens.width, lens.height, lens.parameters, 80);
    const auto model = ModelOf(camera);
    ASSERT_TRUE(model);
    if (!std::string(lens.model).starts_with("SIMPLE")) {
      EXPECT_EQ(model->name, lens.model);
      EXPECT_EQ(model->parameters, lens.parameters);
    }
    const auto* made = std::get_if<CalibratedLens>(&camera);
    const double max_theta = made != nullptr ? made->max_theta : std::get<Fisheye>(camera).max_theta;
    EXPECT_EQ(RestoreCamera(model->name, lens.width, lens.height, model->parameters, max_theta), camera);
  }
}

TEST(CalibratedLens, HalfThePixelsSeeTheSameRays) {
  const Camera whole =
      MakeCamera("OPENCV", 752, 480, Numbers{458.654, 457.296, 367.715, 248.875, -0.28340811, 0.07395907, 0.00019359, 1.76187114e-05});
  const Camera half = Resized(whole, 376, 240);
  EXPECT_LT(Norm(*PixelToRay(whole, {100, 60}) - *PixelToRay(half, {50, 30})), 1e-14);
  EXPECT_THROW(Resized(whole, 376, 300), InputError);
}

TEST(CalibratedLens, AnOddSizeScalesEachSideByItself) {
  const Numbers p{1000, 1010, 970, 540, -0.1, 0.02, 0.001, -0.002};
  const Camera whole = MakeCamera("OPENCV", 1957, 1091, p);
  const double across = 489 / 1957.0, down = 273 / 1091.0;
  const Camera odd = Resized(whole, 489, 273);
  EXPECT_LT(Norm(*PixelToRay(whole, {100 / across, 60 / down}) - *PixelToRay(odd, {100, 60})), 1e-13);
  EXPECT_LT(Norm(*PixelToRay(whole, {1957, 1091}) - *PixelToRay(odd, {489, 273})), 1e-13);
  // Rounded down, to the nearest and up; not by more.
  for (const int height : {272, 273}) EXPECT_NO_THROW(Resized(whole, 489, height));
  for (const int height : {271, 274}) EXPECT_THROW(Resized(whole, 489, height), InputError);
}

}  // namespace
}  // namespace airsim360

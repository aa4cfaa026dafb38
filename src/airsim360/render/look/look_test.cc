#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/image/color.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/look/metering.h"
#include "airsim360/render/look/photo.h"
#include "airsim360/render/look/test_point_spread.h"
#include "airsim360/render/sky/atmosphere.h"

namespace airsim360 {
namespace {

using namespace internal;

constexpr int kWidth = 512, kHeight = 256;

PhotoRequest Request(int width = kWidth) {
  PhotoRequest request;
  request.camera = Equirectangular{width, width / 2};
  return request;
}

// Something with a bright sky, a dark ground and texture.
Image<Rgb32f> Scenery(int width = kWidth) {
  Image<Rgb32f> light(width, width / 2);
  for (int y = 0; y < light.height(); ++y) {
    for (int x = 0; x < width; ++x) {
      RngStream random(7, "scenery", static_cast<uint64_t>(y / 5 * width + x / 5));
      const double up = y < light.height() / 2 ? 3 : 0.4;
      const double base = up * std::exp(random.Normal());
      light(x, y) = {static_cast<float>(base * 0.8), static_cast<float>(base * 0.9), static_cast<float>(base)};
    }
  }
  return light;
}

Daylight Noon() {
  Daylight day;
  day.to_sun = {static_cast<float>(std::cos(0.7)), 0, static_cast<float>(std::sin(0.7))};
  day.sun = {16, 14, 11};
  day.sky = {1.8f, 2.2f, 3};
  day.sun_seen = 1;
  return day;
}

// A camera in W as the rig holds it, level, with a heading in columns to the right.
Mat3d Heading(double columns, int width) {
  const Mat3d R = Mat3d::FromColumns({0, -1, 0}, {0, 0, -1}, {1, 0, 0});
  return R * RotationY(columns * 2 * kPi / width);
}

TEST(PhotoTest, NeutralSettingsGiveTheSrgbOfTheLight) {
  Image<Rgb32f> light(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) light(x, y) = {x / 600.0f, y / 200.0f, 0.18f};
  Image<Rgb8> rgb;
  TakePhoto(CameraLook::Neutral(), Request(), light, rgb);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      ASSERT_NEAR(rgb(x, y).r, LinearToSrgb8(light(x, y).r), 1);
      ASSERT_NEAR(rgb(x, y).g, LinearToSrgb8(std::min(1.0f, light(x, y).g)), 1);
    }
  }
}

struct Lab {
  double l, a, b;
};
// Of linear sRGB, CIE 1931, D65.
Lab ToLab(double r, double g, double b) {
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047), y = f(0.2126729 * r + 0.7151522 * g + 0.0721750 * b),
               z = f((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

TEST(PhotoTest, AColorChartComesOutWithinDeltaE3AtNeutralSettings) {
  // The usual 24 patches of a chart as 8-bit sRGB (rounded, D65), of which the last six are greys; CIE 1976 difference.
  constexpr int kPatches[24][3] = {{115, 82, 68},   {194, 150, 130}, {98, 122, 157},  {87, 108, 67},   {133, 128, 177}, {103, 189, 170},
                                   {214, 126, 44},  {80, 91, 166},   {193, 90, 99},   {94, 60, 108},   {157, 188, 64},  {224, 163, 46},
                                   {56, 61, 150},   {70, 148, 73},   {175, 54, 60},   {231, 199, 31},  {187, 86, 149},  {8, 133, 161},
                                   {243, 243, 242}, {200, 200, 200}, {160, 160, 160}, {122, 122, 121}, {85, 85, 85},    {52, 52, 52}};
  PhotoRequest request = Request();
  request.camera = Pinhole{240, 160, 200, 200, 120, 80};
  request.exposure = 0.25f;  // of light four times as strong
  Image<Rgb32f> light(240, 160);
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 240; ++x) {
      const int* c = kPatches[y / 40 * 6 + x / 40];
      light(x, y) = {4 * SrgbToLinear(static_cast<uint8_t>(c[0])), 4 * SrgbToLinear(static_cast<uint8_t>(c[1])),
                     4 * SrgbToLinear(static_cast<uint8_t>(c[2]))};
    }
  }
  // Also with what a camera cannot leave away: noise, softness, sharpening.
  CameraLook real = CameraLook::Neutral();
  real.full_well = 15000, real.read_noise = 5, real.softness_px = 0.6, real.sharpening = 0.45;
  for (const CameraLook& look : {CameraLook::Neutral(), real}) {
    Image<Rgb8> rgb;
    TakePhoto(look, request, light, rgb);
    for (int i = 0; i < 24; ++i) {
      double mean[3] = {};
      for (int y = 10; y < 30; ++y) {
        for (int x = 10; x < 30; ++x) {
          const Rgb8 c = rgb(i % 6 * 40 + x, i / 6 * 40 + y);
          mean[0] += SrgbToLinear(c.r) / 400, mean[1] += SrgbToLinear(c.g) / 400, mean[2] += SrgbToLinear(c.b) / 400;
        }
      }
      const Lab seen = ToLab(mean[0], mean[1], mean[2]);
      const Lab chart = ToLab(SrgbToLinear(static_cast<uint8_t>(kPatches[i][0])), SrgbToLinear(static_cast<uint8_t>(kPatches[i][1])),
                              SrgbToLinear(static_cast<uint8_t>(kPatches[i][2])));
      EXPECT_LT(std::hypot(seen.l - chart.l, seen.a - chart.a, seen.b - chart.b), 3) << i;
    }
  }
}

TEST(PhotoTest, NoiseHasTheVarianceOfItsLaw) {
  CameraLook look = CameraLook::Neutral();
  look.full_well = 400;
  look.read_noise = 6;
  for (const double softness : {0.0, 0.6}) {
    look.softness_px = softness;
    for (const float signal : {0.12f, 0.25f, 0.5f}) {
      for (const double gain : {1.0, 1.7}) {
        PhotoRequest request = Request();
        Image<Rgb32f> light(kWidth, kHeight, {signal, signal, signal});
        // Without gain at the luminance that is white here.
        look.base_white = 1e9;
        Image<Rgb8> rgb;
        const double white = TakePhoto(CameraLook::Neutral(), request, light, rgb).white_cd_m2;
        look.base_white = white * gain;
        const PhotoFigures figures = TakePhoto(look, request, light, rgb);
        EXPECT_NEAR(figures.gain, gain, 1e-9);
        double sum = 0, squares = 0, count = 0;
        for (int y = 30; y < 226; ++y) {
          for (int x = 0; x < kWidth; ++x) {
            const double value = SrgbToLinear(rgb(x, y).g);
            sum += value, squares += value * value, ++count;
          }
        }
        const double mean = sum / count, variance = squares / count - mean * mean;
        EXPECT_NEAR(mean, signal, 0.004);
        EXPECT_NEAR(variance / NoiseVariance(look, gain, signal), 1, 0.02) << softness << ' ' << signal << ' ' << gain;
      }
    }
  }
}

TEST(PhotoTest, MeteringHitsItsAim) {
  for (const double brightness : {0.2, 1.0, 40.0}) {
    for (const double aim : {0.4, 0.55}) {
      CameraLook look;
      look.metering = aim, look.metering_spread = 0, look.dimmest_white = 1e-4;
      Image<Rgb32f> light = Scenery();
      for (Rgb32f& c : light.pixels())
        c = {c.r * static_cast<float>(brightness), c.g * static_cast<float>(brightness), c.b * static_cast<float>(brightness)};
      Image<Rgb8> rgb;
      TakePhoto(look, Request(), light, rgb);
      double sum = 0, whole = 0;
      for (int y = 0; y < kHeight; ++y) {
        const double weight = std::cos(kPi * (0.5 - (y + 0.5) / kHeight));
        for (int x = 0; x < kWidth; ++x) {
          const Rgb8 c = rgb(x, y);
          sum += weight * (0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b) / 255, whole += weight;
        }
      }
      EXPECT_NEAR(sum / whole, aim, 0.015) << brightness;
    }
  }
}

// A tenth of the sphere shines as windows do, the rest is as dark as the night: a twenty-fifth may burn out. By day all of it does.
TEST(PhotoTest, ADarkSkyDoesNotBurnOutWhatShines) {
  const auto burnt = [](double dark_cd_m2) {
    Image<Rgb32f> light(kWidth, kHeight);
    double clipped = 0, whole = 0;
    const auto unit = static_cast<float>(dark_cd_m2 / kLuxPerUnit);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const float value = unit * (10 * x < kWidth ? 200.0f * (1.0f + 40.0f * static_cast<float>(x) / kWidth) : 1.0f);
        light(x, y) = {value, value, value};
      }
    CameraLook look;
    look.white_error = look.full_well = look.metering_spread = look.contrast_spread = look.softness_px = look.sharpening = look.glare = 0;
    Image<Rgb8> rgb;
    TakePhoto(look, Request(), light, rgb);
    for (int y = 0; y < kHeight; ++y) {
      const double weight = std::cos(kPi * (0.5 - (y + 0.5) / kHeight));
      for (int x = 0; x < kWidth; ++x) clipped += weight * (rgb(x, y).g >= 254), whole += weight;
    }
    return clipped / whole;
  };
  EXPECT_GT(burnt(400), 0.09);
  EXPECT_LT(burnt(0.05), 0.055);
}

TEST(PhotoTest, LampsOfARoomAreNotTakenForTheDuskOutside) {
  // As bright as what dusk makes of grey ground: by its own light, then by warm lamps.
  Daylight dusk;
  dusk.to_sun = {0.9f, 0, -0.07f};
  dusk.sky = {0.5f, 0.8f, 1.6f};
  const auto gains = [&](Rgb32f light) {
    LightCells cells(true, 64, 32, 2 * kPi / 64, kPi / 32);
    std::fill(cells.planes[0].begin(), cells.planes[0].end(), light.r);
    std::fill(cells.planes[1].begin(), cells.planes[1].end(), light.g);
    std::fill(cells.planes[2].begin(), cells.planes[2].end(), light.b);
    return WhiteBalance(0.85, dusk, LightHistogram(cells, 1, LightCells(), 0));
  };
  const auto grey = static_cast<float>(0.18 / kPi);
  const std::array<double, 3> outside = gains({dusk.sky.r * grey, dusk.sky.g * grey, dusk.sky.b * grey});
  EXPECT_GT(outside[0], 1.1 * outside[2]);
  const std::array<double, 3> inside = gains({2.5f * dusk.sky.g * grey, dusk.sky.g * grey, 0.3f * dusk.sky.g * grey});
  EXPECT_GT(inside[2], 2 * inside[0]);
}

TEST(PhotoTest, ShadeIsBalancedForTheSkyAndASunlitPictureForBoth) {
  const Daylight noon = Noon();
  const double height = noon.to_sun.z;
  const Rgb32f both{static_cast<float>(noon.sun.r * height + noon.sky.r), static_cast<float>(noon.sun.g * height + noon.sky.g),
                    static_cast<float>(noon.sun.b * height + noon.sky.b)};
  // Grey of 0.2, its part `shade` lit by the sky alone and the rest by both; what of the shade's blue is left, in octaves.
  const auto blue_left = [&](double shade) {
    constexpr int kSide = 64;
    LightCells cells(true, kSide, kSide / 2, 2 * kPi / kSide, 2 * kPi / kSide);
    for (int y = 0; y < cells.height; ++y) {
      for (int x = 0; x < cells.width; ++x) {
        const Rgb32f& light = x < shade * kSide ? noon.sky : both;
        const size_t i = cells.Index(x, y);
        cells.planes[0][i] = static_cast<float>(0.2 / kPi * light.r);
        cells.planes[1][i] = static_cast<float>(0.2 / kPi * light.g);
        cells.planes[2][i] = static_cast<float>(0.2 / kPi * light.b);
      }
    }
    const std::array<double, 3> gains = WhiteBalance(0.85, noon, LightHistogram(cells, 1, LightCells(), 0));
    return std::log2(noon.sky.b / noon.sky.r * gains[2] / gains[0]);
  };
  const double of_sky = std::log2(noon.sky.b / noon.sky.r);
  EXPECT_LT(blue_left(1), 0.35 * of_sky);
  EXPECT_GT(blue_left(1), 0);
  EXPECT_GT(blue_left(0.2), 0.9 * of_sky);  // beside the sun shade stays blue
  for (double shade = 0.1; shade < 1; shade += 0.1) EXPECT_LE(blue_left(shade + 0.1), blue_left(shade) + 0.01) << shade;
}

TEST(PhotoTest, StopsComeOnTopOfTheMeter) {
  PhotoRequest request = Request();
  Image<Rgb32f> light = Scenery();
  Image<Rgb8> rgb;
  const double metered = TakePhoto(CameraLook(), request, light, rgb).exposure_ev;
  request.exposure_ev = -1.5;
  EXPECT_NEAR(TakePhoto(CameraLook(), request, light, rgb).exposure_ev, metered - 1.5, 1e-6);
  EXPECT_NEAR(TakePhoto(CameraLook::Neutral(), request, light, rgb).exposure_ev, -1.5, 1e-6);
}

TEST(PhotoTest, TheGlareOfTheSunIsItsIrradianceTimesThePointSpread) {
  CameraLook look = CameraLook::Neutral();
  look.glare = 0.05;
  PhotoRequest request = Request(2048);
  request.R_WC = Heading(300.25, 2048);
  request.daylight = Noon();
  request.daylight.sun_seen = 0.5f;
  Image<Rgb32f> light(2048, 1024);
  Image<Rgb8> rgb;
  for (const double theta_deg : {2.0, 4.0, 10.0, 30.0}) {
    const double expected = 0.05 * 0.5 * 14 * PointSpread(look.glare_deg, theta_deg * kDegree);
    request.exposure = static_cast<float>(0.75 / expected);
    TakePhoto(look, request, light, rgb);
    double sum = 0, count = 0;
    const Vec3d sun = VecCast<double>(request.daylight.to_sun);
    for (int y = 0; y < 1024; ++y) {
      for (int x = 0; x < 2048; ++x) {
        const Vec3d d = request.R_WC * *PixelToRay(request.camera, {x + 0.5, y + 0.5});
        if (std::abs(std::acos(std::clamp(Dot(d, sun), -1.0, 1.0)) / kDegree - theta_deg) > 0.05) continue;
        sum += SrgbToLinear(rgb(x, y).g), ++count;
      }
    }
    EXPECT_NEAR(sum / count / 0.75, 1, 0.02) << theta_deg;
  }
}

TEST(PhotoTest, ACameraTurnedByColumnsRollsThePicture) {
  const CameraLook look;
  const Image<Rgb32f> scenery = Scenery();
  PhotoRequest request = Request();
  request.daylight = Noon();
  request.exposure = 0.2f;
  request.R_WC = Heading(11.3, kWidth);
  Image<Rgb8> straight, turned;
  Image<Rgb32f> light = scenery;
  TakePhoto(look, request, light, straight);
  for (const int k : {1, 7, 200, 511}) {
    request.R_WC = Heading(11.3 + k, kWidth);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) light(x, y) = scenery((x + k) % kWidth, y);
    TakePhoto(look, request, light, turned);
    int off = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) off += turned(x, y) == straight((x + k) % kWidth, y) ? 0 : 1;
    EXPECT_EQ(off, 0) << k;
  }
}

TEST(PhotoTest, TheNumberOfThreadsDoesNotMatter) {
  PhotoRequest request = Request();
  request.daylight = Noon();
  request.R_WC = Heading(0, kWidth);
  Image<Rgb32f> light = Scenery();
  Image<Rgb8> one, many;
  {
    const ThreadLimit limit(1);
    TakePhoto(CameraLook(), request, light, one);
  }
  const ThreadLimit limit(4);
  TakePhoto(CameraLook(), request, light, many);
  EXPECT_TRUE(one == many);
}

TEST(PhotoTest, NeitherSizeNorProjectionMatters) {
  for (const Camera& camera :
       std::vector<Camera>{Equirectangular{2, 1}, Equirectangular{36, 18}, Equirectangular{100, 50}, Pinhole{1, 1, 1, 1, 0.5, 0.5},
                           Pinhole{33, 7, 20, 20, 16, 3}, Pinhole{3, 600, 20, 20, 1, 300}, CubeFace{CubeFaceName::kPosX, 64},
                           Fisheye::Equidistant(50, 50, 3)}) {
    PhotoRequest request;
    request.camera = camera;
    request.daylight = Noon();
    Image<Rgb32f> light(Width(camera), Height(camera), {1, 1, 1});
    Image<Rgb8> rgb;
    CameraLook look;
    look.metering_spread = look.white_error = look.full_well = 0;
    TakePhoto(look, request, light, rgb);
    ASSERT_EQ(rgb.width(), Width(camera));
    // Even light stays even, at the aim of the meter.
    const Rgb8 c = rgb(Width(camera) / 2, Height(camera) / 2);
    EXPECT_GT(c.g, 90);
    EXPECT_LT(c.g, 190);
    if (std::holds_alternative<Fisheye>(camera)) {
      EXPECT_EQ(rgb(0, 0), Rgb8{});
    }
  }
}

TEST(PhotoTest, EverySeedIsAnotherCameraAndFramesShareOne) {
  CameraLook look;
  EXPECT_NE(DrawLook(look, 1, 0).red, DrawLook(look, 2, 0).red);
  EXPECT_EQ(DrawLook(look, 1, 0).red, DrawLook(look, 1, 5).red);
  look.each_frame = true;
  EXPECT_NE(DrawLook(look, 1, 0).red, DrawLook(look, 1, 5).red);
  const DrawnLook off = DrawLook(CameraLook::Neutral(), 3, 0);
  EXPECT_EQ(off.metering, 0);
  EXPECT_EQ(off.red, 1);
  EXPECT_EQ(off.contrast, 0);
}

TEST(PhotoTest, NonsenseIsRefused) {
  CameraLook look;
  look.glare = 0.9;
  EXPECT_THROW(CheckCameraLook(look), InputError);
  look = {};
  look.softness_px = NAN;
  EXPECT_THROW(CheckCameraLook(look), InputError);
  EXPECT_THROW(ParseLook("foto"), InputError);
}

TEST(PhotoTest, ToneKeepsMiddleGreyAndClipsAtItsShoulder) {
  for (const double shoulder : {0.0, 1.0, 2.7, 5.0}) {
    EXPECT_NEAR(EncodeTone(shoulder, 0, 0.18), 0.4614, 1e-3);
    EXPECT_NEAR(EncodeTone(shoulder, 0, ClipOfShoulder(shoulder)), 1, 1e-9);
    EXPECT_LT(EncodeTone(shoulder, 0.7, ClipOfShoulder(shoulder) * 0.98), 1);
  }
  EXPECT_EQ(ClipOfShoulder(0), 1);
}

}  // namespace
}  // namespace airsim360

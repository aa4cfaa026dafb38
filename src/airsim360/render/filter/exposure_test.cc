#include "airsim360/render/filter/exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "airsim360/base/random.h"

namespace airsim360::internal {
namespace {

const Camera kPanorama = Equirectangular{256, 128};
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

TEST(AutoExposureTest, BringsAUniformPictureToMiddleGrey) {
  for (const float light : {0.01f, 1.0f, 20.0f}) {
    const Image<Rgb32f> picture(256, 128, {light, light, light});
    const double ev = AutoExposureEv(picture, kPanorama, 0.5f, kNoLimit);
    // Within half a step of the histogram.
    EXPECT_NEAR(std::log2(light * 0.5 * std::exp2(ev) / kAutoGrey), 0, 1.0 / 16 + 1e-6) << light;
  }
}

TEST(AutoExposureTest, TwiceTheLightTakesOneStop) {
  Image<Rgb32f> picture(256, 128);
  RngStream rng(1, "exposure");
  for (Rgb32f& c : picture.pixels()) {
    const auto v = static_cast<float>(std::exp(rng.Uniform(-4, 2)));
    c = {v, v * 0.8f, v * 0.6f};
  }
  const double ev = AutoExposureEv(picture, kPanorama, 1, kNoLimit);
  for (Rgb32f& c : picture.pixels()) c = {2 * c.r, 2 * c.g, 2 * c.b};
  EXPECT_NEAR(AutoExposureEv(picture, kPanorama, 1, kNoLimit), ev - 1, 1e-4);
  EXPECT_NEAR(AutoExposureEv(picture, kPanorama, 2, kNoLimit), ev - 2, 1e-4);
}

TEST(AutoExposureTest, GoesNoFurtherThanItsLimit) {
  const Image<Rgb32f> picture(256, 128, {0.01f, 0.01f, 0.01f});
  const double free = AutoExposureEv(picture, kPanorama, 0.5f, kNoLimit);
  EXPECT_EQ(AutoExposureEv(picture, kPanorama, 0.5f, 2), 2);
  EXPECT_EQ(AutoExposureEv(picture, kPanorama, 0.5f, 1000), free);
}

TEST(AutoExposureTest, RowsCountByTheirSolidAngle) {
  // Everything within `edge` of the poles is black, the rest is light: the black share of the sphere is
  // 1 - cos(edge), trimmed away below a tenth although it has more of the pixels.
  const auto exposure_of = [](double edge) {
    Image<Rgb32f> picture(256, 128, {1, 1, 1});
    const int rows = static_cast<int>(edge / std::numbers::pi * 128);
    for (int y = 0; y < rows; ++y) {
      for (Rgb32f& c : picture.row(y)) c = {};
      for (Rgb32f& c : picture.row(127 - y)) c = {};
    }
    return AutoExposureEv(picture, kPanorama, 1, kNoLimit);
  };
  const double even = exposure_of(0);
  EXPECT_EQ(exposure_of(std::acos(1 - 0.09)), even);
  EXPECT_GT(exposure_of(std::acos(1 - 0.14)), even + 0.1);
}

TEST(AutoExposureTest, TheSunDiscDoesNotCount) {
  Image<Rgb32f> picture(256, 128, {0.3f, 0.3f, 0.3f});
  const double without = AutoExposureEv(picture, kPanorama, 1, kNoLimit);
  picture(128, 40) = {1e5f, 1e5f, 1e5f};
  EXPECT_NEAR(AutoExposureEv(picture, kPanorama, 1, kNoLimit), without, 1e-9);
}

TEST(AutoExposureTest, RollingThePanoramaChangesNothing) {
  Image<Rgb32f> picture(256, 128), rolled = picture;
  RngStream rng(2, "exposure");
  for (Rgb32f& c : picture.pixels()) c.g = static_cast<float>(rng.Uniform(0, 3));
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 256; ++x) rolled(x, y) = picture((x + 91) % 256, y);
  }
  EXPECT_EQ(AutoExposureEv(picture, kPanorama, 1, kNoLimit), AutoExposureEv(rolled, kPanorama, 1, kNoLimit));
}

TEST(AutoExposureTest, DarknessStaysDark) { EXPECT_EQ(AutoExposureEv(Image<Rgb32f>(256, 128), kPanorama, 1, kNoLimit), 0); }

}  // namespace
}  // namespace airsim360::internal

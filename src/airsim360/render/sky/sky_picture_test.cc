#include "airsim360/render/sky/sky_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "airsim360/math/angles.h"
#include "airsim360/render/sky/sky.h"

namespace airsim360::internal {
namespace {

double PictureLuminance(Vec3f c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

// An even sky of radiance 0.5 over ground of 0.1, with a disc of `light` about a compass direction.
Environment PictureWith(double azimuth_deg, double elevation_deg, double radius_deg, float light) {
  auto picture = std::make_shared<SkyPicture>();
  picture->name = "test";
  picture->pixels = Image<Rgb32f>(1024, 512, {0.5f, 0.5f, 0.5f});
  const double a = azimuth_deg * kPi / 180, e = elevation_deg * kPi / 180;
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 1024; ++x) {
      const double theta = 2 * kPi * ((x + 0.5) / 1024 - 0.5), phi = kPi * (0.5 - (y + 0.5) / 512);
      const double mu = std::sin(phi) * std::sin(e) + std::cos(phi) * std::cos(e) * std::cos(theta - a);
      if (y >= 256) picture->pixels(x, y) = {0.1f, 0.1f, 0.1f};
      if (std::acos(std::min(mu, 1.0)) < radius_deg * kPi / 180) picture->pixels(x, y) = {light, light, light};
    }
  }
  Environment environment;
  environment.hdri = picture;
  return environment;
}

double LightOf(const SkyTable& table) {
  double sum = 0;
  for (int y = 0; y < table.height; ++y)
    for (int x = 0; x < table.width; ++x) sum += PictureLuminance(table.Texel(x, y)) * RowSolidAngle(table, y);
  return sum;
}

TEST(SkyPicture, TheSunIsTakenOutAndNoLightIsLost) {
  const Environment environment = PictureWith(60, 40, 0.8, 20000);
  const SplitPicture split = SplitSkyPicture(environment);
  // Compass 60 degrees is 30 degrees north of east.
  const Vec3f expected = DirectionOf(static_cast<float>(30 * kPi / 180), static_cast<float>(40 * kPi / 180));
  EXPECT_GT(Dot(split.sun.direction, expected), std::cos(0.1 * kPi / 180));
  double in_picture = 0;
  for (int y = 0; y < 256; ++y) {
    const double weight = (std::sin(kPi / 2 - y * kPi / 512) - std::sin(kPi / 2 - (y + 1) * kPi / 512)) * 2 * kPi / 1024;
    for (int x = 0; x < 1024; ++x) in_picture += environment.hdri->pixels(x, y).g * weight;
  }
  EXPECT_NEAR((LightOf(split.above) + PictureLuminance(split.sun.irradiance)) / in_picture, 1, 0.005);
  EXPECT_NEAR(LightOf(split.above), 0.5 * 2 * kPi, 0.02);
}

TEST(SkyPicture, NoDiscShowsWhereTheSunWas) {
  // A sun in its aureole, rimmed with the dark pixels of a sharpened photograph.
  Environment environment = PictureWith(60, 40, 0.8, 20000);
  auto picture = std::make_shared<SkyPicture>(*environment.hdri);
  environment.hdri = picture;
  const Vec3f sun = DirectionOf(static_cast<float>(30 * kPi / 180), static_cast<float>(40 * kPi / 180));
  const auto degrees_off = [&](float azimuth, float elevation) {
    return std::acos(std::min(1.0f, Dot(DirectionOf(azimuth, elevation), sun))) * static_cast<float>(180 / kPi);
  };
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 1024; ++x) {
      const double theta = 2 * kPi * ((x + 0.5) / 1024 - 0.5), phi = kPi * (0.5 - (y + 0.5) / 512);
      const float off = degrees_off(static_cast<float>(kPi / 2 - theta), static_cast<float>(phi));
      Rgb32f& p = picture->pixels(x, y);
      if (off > 0.8f) p.r = p.g = p.b = off < 1 ? 0.01f : 0.5f + 3 * std::exp(-off / 4);
    }
  }
  const SplitPicture split = SplitSkyPicture(environment);
  ASSERT_GT(PictureLuminance(split.sun.irradiance), 0);
  double outside = 0, count = 0, darkest = 1e9, brightest = 0;
  for (int y = 0; y < split.above.height; ++y) {
    for (int x = 0; x < split.above.width; ++x) {
      const float off = degrees_off((static_cast<float>(x) + 0.5f) * static_cast<float>(2 * kPi) / static_cast<float>(split.above.width),
                                    split.above.ElevationOfRow(y));
      const double light = PictureLuminance(split.above.Texel(x, y));
      if (off > 3 && off < 3.6f) outside += light, ++count;
      if (off < 2.8f) darkest = std::min(darkest, light), brightest = std::max(brightest, light);
    }
  }
  EXPECT_NEAR(darkest / (outside / count), 1, 0.03);
  EXPECT_NEAR(brightest / (outside / count), 1, 0.03);
}

TEST(SkyPicture, ALampOrAWideGlowIsNoSun) {
  EXPECT_EQ(PictureLuminance(SplitSkyPicture(PictureWith(0, 40, 0.8, 5)).sun.irradiance), 0);       // too weak
  EXPECT_EQ(PictureLuminance(SplitSkyPicture(PictureWith(0, 40, 25, 100)).sun.irradiance), 0);      // a window
  EXPECT_EQ(PictureLuminance(SplitSkyPicture(PictureWith(0, -20, 0.8, 20000)).sun.irradiance), 0);  // below
}

TEST(SkyPicture, YawTurnsClockwiseAndScaleMultiplies) {
  Environment environment = PictureWith(10, 40, 0.8, 20000);
  environment.hdri_yaw_deg = 80, environment.hdri_scale = 3;
  const SplitPicture split = SplitSkyPicture(environment);
  EXPECT_GT(split.sun.direction.x, std::cos(41 * kPi / 180));  // compass 90 = east
  EXPECT_NEAR(LightOf(split.above), 3 * 0.5 * 2 * kPi, 0.06);
}

TEST(SkyPicture, PixelsThatAreNoNumberAreBlack) {
  auto picture = std::make_shared<SkyPicture>();
  picture->pixels = Image<Rgb32f>(16, 8, {std::numeric_limits<float>::quiet_NaN(), -1, 0.5f});
  Environment environment;
  environment.hdri = picture;
  const SplitPicture split = SplitSkyPicture(environment);
  EXPECT_EQ(split.above.Texel(5, 5), (Vec3f{0, 0, 0.5f}));
}

TEST(SkyPicture, ASkyOfOneColourLightsEvenlyAndShowsItsGround) {
  const Sky sky(PictureWith(0, 40, 0, 0));
  const Vec3f up = sky.Irradiance({0, 0, 1});
  EXPECT_NEAR(up.y, 0.5 * kPi, 0.01);
  EXPECT_NEAR(sky.Radiance({0, 0.6f, -0.8f}).y, 0.1, 1e-3);
  EXPECT_NEAR(sky.Radiance({0, 0.6f, 0.8f}).y, 0.5, 1e-3);
  EXPECT_NEAR(sky.Pdf({0, 0.6f, 0.8f}) / sky.Pdf({0, 0.6f, -0.8f}), 5, 0.5);
}

}  // namespace
}  // namespace airsim360::internal

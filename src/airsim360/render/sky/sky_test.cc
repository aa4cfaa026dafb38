#include "airsim360/render/sky/sky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/sky/atmosphere.h"

namespace airsim360::internal {
namespace {

double Luminance(Vec3f c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

const Sky& DefaultSky() {
  static const Sky sky{Environment{}};
  return sky;
}

Vec3f Direction(double azimuth, double elevation) {
  return {static_cast<float>(std::cos(elevation) * std::cos(azimuth)), static_cast<float>(std::cos(elevation) * std::sin(azimuth)),
          static_cast<float>(std::sin(elevation))};
}

// Irradiance of the upper hemisphere by direct summation of look-ups.
Vec3d Integrate(const Sky& sky, Vec3f normal) {
  constexpr int kUp = 200, kAround = 400;
  Vec3d sum{};
  for (int i = 0; i < kUp; ++i) {
    for (int j = 0; j < kAround; ++j) {
      const Vec3f d = Direction((j + 0.5) / kAround * 2 * kPi, std::asin((i + 0.5) / kUp));
      sum += VecCast<double>(sky.Radiance(d)) * (std::max(0.0f, Dot(d, normal)) * 2 * kPi / (kUp * kAround));
    }
  }
  return sum;
}

TEST(Sky, ClearNoonIsAsBrightAsMeasured) {
  for (double elevation : {50.0, 60.0, 70.0}) {
    const double e = elevation * kPi / 180;
    const Atmosphere atmosphere(Direction(0, e), 2.3);
    double sky = 0;
    constexpr int kUp = 48, kAround = 96;
    for (int k = 0; k < kUp * kAround; ++k) {
      const double z = std::sqrt((k / kAround + 0.5) / kUp);
      sky += Luminance(atmosphere.Radiance(Direction((k % kAround + 0.5) / kAround * 2 * kPi, std::asin(z)))) * kPi / (kUp * kAround);
    }
    const double sun = Luminance(atmosphere.SunIrradiance()) * std::sin(e);
    const double klx = (sun + sky) * kLuxPerUnit / 1000;
    EXPECT_GT(klx, elevation < 60 ? 85 : 95) << elevation;
    EXPECT_LT(klx, 125) << elevation;
    EXPECT_GT(sun / sky, 5) << elevation;
    EXPECT_LT(sun / sky, 8.5) << elevation;
  }
}

TEST(Sky, HazeTakesFromTheSunAndGivesToTheSky) {
  const Vec3f to_sun = Direction(0, 0.8);
  const Atmosphere clear(to_sun, 2), hazy(to_sun, 6);
  EXPECT_GT(Luminance(clear.SunIrradiance()), 1.15 * Luminance(hazy.SunIrradiance()));
  EXPECT_LT(Luminance(clear.Radiance({0, 0, 1})), Luminance(hazy.Radiance({0, 0, 1})));
  EXPECT_GT(hazy.GroundExtinction().y, 2 * clear.GroundExtinction().y);
}

TEST(Sky, LowSunIsRedAndZenithIsBlue) {
  const Atmosphere low(Direction(0, 0.08), 2.5), high(Direction(0, 0.9), 2.5);
  EXPECT_GT(low.SunIrradiance().x, 2.5f * low.SunIrradiance().z);
  const Vec3f zenith = high.Radiance({0, 0, 1});
  EXPECT_GT(zenith.z, 2 * zenith.x);
}

TEST(Sky, SphericalHarmonicsGiveTheIrradianceOfTheTable) {
  const Sky& sky = DefaultSky();
  const Vec3d up = Integrate(sky, {0, 0, 1});
  const Vec3f fit = sky.Irradiance({0, 0, 1});
  EXPECT_NEAR(Luminance(fit) / Luminance(VecCast<float>(up)), 1, 0.01);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(fit[c] / up[c], 1, 0.02) << c;
  // Sideways the third order shows.
  for (double azimuth : {0.3, 1.9, 3.5, 5.1}) {
    const Vec3f n = Direction(azimuth, 0.3);
    EXPECT_NEAR(sky.Irradiance(n).y / Integrate(sky, n).y, 1, 0.06) << azimuth;
  }
}

TEST(Sky, SunStandsWhereTheCompassSays) {
  Environment environment;
  environment.cloud_cover = 0;
  environment.sun_azimuth_deg = 90;
  environment.sun_elevation_deg = 30;
  const Sky sky(environment);
  EXPECT_NEAR(sky.to_sun().x, std::cos(kPi / 6), 1e-6);
  EXPECT_NEAR(sky.to_sun().y, 0, 1e-6);
  EXPECT_NEAR(sky.to_sun().z, 0.5, 1e-6);
  // The sky is brightest about the sun, and the disc holds the sun's irradiance.
  EXPECT_GT(Luminance(sky.Radiance(sky.to_sun())), 4 * Luminance(sky.Radiance({-0.866f, 0, 0.5f})));
  EXPECT_NEAR(sky.sun_radiance().y * 2 * kPi * (1 - std::cos(0.265 * kPi / 180)) / sky.sun_irradiance().y, 1, 0.01);
}

TEST(Sky, CloudsCoverMoreWhenAskedAndLeaveTheSunFree) {
  // Cloud is what is whiter than the clear sky well above the horizon.
  double share[3];
  int k = 0;
  for (double cover : {0.0, 0.35, 0.8}) {
    Environment environment;
    environment.cloud_cover = cover;
    environment.cirrus_cover = 0;
    const Sky sky(environment);
    int white = 0, all = 0;
    for (int i = 0; i < 8000; ++i) {
      const Vec3f d = Direction(i * 2.39996, std::asin(0.1 + 0.9 * (i + 0.5) / 8000));
      if (Dot(d, sky.to_sun()) > 0.9f) continue;
      const Vec3f c = sky.Radiance(d);
      white += c.z < 1.45f * c.x;
      ++all;
    }
    share[k++] = static_cast<double>(white) / all;
  }
  EXPECT_LT(share[0], 0.02);
  EXPECT_GT(share[1], share[0] + 0.03);
  EXPECT_GT(share[2], share[1] + 0.1);
  EXPECT_LT(share[1], 0.6);
}

TEST(Sky, IsTheSameWithAnyNumberOfThreads) {
  const ThreadLimit one(1);
  const Sky sky{Environment{}};
  EXPECT_EQ(sky.table().texels, DefaultSky().table().texels);
  EXPECT_EQ(sky.blurred(1).texels, DefaultSky().blurred(1).texels);
}

TEST(Sky, BlurringKeepsTheMean) {
  const Sky& sky = DefaultSky();
  for (int level = 0; level < Sky::kBlurLevels; ++level) {
    double sharp = 0, blurred = 0;
    for (int i = 0; i < 8000; ++i) {
      const Vec3f d = Direction(i * 2.39996, std::asin(-1 + 2 * (i + 0.5) / 8000));
      sharp += sky.Radiance(d).y;
      blurred += sky.blurred(level).At(d).y;
    }
    EXPECT_NEAR(blurred / sharp, 1, 0.03) << level;
  }
}

}  // namespace
}  // namespace airsim360::internal

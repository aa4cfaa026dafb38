#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "airsim360/render/shared/precipitation_scalar.h"
#include "airsim360/render/sky/sky.h"

namespace airsim360::internal {
namespace {

double AirLuminance(Vec3f c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

TEST(Air, PathThroughALayerIsTheIntegralOfItsDensity) {
  for (const float height : {0.0f, 30.0f, 300.0f}) {
    for (const float slope : {-0.9f, -0.1f, -1e-4f, 0.0f, 1e-4f, 0.1f, 1.0f}) {
      for (const float distance : {1.0f, 100.0f, 300.0f}) {
        constexpr int kSteps = 20000;
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) sum += std::exp(-(height + slope * distance * (i + 0.5) / kSteps) / 160) * distance / kSteps;
        EXPECT_NEAR(scalar::layer_path(height, slope, distance, 160) / sum, 1, 2e-4) << height << " " << slope << " " << distance;
      }
    }
  }
}

TEST(Air, AnAscendingRayLeavesALayerAfterItsScaleHeight) { EXPECT_NEAR(scalar::layer_path(0, 0.5f, kFarAir, 160), 320, 0.5); }

TEST(Air, FogLeavesAContrastOfATwentiethAtTheVisibility) {
  Environment environment;
  environment.cloud_cover = 0, environment.visibility_m = 400;
  const Sky sky(environment);
  // A black and a white object in the same direction, and the fog itself.
  const Vec3f d{0.6f, 0.8f, 0};
  const Vec3f black = sky.ThroughAir({0, 0, 0}, d, 400, {}), white = sky.ThroughAir({0, 0, 0}, d, 400, {1, 1, 1});
  EXPECT_NEAR(white.y - black.y, 0.05, 0.002);
  const Vec3f far = sky.ThroughAir({0, 0, 0}, d, 40000, {});
  EXPECT_NEAR((AirLuminance(far) - AirLuminance(black)) / AirLuminance(far), 0.05, 0.003);
  // It hides the sky at the horizon but less overhead.
  EXPECT_NEAR(AirLuminance(sky.Radiance(Vec3f{0.6f, 0.8f, 0.0f})) / AirLuminance(far), 1, 0.03);
}

TEST(Air, HazeScalesTheClearAirBeforeSurfacesAlone) {
  Environment environment;
  environment.cloud_cover = 0;
  const Sky one(environment);
  environment.haze = 3;
  const Sky three(environment);
  environment.haze = 0;
  const Sky none(environment);
  const Vec3f d{0.6f, 0.8f, 0}, light{0.5f, 0.2f, 0.1f}, white{1, 1, 1}, up{0, 0.6f, 0.8f};
  EXPECT_EQ(none.ThroughAir({0, 0, 2}, d, 5000, light), light);
  const auto kept = [&](const Sky& sky) { return (sky.ThroughAir({0, 0, 2}, d, 5000, white) - sky.ThroughAir({0, 0, 2}, d, 5000, {})).y; };
  EXPECT_NEAR(kept(three), std::pow(kept(one), 3.0f), 1e-5);
  EXPECT_EQ(three.Radiance(up), one.Radiance(up));
  EXPECT_EQ(three.Irradiance({0, 0, 1}), one.Irradiance({0, 0, 1}));
  // Far things still take the colour of the horizon, only sooner.
  EXPECT_NEAR(AirLuminance(three.ThroughAir({0, 0, 2}, d, 1e6f, {})) / AirLuminance(one.ThroughAir({0, 0, 2}, d, 2e6f, {})), 1, 0.02);
}

TEST(Air, FarThingsMeltIntoTheHorizonAllAround) {
  for (const double elevation : {48.0, 10.0, 2.0, -4.0}) {
    Environment environment;
    environment.cloud_cover = 0, environment.cirrus_cover = 0, environment.sun_elevation_deg = elevation;
    environment.turbidity = 4;
    const Sky sky(environment);
    double error = 0;
    for (int k = 0; k < 32; ++k) {
      const Vec3f d = DirectionOf(static_cast<float>(k) * 0.19635f, 0.0f);
      const Vec3f far = sky.ThroughAir({0, 0, 2}, d, 2e6f, {});
      error += std::fabs(AirLuminance(far) / AirLuminance(sky.table().At({d.x, d.y, 0.012f})) - 1) / 32;
    }
    EXPECT_LT(error, 0.06) << elevation;
  }
}

TEST(Air, HazeGlowsTowardsTheSun) {
  Environment environment;
  environment.cloud_cover = 0, environment.sun_elevation_deg = 12, environment.sun_azimuth_deg = 90;
  const Sky sky(environment);
  const Vec3f towards = sky.ThroughAir({0, 0, 2}, Normalized(Vec3f{1, 0, 0.1f}), 800, {}),
              away = sky.ThroughAir({0, 0, 2}, Normalized(Vec3f{-1, 0, 0.1f}), 800, {});
  EXPECT_GT(AirLuminance(towards), 2 * AirLuminance(away));
}

TEST(Air, IsThinnerAbove) {
  const Sky sky{Environment{}};
  const Vec3f d{1, 0, 0};
  EXPECT_GT(sky.ThroughAir({0, 0, 1000}, d, 2000, {1, 1, 1}).y - sky.ThroughAir({0, 0, 1000}, d, 2000, {}).y,
            1.05f * (sky.ThroughAir({0, 0, 0}, d, 2000, {1, 1, 1}).y - sky.ThroughAir({0, 0, 0}, d, 2000, {}).y));
}

TEST(CloudShadow, PlaceStandsInTheSunAndSomeGroundDoesNot) {
  Environment environment;
  environment.cloud_cover = 0.45;
  const Vec3f place{120, -80, 3};
  const Sky sky(environment, place);
  EXPECT_GT(sky.CloudShadow(place), 0.9f);
  float darkest = 1;
  for (int k = 0; k < 3600; ++k) {
    const Vec3f p = place + Vec3f{static_cast<float>(k % 60) * 100 - 3000, static_cast<float>(k / 60) * 100 - 3000, 0};
    const float light = sky.CloudShadow(p);
    EXPECT_LE(light, 1.0001f);
    darkest = std::min(darkest, light);
    // Points on one ray of the sun share a shadow.
    const Vec3f higher = p + sky.to_sun() * 50.0f;
    if (std::fabs(p.x - place.x) < 2800 && std::fabs(p.y - place.y) < 2800) {
      EXPECT_NEAR(sky.CloudShadow(higher), light, 2e-3f);
    }
  }
  EXPECT_LT(darkest, 0.4f);
}

TEST(CloudShadow, ThereIsNoneUnderAClearOrAClosedSky) {
  for (const double cover : {0.0, 1.0}) {
    Environment environment;
    environment.cloud_cover = cover, environment.cirrus_cover = 0;
    EXPECT_EQ(Sky(environment).CloudShadow({500, 700, 0}), 1);
  }
}

TEST(Precipitation, CoverGrowsWithTheReachAndIsTheSameSeenFromAlongTheRay) {
  // World-anchored: starting nearer along the same ray hides no more than before, and what is left is kept.
  const Vec3f d = Normalized(Vec3f{0.8f, 0.35f, 0.1f});
  const auto cover = [&](Vec3f o, float reach) {
    return scalar::drops_cover({}, 0.0f, o.x, o.y, o.z, d, reach, 0.003f, 0.4f, 0.55f, 0.22f, 0.0011f, 0.9f, 5.0f, 3.0f);
  };
  float before = 0;
  double mean = 0;
  for (float reach = 0.5f; reach < 6; reach += 0.5f) {
    const float now = cover({0.3f, 0.1f, 1.7f}, reach);
    EXPECT_GE(now, before);
    before = now;
  }
  for (int i = 0; i < 2000; ++i) {
    const float c = cover({0.013f * static_cast<float>(i), 0.7f, 0.011f * static_cast<float>(i)}, 100);
    EXPECT_GE(c, 0);
    EXPECT_LE(c, 1);
    mean += c / 2000;
  }
  EXPECT_GT(mean, 0.01);
  EXPECT_LT(mean, 0.5);
  // A hundred metres away there are other drops, about as many.
  double far = 0;
  int same = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3f o{0.013f * static_cast<float>(i), 0.7f, 0.011f * static_cast<float>(i)};
    far += cover(o + Vec3f{100, 0, 0}, 100) / 2000;
    same += cover(o, 100) == cover(o + Vec3f{100, 0, 0}, 100);
  }
  EXPECT_NEAR(far / mean, 1, 0.3);
  EXPECT_LT(same, 1900);
}

}  // namespace
}  // namespace airsim360::internal

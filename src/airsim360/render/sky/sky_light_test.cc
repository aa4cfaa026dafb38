// The light of the physical sky against published values, and the sky as a light to be sampled.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/sky/atmosphere.h"
#include "airsim360/render/sky/cloud_sheets.h"
#include "airsim360/render/sky/sky.h"
#include "airsim360/render/sky/sky_layers.h"

namespace airsim360::internal {
namespace {

double LightLuminance(Vec3f c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

Vec3f DirectionAt(double azimuth, double elevation) { return DirectionOf(static_cast<float>(azimuth), static_cast<float>(elevation)); }

// Horizontal illuminance of the clear sky without the sun, units.
double ClearDiffuse(const Atmosphere& atmosphere) {
  constexpr int kUp = 40, kAround = 64;
  double sum = 0;
  for (int k = 0; k < kUp * kAround; ++k) {
    const double z = std::sqrt((k / kAround + 0.5) / kUp);
    sum += LightLuminance(atmosphere.Radiance(DirectionAt((k % kAround + 0.5) / kAround * 2 * kPi, std::asin(z)))) * kPi / (kUp * kAround);
  }
  return sum;
}

// IES clear sky (RP-21, "Calculation of Daylight Availability", 1984): direct normal 127.5 exp(-0.21 / sin h)
// klx, horizontal diffuse 0.8 + 15.5 sqrt(sin h) klx.
TEST(SkyLight, ClearSkyIlluminanceIsWithinFifteenPerCentOfTheIesModel) {
  for (const double degrees : {20.0, 30.0, 40.0, 50.0, 60.0, 70.0}) {
    const double s = std::sin(degrees * kPi / 180);
    const Atmosphere atmosphere(DirectionAt(0, degrees * kPi / 180), 2.5);
    const double direct = LightLuminance(atmosphere.SunIrradiance()) * s * kLuxPerUnit / 1000,
                 diffuse = ClearDiffuse(atmosphere) * kLuxPerUnit / 1000;
    const double direct_ies = 127.5 * std::exp(-0.21 / s) * s, diffuse_ies = 0.8 + 15.5 * std::sqrt(s);
    EXPECT_NEAR((direct + diffuse) / (direct_ies + diffuse_ies), 1, 0.15) << degrees;
    EXPECT_NEAR(diffuse / diffuse_ies, 1, 0.15) << degrees;
    RecordProperty("global_klx_" + std::to_string(static_cast<int>(degrees)), std::to_string(direct + diffuse));
    RecordProperty("sun_to_sky_" + std::to_string(static_cast<int>(degrees)), std::to_string(direct / diffuse));
  }
}

// Illuminance of level ground, Explanatory Supplement to the Astronomical Almanac (Seidelmann 1992): about
// 760 lx with the sun on the horizon, 3.4 lx at -6 degrees. Air and refraction make a factor of two.
TEST(SkyLight, TwilightFallsAsTheAlmanacSays) {
  const auto lux = [](double degrees) { return ClearDiffuse(Atmosphere(DirectionAt(0, degrees * kPi / 180), 2.5)) * kLuxPerUnit; };
  EXPECT_GT(lux(-0.3), 300);
  EXPECT_LT(lux(-0.3), 1100);
  EXPECT_GT(lux(-6), 1.2);
  EXPECT_LT(lux(-6), 7);
  double before = 1e9;
  for (double degrees = 4; degrees > -12; degrees -= 1) {
    const double now = lux(degrees);
    EXPECT_LT(now, before) << degrees;
    before = now;
  }
}

TEST(SkyLight, DuskIsRedOverTheSunAndBlueAtTheZenith) {
  const Atmosphere dusk(DirectionAt(0, -3 * kPi / 180), 2.5);
  const Vec3f low = dusk.Radiance(DirectionAt(0, 0.03)), zenith = dusk.Radiance({0, 0, 1}), behind = dusk.Radiance(DirectionAt(kPi, 0.3));
  EXPECT_GT(low.x, 1.5f * low.z);
  EXPECT_GT(zenith.z, 1.3f * zenith.x);
  // The glow is brightest some degrees up, where less air hides it.
  EXPECT_GT(LightLuminance(dusk.Radiance(DirectionAt(0, 0.1))), 5 * LightLuminance(zenith));
  EXPECT_GT(LightLuminance(low), 2 * LightLuminance(behind));
}

// CIE S 011:2003, overcast: (1 + 2 sin h) / 3 of the zenith, on the mean over skies and azimuths.
TEST(SkyLight, OvercastHasTheGradationOfTheCieSkyAndGivesTheIlluminanceAsked) {
  constexpr int kSeeds = 8, kUp = 60, kAround = 60;
  double raised = 0, horizon = 0;
  for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
    const StratusDeck deck(800, 2.0f, DirectionAt(0.4, 0.8), {1, 0}, seed);
    double level = 0;
    for (int k = 0; k < kUp * kAround; ++k) {
      const double z = std::sqrt((k / kAround + 0.5) / kUp);
      level += LightLuminance(deck.Radiance(DirectionAt((k % kAround + 0.5) / kAround * 2 * kPi, std::asin(z)))) * kPi / (kUp * kAround);
    }
    EXPECT_NEAR(level / 2.0, 1, 0.03) << seed;
    // Around the sky at 30 degrees, where the gradation is twice the horizon's.
    for (int k = 0; k < 400; ++k) {
      raised += LightLuminance(deck.Radiance(DirectionAt(k * 2.39996, kPi / 6)));
      horizon += LightLuminance(deck.Radiance(DirectionAt(k * 2.39996, 0.02)));
    }
  }
  EXPECT_NEAR(raised / horizon * (1 + 2 * std::sin(0.02)), 2, 0.3);
}

// Krochmann (1963): 300 + 21000 sin(h) lux.
TEST(SkyLight, ClosedCloudsGiveTheIlluminanceOfAnOvercastDay) {
  for (const double seed : {0.0, 1.0, 2.0}) {
    Environment environment;
    environment.cloud_cover = 1, environment.sky_seed = seed;
    const Sky sky(environment);
    const double lux = sky.GroundIlluminance() * kLuxPerUnit;
    EXPECT_NEAR(lux / (300 + 21000 * std::sin(48 * kPi / 180)), 1, 0.15);
    EXPECT_EQ(LightLuminance(sky.sun_irradiance()), 0);
  }
}

TEST(SkyLight, NightIsDarkButNotBlackAndTheFullMoonGivesAFractionOfALux) {
  Environment night;
  night.sun_elevation_deg = -30, night.cloud_cover = 0, night.cirrus_cover = 0, night.lamps = Lamps::kOff;
  const Sky moonlit(night);
  const double lux = moonlit.GroundIlluminance() * kLuxPerUnit;
  EXPECT_GT(lux, 0.05);  // under a full moon: 0.05 to 0.3 lx (Kyba, Mohar, Posch 2017)
  EXPECT_LT(lux, 0.3);
  EXPECT_GT(Dot(moonlit.to_sun(), DirectionAt((90 - 130) * kPi / 180, 38 * kPi / 180)), 0.9999f);
  night.moon_phase = 0;
  const double dark = Sky(night).GroundIlluminance() * kLuxPerUnit;
  EXPECT_GT(dark, 3e-4);  // starlight and airglow: about 1 mlx
  EXPECT_LT(dark, 3e-3);
}

// Kyba et al. (2011), Berlin: an overcast sky over the middle of a city is ten times brighter than a clear one; the four times
// to fifteen of their other places. Far from lamps it is darker.
TEST(SkyLight, AClosedDeckMakesTheNightsOfATownBrighterAndThoseOfTheCountryDarker) {
  Environment night;
  night.sun_elevation_deg = -30, night.cloud_cover = 0, night.cirrus_cover = 0, night.moon_phase = 0;
  const auto lux = [&](double cover, Lamps lamps, double rain = 0, double visibility = 0) {
    night.cloud_cover = cover, night.lamps = lamps, night.rain_mm_h = rain, night.visibility_m = visibility;
    return Sky(night).GroundIlluminance() * kLuxPerUnit;
  };
  const double clear = lux(0, Lamps::kOn), overcast = lux(1, Lamps::kOn);
  EXPECT_GT(overcast, 4 * clear);
  EXPECT_LT(overcast, 15 * clear);
  EXPECT_LT(lux(1, Lamps::kOff), 0.6 * lux(0, Lamps::kOff));
  // Rain scatters more of the town's light, fog among its lamps most.
  const double rain = lux(1, Lamps::kOn, 6), fog = lux(1, Lamps::kOn, 0, 180);
  EXPECT_GT(rain, overcast);
  EXPECT_GT(fog, 1.5 * rain);
}

TEST(SkyLight, StarsBringTheirOwnIlluminance) {
  SkyTable table = MakeTable(2048, 512, false);
  AddStars(table);
  double light = 0;
  int bright = 0;
  for (int y = 0; y < table.height; ++y) {
    for (int x = 0; x < table.width; ++x) {
      const double l = LightLuminance(table.Texel(x, y));
      light += l * RowSolidAngle(table, y);
      bright += l > 0;
    }
  }
  // With N ~ 10^(0.5 m) the sum of 2.54e-6 lx 10^(-0.4 m) over 4500 stars to 6.5 is 1.4e-4 lx in the mean
  // (integral of u^-0.8); a few of the brightest make most of its scatter.
  EXPECT_GT(light * kLuxPerUnit, 5e-5);
  EXPECT_LT(light * kLuxPerUnit, 6e-4);
  EXPECT_GT(bright, 4500);
  EXPECT_LT(bright, 90000);
}

TEST(SkyLight, SamplesFollowTheirDensity) {
  // Chi-square over 16 x 16 bins of equal solid angle; the bins' shares from the density itself.
  const Sky sky{Environment{}};
  constexpr int kAcross = 16, kUp = 16, kSamples = 200000;
  std::vector<double> expected(kAcross * kUp), seen(kAcross * kUp);
  constexpr int kFine = 64;
  for (int k = 0; k < kAcross * kUp * kFine * kFine; ++k) {
    const int x = k % (kAcross * kFine), y = k / (kAcross * kFine);
    const double z = -1 + 2 * (y + 0.5) / (kUp * kFine);
    expected[y / kFine * kAcross + x / kFine] +=
        sky.Pdf(DirectionAt((x + 0.5) / (kAcross * kFine) * 2 * kPi, std::asin(z))) * 4 * kPi / (kAcross * kUp * kFine * kFine);
  }
  double all = 0;
  for (const double share : expected) all += share;
  EXPECT_NEAR(all, 1, 1e-3);
  RngStream random(1, "sky samples");
  double weighted = 0;
  for (int k = 0; k < kSamples; ++k) {
    const SkySample s = sky.Sample({static_cast<float>(random.Uniform()), static_cast<float>(random.Uniform())});
    ASSERT_GT(s.pdf, 0);
    ASSERT_NEAR(Norm(s.direction), 1, 1e-5);
    double azimuth = std::atan2(s.direction.y, s.direction.x);
    if (azimuth < 0) azimuth += 2 * kPi;
    const int x = std::min(static_cast<int>(azimuth / (2 * kPi) * kAcross), kAcross - 1),
              y = std::min(static_cast<int>((s.direction.z + 1) / 2 * kUp), kUp - 1);
    seen[y * kAcross + x] += 1;
    weighted += std::max(0.0f, s.direction.z) * LightLuminance(s.radiance) / s.pdf / kSamples;
  }
  double chi2 = 0;
  for (size_t i = 0; i < seen.size(); ++i) {
    const double e = expected[i] / all * kSamples;
    chi2 += (seen[i] - e) * (seen[i] - e) / e;
  }
  // 255 degrees of freedom: 99.9 per cent stay below 330.
  EXPECT_LT(chi2, 330);
  // The estimator of irradiance agrees with the coefficients.
  EXPECT_NEAR(weighted / LightLuminance(sky.Irradiance({0, 0, 1})), 1, 0.02);
}

}  // namespace
}  // namespace airsim360::internal

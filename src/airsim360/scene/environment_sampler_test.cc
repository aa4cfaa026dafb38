#include "airsim360/scene/environment_sampler.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr int kSamples = 4000;

TEST(EnvironmentSampler, TheSameSeedDrawsTheSameAndOthersDiffer) {
  std::set<std::string> texts;
  for (uint64_t seed = 0; seed < 500; ++seed) {
    const std::string text = DescribeEnvironment(SampleEnvironment(seed));
    EXPECT_EQ(text, DescribeEnvironment(SampleEnvironment(seed)));
    texts.insert(text);
  }
  EXPECT_EQ(texts.size(), 500u);
}

// Kinds of 4000 draws against their shares; the bound is four standard deviations of a share.
TEST(EnvironmentSampler, KindsOfSkyHaveTheirShares) {
  std::map<std::string, double> share;
  double closed_or_broken = 0, cover = 0;
  for (int i = 0; i < kSamples; ++i) {
    const EnvironmentSample s = DrawEnvironment(static_cast<uint64_t>(i));
    share[s.sky] += 1.0 / kSamples;
    closed_or_broken += (s.sky == "overcast" || s.sky == "broken" || s.sky == "stratocumulus") / double{kSamples};
    const Environment& e = s.environment;
    cover += (1 - (1 - e.cloud_cover) * (1 - e.altocumulus_cover) * (1 - e.cirrus_cover)) / kSamples;
  }
  EXPECT_GE(closed_or_broken, 1.0 / 3);
  EXPECT_LE(closed_or_broken, 0.5);
  EXPECT_EQ(share.size(), CloudPresetNames().size());
  for (const auto& [name, s] : share) EXPECT_GT(s, 0.02) << name;
  // Observers report 54 per cent over land; layers that overlap at random, a little more.
  EXPECT_NEAR(cover, 0.57, 0.07);
}

TEST(EnvironmentSampler, EverySampleHasTheSunAskedForAndStandsInItsSeason) {
  for (const double latitude : {-70.0, -34.0, 0.0, 52.0, 70.0}) {
    for (uint64_t seed = 0; seed < 300; ++seed) {
      const EnvironmentSample s = DrawEnvironment(seed, {.latitude_deg = latitude, .least_sun_elevation_deg = 15});
      EXPECT_NO_THROW(ValidateEnvironment(s.environment, "sample"));
      EXPECT_GE(s.environment.sun_elevation_deg, 15);
      const bool northern_summer = s.month >= 6 && s.month <= 8;
      EXPECT_EQ(s.season == (latitude < 0 ? "winter" : "summer"), northern_summer);
      const bool lies = s.environment.snow_depth > 0 || s.environment.snowfall_mm_h > 0;
      EXPECT_FALSE(lies && s.season == "summer");
      EXPECT_FALSE(lies && latitude > -35 && latitude < 35);
    }
  }
}

TEST(EnvironmentSampler, RainFallsFromClosedSkiesAlone) {
  int rain = 0, fog = 0;
  for (int i = 0; i < kSamples; ++i) {
    const EnvironmentSample s = DrawEnvironment(static_cast<uint64_t>(i));
    const bool falls = s.environment.rain_mm_h > 0 || s.environment.snowfall_mm_h > 0;
    rain += falls;
    fog += s.environment.visibility_m > 0 && s.environment.visibility_m < 1000;
    EXPECT_TRUE(!falls || s.sky == "overcast");
  }
  EXPECT_GT(rain, kSamples / 50);
  EXPECT_LT(rain, kSamples / 10);
  EXPECT_GT(fog, 0);
  EXPECT_LT(fog, kSamples / 20);
}

TEST(EnvironmentSampler, SummerHasMoreCumulusAndHazierAirThanWinter) {
  double cumulus[2] = {}, turbidity[2] = {}, count[2] = {};
  for (int i = 0; i < kSamples; ++i) {
    const EnvironmentSample s = DrawEnvironment(static_cast<uint64_t>(i));
    if (s.season != "summer" && s.season != "winter") continue;
    const int k = s.season == "summer";
    cumulus[k] += s.sky == "humilis" || s.sky == "mediocris" || s.sky == "congestus";
    turbidity[k] += s.environment.turbidity;
    ++count[k];
  }
  EXPECT_GT(cumulus[1] / count[1], 1.5 * cumulus[0] / count[0]);
  EXPECT_GT(turbidity[1] / count[1], turbidity[0] / count[0] + 0.5);
}

TEST(EnvironmentSampler, RefusesClimatesItKnowsNothingOf) {
  EXPECT_THROW(SampleEnvironment(1, {.latitude_deg = 80}), InputError);
  EXPECT_THROW(SampleEnvironment(1, {.least_sun_elevation_deg = 60}), InputError);
}

}  // namespace
}  // namespace airsim360

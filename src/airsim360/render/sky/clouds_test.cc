// Clouds as volumes: their shapes, their light against published values, their shadows.
#include "airsim360/render/sky/clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/sky/cloud_geometry.h"
#include "airsim360/render/sky/cloud_shapes.h"
#include "airsim360/render/sky/noise.h"
#include "airsim360/render/sky/sky.h"

namespace airsim360::internal {
namespace {

double CloudLuminance(Vec3f c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

// A clear atmosphere with the sun at 48 degrees or another elevation, its light for clouds, and what it gives level ground.
struct ClearDay {
  explicit ClearDay(float elevation = 0.8378f) : to_sun(DirectionOf(0.7f, elevation)) {
    for (int k = 0; k < kUp * kAround; ++k) diffuse += atmosphere.Radiance(At(k)) * static_cast<float>(kPi / (kUp * kAround));
    direct = atmosphere.SunIrradiance() * to_sun.z;
  }
  // Directions of equal share of the level illuminance.
  static Vec3f At(int k) {
    const float z = std::sqrt((static_cast<float>(k / kAround) + 0.5f) / kUp);
    return DirectionOf((static_cast<float>(k % kAround) + 0.5f) * 6.2831853f / kAround, std::asin(z));
  }
  CloudLight Light() const {
    return {to_sun,
            [this](float height) { return atmosphere.SunIrradiance(height); },
            diffuse * static_cast<float>(1 / kPi),
            (diffuse + direct) * static_cast<float>(0.16 / kPi),
            {},
            ClearAir(2.5),
            2.4f};
  }
  // Light of level ground by the sky through these clouds; its luminance.
  Vec3f DiffuseLight(const Clouds& clouds) const {
    Vec3f sum{};
    for (int k = 0; k < kUp * kAround; ++k) {
      const Vec3f air = atmosphere.Radiance(At(k));
      sum += clouds.Over(At(k), air, air, HashUnit(k, 0, 1)) * static_cast<float>(kPi / (kUp * kAround));
    }
    return sum;
  }
  double Diffuse(const Clouds& clouds) const { return CloudLuminance(DiffuseLight(clouds)); }
  static constexpr int kUp = 12, kAround = 48;
  Vec3f to_sun;
  Atmosphere atmosphere{to_sun, 2.5};
  Vec3f diffuse{}, direct{};
};

const ClearDay& Day() {
  static const ClearDay day;
  return day;
}

Environment Under(const char* preset, double seed) {
  Environment e = ParseCloudPreset(preset);
  e.sky_seed = seed;
  return e;
}

TEST(CloudNoise, ARowIsTheNoiseOfItsPoints) {
  RngStream random(5, "rows");
  for (const int period : {1, 5, 26}) {
    for (int k = 0; k < 40; ++k) {
      const auto x = static_cast<float>(random.Uniform(-1, 2) * period), y = static_cast<float>(random.Uniform(-1, 2) * period);
      const FractalRow row(y, period, 3, 77);
      EXPECT_EQ(row.At(x), FractalNoise(x, y, period, 3, 77)) << x << ", " << y << ", " << period;
      EXPECT_EQ(row.At(0), FractalNoise(0, y, period, 3, 77));
    }
  }
}

TEST(CloudGeometry, DistanceAndAltitudeAreInverses) {
  for (const float altitude : {300.0f, 1500.0f, 9000.0f}) {
    for (const float z : {0.0015f, 0.02f, 0.3f, 1.0f}) {
      const float t = DistanceToAltitude(z, altitude);
      EXPECT_NEAR(AltitudeOf({std::sqrt(1 - z * z) * t, 0, z * t}) / altitude, 1, 0.01) << altitude << " " << z;
    }
  }
}

TEST(CloudLayer, NothingIsWhereTheMapSaysThatNothingIs) {
  const CloudLayer layer = CumulusLayer({1100, 1350, 1.05f}, 0.3f, {0.6f, 0.8f}, 5);
  RngStream random(1, "points");
  int dense = 0;
  for (int k = 0; k < 200000; ++k) {
    const auto x = static_cast<float>(random.Uniform(-60000, 60000)), y = static_cast<float>(random.Uniform(-60000, 60000));
    const auto altitude = static_cast<float>(random.Uniform(0, 6000));
    const float density = layer.Density(x, y, altitude, k % 2 == 0);
    ASSERT_GE(density, 0);
    ASSERT_LE(density, layer.form().extinction * 1.0001f);
    if (density <= 0) continue;
    ++dense;
    ASSERT_TRUE(layer.MayBeCloud(x, y));
    ASSERT_GE(altitude, layer.lowest());
    ASSERT_LE(altitude, layer.highest());
  }
  EXPECT_GT(dense, 1000);
}

// Share of the ground with an optical depth above it of a half and more.
TEST(CloudLayer, CumulusCoverAboutAsMuchAsAsked) {
  for (const float cover : {0.15f, 0.35f, 0.7f}) {
    const CloudLayer layer = CumulusLayer({1000, 1500, 0.9f}, cover, {1, 0}, 9);
    double seen = 0;
    constexpr int kPoints = 3000;
    for (int k = 0; k < kPoints; ++k) {
      const float x = HashUnit(k, 1, 0) * 49000, y = HashUnit(k, 2, 0) * 49000;
      float depth = 0;
      for (float z = layer.lowest(); z < layer.highest() && depth < 0.5f; z += 30) depth += layer.Density(x, y, z, true) * 30;
      seen += depth >= 0.5f;
    }
    EXPECT_NEAR(seen / kPoints, cover, 0.2 * cover) << cover;
  }
}

// Tops at different heights, bases at different heights: no common ceiling and no common floor.
TEST(CloudLayer, BasesAndTopsVary) {
  const CloudLayer layer = CumulusLayer({1100, 1350, 1.05f}, 0.3f, {1, 0}, 3);
  std::vector<float> bases, tops;
  for (int k = 0; k < 4000; ++k) {
    const float x = HashUnit(k, 1, 0) * 49000, y = HashUnit(k, 2, 0) * 49000;
    float base = 0, top = 0;
    for (float z = layer.lowest(); z < layer.highest(); z += 20) {
      if (layer.Density(x, y, z, true) <= 0.005f) continue;
      if (base == 0) base = z;
      top = z;
    }
    if (top - base > 150) bases.push_back(base), tops.push_back(top);
  }
  ASSERT_GT(bases.size(), 200u);
  const auto spread = [](std::vector<float> v) {
    std::sort(v.begin(), v.end());
    return v[v.size() * 9 / 10] - v[v.size() / 10];
  };
  EXPECT_GT(spread(bases), 120);
  EXPECT_GT(spread(tops), 300);
}

// Kasten & Czeplak (1980), ten years of Hamburg: global / clear = 1 - 0.75 N^3.4, diffuse / global = 0.3 + 0.7 N^2. The cover is
// counted as the sun's rays meet it, over 40 km; the mean of several skies.
TEST(CloudLight, BrokenSkiesGiveTheIlluminanceThatIsMeasured) {
  const ClearDay& day = Day();
  const double clear = CloudLuminance(day.diffuse + day.direct);
  double global = 0, diffuse = 0, cover = 0;
  constexpr int kSkies = 6, kPoints = 2000;
  for (int seed = 1; seed <= kSkies; ++seed) {
    const Clouds clouds(Under("broken", seed), day.Light());
    double sun = 0;
    for (int k = 0; k < kPoints; ++k) sun += clouds.SunAt(HashUnit(k, 3, seed) * 4e4f, HashUnit(k, 4, seed) * 4e4f) / kPoints;
    const double sky = day.Diffuse(clouds);
    cover += (1 - sun) / kSkies, diffuse += sky / kSkies;
    global += (sky + sun * CloudLuminance(day.direct)) / kSkies;
  }
  const double expected = 1 - 0.75 * std::pow(cover, 3.4);
  RecordProperty("cover", std::to_string(cover));
  RecordProperty("global_share", std::to_string(global / clear));
  RecordProperty("diffuse_share", std::to_string(diffuse / global));
  EXPECT_NEAR(global / clear / expected, 1, 0.15) << cover;
  EXPECT_NEAR(diffuse / global / (0.3 + 0.7 * cover * cover), 1, 0.25) << cover;
}

// By night the town below is all their light: more cloud sends back more of it, none more than it gets, and a deck the two-stream
// form's share of its depths (9 to 24 on the mean, thick places weighing less).
TEST(CloudLight, ATownLightsItsCloudsTheMoreTheMoreOfThemThereAre) {
  const CloudLight night{Day().to_sun, [](float) { return Vec3f{}; }, {}, {}, {1, 1, 1}, ClearAir(1.8), 0};
  const auto returned = [&](const char* preset) {
    const Clouds clouds(Under(preset, 3), night);
    double sum = 0;
    for (int k = 0; k < ClearDay::kUp * ClearDay::kAround; ++k) {
      const Vec3f d = ClearDay::At(k);
      sum += CloudLuminance(clouds.Over(d, {}, {}, HashUnit(k, 0, 1))) / (ClearDay::kUp * ClearDay::kAround);
    }
    return sum;
  };
  EXPECT_EQ(returned("clear"), 0);
  double before = 0;
  for (const char* preset : {"humilis", "broken", "overcast"}) {
    const double now = returned(preset);
    EXPECT_GT(now, before) << preset;
    before = now;
  }
  EXPECT_GT(before, 0.4);
  EXPECT_LT(before, 0.75);
}

TEST(CloudShadow, MarchIsWithinFivePerCentOfABruteForceOne) {
  for (const char* preset : {"mediocris", "broken", "altocumulus"}) {
    const Clouds clouds(Under(preset, 4), Day().Light());
    double error = 0, shade = 0;
    constexpr int kPoints = 400;
    for (int k = 0; k < kPoints; ++k) {
      const float x = HashUnit(k, 5, 0) * 2e4f, y = HashUnit(k, 6, 0) * 2e4f;
      const float brute = clouds.SunAt(x, y, 2);
      error += std::fabs(clouds.SunAt(x, y) - brute) / kPoints;
      shade += (1 - brute) / kPoints;
    }
    EXPECT_LT(error, 0.05) << preset;
    EXPECT_GT(shade, 0.02) << preset;
  }
}

// A sky as 32 x 8 luminances above five degrees.
std::vector<double> Picture(const Clouds& clouds) {
  std::vector<double> picture;
  for (int k = 0; k < 32 * 8; ++k) {
    const Vec3f d = DirectionOf(static_cast<float>(k % 32) * 0.19635f, 0.09f + 0.17f * static_cast<float>(k / 32));
    const Vec3f air{0.3f, 0.5f, 1.0f};
    picture.push_back(std::log(CloudLuminance(clouds.Over(d, air, air, 0.5f))));
  }
  return picture;
}

// Correlation of where the clouds stand: of what differs from the mean of all skies and from the sky's own mean of each height,
// as two nearly empty skies are alike without being the same.
// Kasten & Czeplak (1980): broken cloud of N eighths leaves 1 - 0.75 (N / 8)^3.4 of the clear sky's light on level ground, so that
// even with the sun free it is not brighter than clear; and bases that stand in each other's shade are not orange.
TEST(Clouds, OfAFieldUnderALowSunStandInEachOthersShade) {
  const ClearDay low(0.0524f);
  Environment field;
  field.cloud_cover = 0.6, field.cirrus_cover = 0;
  double light = 0;
  constexpr int kSeeds = 4;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    field.sky_seed = seed;
    const Vec3f diffuse = low.DiffuseLight(Clouds(field, low.Light()));
    light += CloudLuminance(diffuse) / kSeeds;
    EXPECT_LT(diffuse.x, 1.3f * diffuse.z) << seed;
  }
  const double clear = CloudLuminance(low.diffuse + low.direct);
  EXPECT_LT(light / clear, 1.05);
  EXPECT_GT(light / clear, 0.4);
}

TEST(CloudVariety, NoTwoOfTwentyFourSeedsLookTheSame) {
  std::vector<std::vector<double>> pictures;
  for (int seed = 1; seed <= 24; ++seed) pictures.push_back(Picture(Clouds(Under("mediocris", seed), Day().Light())));
  for (size_t i = 0; i < pictures[0].size(); ++i) {
    double mean = 0;
    for (const auto& p : pictures) mean += p[i] / static_cast<double>(pictures.size());
    for (auto& p : pictures) p[i] -= mean;
  }
  for (auto& p : pictures) {
    for (size_t row = 0; row < p.size(); row += 32) {
      double mean = 0;
      for (size_t i = row; i < row + 32; ++i) mean += p[i] / 32;
      for (size_t i = row; i < row + 32; ++i) p[i] -= mean;
    }
  }
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  };
  double most = -1;
  for (size_t a = 0; a < pictures.size(); ++a) {
    for (size_t b = 0; b < a; ++b)
      most = std::max(most, dot(pictures[a], pictures[b]) / std::sqrt(dot(pictures[a], pictures[a]) * dot(pictures[b], pictures[b])));
  }
  RecordProperty("largest_correlation", std::to_string(most));
  EXPECT_LT(most, 0.6);
}

TEST(CloudVariety, FairWeatherLeavesTheSunFreeAndBrokenSkiesNotAlways) {
  int free = 0, hidden = 0;
  for (int seed = 1; seed <= 8; ++seed) {
    EXPECT_GT(Clouds(Under("humilis", seed), Day().Light()).SunAt(0, 0), 0.9f) << seed;
    const float sun = Clouds(Under("broken", seed), Day().Light()).SunAt(0, 0);
    free += sun > 0.9f, hidden += sun < 0.6f;
  }
  EXPECT_GE(free, 2);
  EXPECT_GE(hidden, 1);
}

}  // namespace
}  // namespace airsim360::internal

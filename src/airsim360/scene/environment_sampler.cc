#include "airsim360/scene/environment_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/scene/sun_position.h"

namespace airsim360 {
namespace {

// Kinds of sky with their share, what a warm season and a high sun do to it, and the covers that are drawn.
struct Kind {
  const char* name;  // a cloud preset
  double share, summer, noon;
  double cover[2], altocumulus[2], cirrus[2];
};
constexpr Kind kKinds[] = {
    {"clear", 0.13, 0.0, 0.0, {0, 0.03}, {0, 0.07}, {0.02, 0.25}},  // up to an eighth
    {"haze", 0.04, 0.4, 0.0, {0, 0.06}, {0, 0}, {0, 0.3}},
    {"cirrus", 0.10, 0.0, 0.0, {0, 0.05}, {0, 0.1}, {0.35, 0.9}},
    {"altocumulus", 0.09, 0.0, -0.3, {0, 0.1}, {0.3, 0.8}, {0, 0.4}},
    {"humilis", 0.08, 0.4, 0.6, {0.1, 0.3}, {0, 0.1}, {0, 0.3}},
    {"mediocris", 0.09, 0.5, 0.6, {0.2, 0.45}, {0, 0.2}, {0, 0.35}},
    {"congestus", 0.06, 0.6, 0.6, {0.25, 0.5}, {0, 0.2}, {0, 0.4}},
    {"broken", 0.12, 0.0, 0.0, {0.55, 0.85}, {0, 0.4}, {0, 0.3}},
    {"stratocumulus", 0.12, -0.2, -0.1, {0.6, 0.92}, {0, 0}, {0, 0}},
    {"overcast", 0.17, -0.3, -0.1, {1, 1}, {0, 0}, {0, 0}},
};

double Rounded(double value, double step) { return std::round(value / step) * step; }
// To a tenth and a hundredth, as the nearest number of so many digits.
double Tenth(double value) { return std::round(value * 10) / 10; }
double Hundredth(double value) { return std::round(value * 100) / 100; }

double Between(RngStream& random, const double (&range)[2]) { return Hundredth(random.Uniform(range[0], range[1])); }

// -1 in the middle of winter … 1 in the middle of summer.
double Warmth(int month, int day, double latitude) {
  const double year = (30.4 * (month - 1) + day - 196) / 365;  // from mid July
  return std::cos(2 * std::numbers::pi * year) * (latitude < 0 ? -1 : 1);
}

const char* SeasonOf(int month, double latitude) {
  constexpr const char* kSeasons[] = {"winter", "spring", "summer", "autumn"};
  return kSeasons[(month % 12 / 3 + (latitude < 0 ? 2 : 0)) % 4];
}

// A day of the year and an hour at which the sun is as high as asked.
void DrawTime(RngStream& random, const Climate& climate, EnvironmentSample& sample) {
  Environment& e = sample.environment;
  for (;;) {
    sample.month = 1 + static_cast<int>(random.Index(12));
    sample.day = 1 + static_cast<int>(random.Index(28));
    sample.solar_hour = Rounded(random.Uniform(0, 24), 1.0 / 60);
    const SunAngles sun = SunPosition({2025, sample.month, sample.day, sample.solar_hour}, {climate.latitude_deg, 0});
    e.sun_azimuth_deg = Tenth(sun.azimuth_deg), e.sun_elevation_deg = Tenth(sun.elevation_deg);
    if (e.sun_elevation_deg >= climate.least_sun_elevation_deg) return;
  }
}

const Kind& DrawKind(RngStream& random, double warmth, double sun_elevation) {
  const double high = std::clamp((sun_elevation - 10) / 25, -1.0, 1.0);
  double weights[std::size(kKinds)], all = 0;
  for (size_t i = 0; i < std::size(kKinds); ++i) {
    const Kind& kind = kKinds[i];
    weights[i] = kind.share * std::max(0.1, 1 + kind.summer * warmth) * std::max(0.1, 1 + kind.noon * high);
    all += weights[i];
  }
  double at = random.Uniform() * all;
  size_t i = 0;
  while (i + 1 < std::size(kKinds) && at >= weights[i]) at -= weights[i++];
  return kKinds[i];
}

double Exponential(RngStream& random, double mean) { return -mean * std::log(1 - random.Uniform()); }

// Rain or snow of a closed sky, and what lies on the ground from before.
void DrawWeather(RngStream& random, const Climate& climate, double warmth, bool closed, Environment& e) {
  const bool cold = std::fabs(climate.latitude_deg) > 35 && warmth < -0.5;
  const bool falls = closed && random.Chance(0.25), as_snow = cold && random.Chance(0.5);
  const double rate = std::clamp(Exponential(random, 1.5), 0.2, 25.0);
  if (falls && as_snow) e.snowfall_mm_h = Tenth(std::min(rate, 4.0)), e.wetness = 0.1;
  if (falls && !as_snow) e.rain_mm_h = Tenth(rate), e.wetness = 1;
  if (cold && (e.snowfall_mm_h > 0 || random.Chance(0.25))) e.snow_depth = Hundredth(random.Uniform(0.2, 1));
  if (!falls && random.Chance(closed ? 0.3 : 0.06)) e.wetness = Hundredth(random.Uniform(0.2, 0.9));
  const bool low = e.sun_elevation_deg < 20;
  if (random.Chance(low ? 0.03 : 0.005)) {
    e.visibility_m = Rounded(150 * std::pow(1000.0 / 150, random.Uniform()), 10);
  } else if (random.Chance(low ? 0.06 : 0.02)) {
    e.visibility_m = Rounded(1000 * std::pow(6.0, random.Uniform()), 100);  // mist
  }
}

void CheckClimate(const Climate& climate) {
  const auto check = [](const char* name, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw InputError(std::string(name) + " is " + std::to_string(value) + ", not in " + std::to_string(static_cast<int>(low)) + " … " +
                     std::to_string(static_cast<int>(high)));
  };
  check("latitude", climate.latitude_deg, -Climate::kMaxLatitude, Climate::kMaxLatitude);
  check("the least elevation of the sun", climate.least_sun_elevation_deg, -90, Climate::kMaxLeastSun);
}

}  // namespace

EnvironmentSample DrawEnvironment(uint64_t seed, const Climate& climate) {
  CheckClimate(climate);
  RngStream random(seed, "environment");
  EnvironmentSample sample;
  DrawTime(random, climate, sample);
  const double warmth = Warmth(sample.month, sample.day, climate.latitude_deg);
  sample.season = SeasonOf(sample.month, climate.latitude_deg);
  Environment& e = sample.environment;

  const Kind& kind = DrawKind(random, warmth, e.sun_elevation_deg);
  sample.sky = kind.name;
  e = ParseCloudPreset(kind.name, e);
  const bool haze = sample.sky == "haze", closed = sample.sky == "overcast";
  e.cloud_cover = Between(random, kind.cover);
  e.altocumulus_cover = Between(random, kind.altocumulus), e.cirrus_cover = Between(random, kind.cirrus);
  const double seasonal = (climate.urban ? 4.0 / 3 : 1.0) * (1 + 0.5 * warmth);
  const double turbidity = haze ? random.Uniform(5.5, 8) : 2 + seasonal * std::exp(0.35 * random.Normal());
  e.turbidity = Tenth(std::clamp(turbidity, 1.9, 9.0));
  e.sky_seed = std::max<double>(1, static_cast<uint32_t>(random.Bits()));
  DrawWeather(random, climate, warmth, closed, e);
  e.moon_phase = Hundredth(random.Uniform());
  e.moon_azimuth_deg = std::round(random.Uniform(0, 359)), e.moon_elevation_deg = std::round(random.Uniform(5, 60));
  ValidateEnvironment(e, "sampled environment");
  return sample;
}

Environment SampleEnvironment(uint64_t seed, const Climate& climate) { return DrawEnvironment(seed, climate).environment; }

}  // namespace airsim360

// The air of a sky: how much it takes, and what it adds so that far things melt into the horizon.
#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/render/sky/atmosphere.h"
#include "airsim360/render/sky/sky.h"
#include "airsim360/render/sky/sky_layers.h"

namespace airsim360::internal {
namespace {

// Koschmieder: a black object keeps a contrast of 0.05 at the visibility (WMO's meteorological optical
// range).
constexpr float kKoschmieder = 2.996f;
constexpr float kFogHeight = 160,
                kPrecipitationHeight = 700;  // m; fog layers are 50 to 400 m deep; rain under its cloud
// Upward radiance of a deep fog over pi times the level illuminance above it; the rest goes back to space.
constexpr float kFogShare = 0.6f;
// What lamps give the air of a town: streets, a quarter of its ground, are lit by 5 to 10 lx (EN 13201, classes P3 and M4).
// Rain and snow mostly fall above the roofs, in the light that goes up and what clouds send back of it.
constexpr Vec3f kStreetLight = kTownLight * (2.0f / kLuxPerUnit), kRoofLight = kTownLight * (0.5f / kLuxPerUnit);

// Directions around the horizon.
constexpr int kAround = 96, kHarmonics = 7;
using Ring = std::array<Vec3f, kAround>;
float AzimuthOf(int k) { return (static_cast<float>(k) + 0.5f) * 2 * kPiF / kAround; }

struct HorizonFit {
  float glow = 0, error = INFINITY;
  std::array<float, kHarmonics> harmonics{};
};

// Harmonics of one channel of the ring once the glow of this strength is taken out.
HorizonFit FitWithGlow(const Ring& ring, const std::array<float, kAround>& phase, int channel, float glow) {
  HorizonFit fit;
  fit.glow = glow;
  const auto basis = [](int k, int i) {
    const float turns = AzimuthOf(k) * static_cast<float>((i + 1) / 2);
    return i == 0 ? 1.0f : i % 2 == 1 ? std::cos(turns) : std::sin(turns);
  };
  for (int k = 0; k < kAround; ++k) {
    const float even = ring[k][channel] / (1 + glow * phase[k]);
    for (int i = 0; i < kHarmonics; ++i) fit.harmonics[i] += even * basis(k, i) * (i == 0 ? 1.0f : 2.0f) / kAround;
  }
  fit.error = 0;
  for (int k = 0; k < kAround; ++k) {
    float sum = 0;
    for (int i = 0; i < kHarmonics; ++i) sum += fit.harmonics[i] * basis(k, i);
    fit.error += std::fabs(sum * (1 + glow * phase[k]) - ring[k][channel]) / (ring[k][channel] + 1e-12f);
  }
  return fit;
}

// The glow about the sun is taken out of the horizon, so that what is seen above and below it has it too. Its
// strength is that of single scattering, near which the best fit counts; a low sun shows it plainly, and is
// fitted freely.
HorizonFit FitHorizon(const Ring& ring, const std::array<float, kAround>& phase, int channel, float scattered, bool low_sun) {
  float mean = 0;
  for (const Vec3f c : ring) mean += c[channel] / kAround;
  const float physical = scattered / std::max(mean - 0.5f * scattered, 0.25f * mean + 1e-12f);
  HorizonFit best = FitWithGlow(ring, phase, channel, physical);
  const auto consider = [&](float glow) {
    const HorizonFit fit = FitWithGlow(ring, phase, channel, glow);
    if (fit.error < best.error) best = fit;
  };
  for (const float share : {0.5f, 0.7f, 0.85f, 1.2f}) consider(physical * share);
  for (float glow = 0.01f; low_sun && glow < 3; glow *= 1.5f) consider(glow);
  return best;
}

// Optical extinction of rain and snow, 1 / m: 1.076 R^0.67 dB/km for rain (ITU-R P.1814), and for dry snow
// 5.5 S^1.38 dB/km (the same), which wet flakes of stronger falls do not follow: hence the bound.
float PrecipitationExtinction(double rain, double snow) {
  constexpr double kPerDecibel = 0.2303e-3;
  return static_cast<float>(kPerDecibel * (1.076 * std::pow(rain, 0.67) + std::min(5.5 * std::pow(snow, 1.38), 60.0)));
}

}  // namespace

Vec3f Sky::ThroughAir(Vec3f origin, Vec3f d, float distance, Vec3f light) const {
  const bool sky = distance == INFINITY;
  if (sky && air_.weather <= 0) return light;
  const scalar::AirEffect air = sky ? scalar::air_to_sky(air_, origin.z, d, kFarAir) : scalar::air_to_surface(air_, origin.z, d, distance);
  return light * air.kept + air.added;
}

void Sky::BakeAir(const Environment& environment) {
  const ClearAir clear(environment.turbidity);
  const auto haze = static_cast<float>(environment.haze);
  extinction_ = clear.rayleigh + clear.aerosol;
  Put(air_.rayleigh, clear.rayleigh * haze);
  Put(air_.aerosol, clear.aerosol * haze);
  Put(air_.to_sun, to_sun_);
  air_.rayleigh_height = kRayleighHeight, air_.aerosol_height = kAerosolHeight;
  air_.base_z = place_.z;

  // The horizon a little above its line, all around.
  constexpr int kUp = 3;
  Ring ring{};
  for (int k = 0; k < kAround * kUp; ++k) {
    ring[k / kUp] += table_.At(DirectionOf(AzimuthOf(k / kUp), 0.006f + 0.007f * static_cast<float>(k % kUp))) * (1.0f / kUp);
  }
  std::array<float, kAround> phase{};
  for (int k = 0; k < kAround; ++k) phase[k] = scalar::forward_phase(kAirAsymmetry, Dot(DirectionOf(AzimuthOf(k), 0), to_sun_));
  for (int c = 0; c < 3; ++c) {
    const float scattered = clear.aerosol[c] / extinction_[c] * sun_irradiance_[c] / (4 * kPiF);
    const HorizonFit fit = FitHorizon(ring, phase, c, environment.hdri ? 0.0f : scattered, to_sun_.z < 0.2f);
    air_.glow[c] = fit.glow;
    for (int i = 0; i < kHarmonics; ++i) air_.horizon[i][c] = fit.harmonics[i];
  }
  BakeWeather(environment);
}

// Fog, rain and snow: grey, lit by everything above.
void Sky::BakeWeather(const Environment& environment) {
  const float falling = PrecipitationExtinction(environment.rain_mm_h, environment.snowfall_mm_h);
  float fog = 0;
  if (environment.visibility_m > 0) {
    fog = std::max(
        0.0f, kKoschmieder / static_cast<float>(environment.visibility_m) - extinction_.y * static_cast<float>(environment.haze) - falling);
  }
  air_.weather = fog + falling;
  air_.weather_height = (fog * kFogHeight + falling * kPrecipitationHeight) / std::max(air_.weather, 1e-9f);
  const Vec3f level = Irradiance({0, 0, 1}) + sun_irradiance_ * (std::max(0.0f, to_sun_.z) * cloud_shadow_.mean()) +
                      (kRoofLight + (kStreetLight - kRoofLight) * (fog / std::max(air_.weather, 1e-9f))) * town_;
  const float depth = air_.weather * air_.weather_height / std::max(to_sun_.z, 0.05f);
  sun_irradiance_ *= std::exp(-depth);
  Put(air_.weather_light, level * (kFogShare / kPiF));
  // A forward peak passes several times the direct light.
  Put(air_.weather_glow, sun_irradiance_ * (std::exp(0.35f * std::min(depth, 10.0f)) / (4 * kPiF)));
  air_.rain = static_cast<float>(environment.rain_mm_h), air_.snow = static_cast<float>(environment.snowfall_mm_h);
  Put(air_.drop_light, level * (0.75f / kPiF));
}

}  // namespace airsim360::internal

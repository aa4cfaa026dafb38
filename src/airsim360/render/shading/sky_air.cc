// The air of a sky: how much it takes, and what it adds so that far things melt into the horizon.
#include <algorithm>
#include <cmath>

#include "airsim360/render/shading/atmosphere.h"
#include "airsim360/render/shading/shading_scalar.h"
#include "airsim360/render/shading/sky.h"

namespace airsim360::internal {
namespace {

constexpr float kPi = 3.14159265f;
// Koschmieder: a black object keeps a contrast of 0.05 at the visibility (WMO's meteorological optical range).
constexpr float kKoschmieder = 2.996f;
constexpr float kFogHeight = 160, kPrecipitationHeight = 1500;  // m; fog layers are 50 to 400 m deep
// Upward radiance of a deep fog over pi times the level illuminance above it; the rest goes back to space.
constexpr float kFogShare = 0.6f;

void Put(float (&to)[3], Vec3f from) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

// Optical extinction of rain and snow, 1 / m: 1.076 R^0.67 dB/km for rain (ITU-R P.1814), and for dry snow
// 5.5 S^1.38 dB/km (the same), which wet flakes of stronger falls do not follow: hence the bound.
float PrecipitationExtinction(double rain, double snow) {
  constexpr double kPerDecibel = 0.2303e-3;
  return static_cast<float>(kPerDecibel *
                            (1.076 * std::pow(rain, 0.67) + std::min(5.5 * std::pow(snow, 1.38), 60.0)));
}

}  // namespace

Vec3f Sky::ThroughAir(Vec3f origin, Vec3f d, float distance, Vec3f light) const {
  const bool sky = distance == INFINITY;
  if (sky && air_.weather <= 0) return light;
  const scalar::AirEffect air = sky ? scalar::air_to_sky(air_, origin.z, d, kFarAir)
                                    : scalar::air_to_surface(air_, origin.z, d, distance);
  return light * air.kept + air.added;
}

void Sky::BakeAir(const Environment& environment) {
  const ClearAir clear(environment.turbidity);
  extinction_ = clear.rayleigh + clear.aerosol;
  Put(air_.rayleigh, clear.rayleigh);
  Put(air_.aerosol, clear.aerosol);
  Put(air_.to_sun, to_sun_);
  air_.rayleigh_height = kRayleighHeight, air_.aerosol_height = kAerosolHeight;
  air_.base_z = place_.z;

  // The horizon as harmonics of the azimuth; the glow about the sun is taken out of it, so that what is
  // seen above and below the horizon has it too.
  constexpr int kAround = 96, kUp = 3;
  std::array<Vec3f, kAround> ring{};
  Vec3f mean{};
  for (int k = 0; k < kAround * kUp; ++k) {
    const float azimuth = (static_cast<float>(k / kUp) + 0.5f) * 2 * kPi / kAround;
    ring[k / kUp] += table_.At(DirectionOf(azimuth, 0.006f + 0.007f * static_cast<float>(k % kUp))) * (1.0f / kUp);
  }
  for (const Vec3f c : ring) mean += c * (1.0f / kAround);
  Vec3f glow{};
  for (int c = 0; c < 3 && !environment.hdri; ++c) {
    const float scattered = air_.aerosol[c] / extinction_[c] * sun_irradiance_[c] / (4 * kPi);
    glow[c] = scattered / std::max(mean[c] - 0.5f * scattered, 0.25f * mean[c] + 1e-12f);
  }
  Put(air_.glow, glow);
  std::array<Vec3f, 5> fit{};
  for (int k = 0; k < kAround; ++k) {
    const Vec3f d = DirectionOf((static_cast<float>(k) + 0.5f) * 2 * kPi / kAround, 0);
    const float phase = scalar::forward_phase(kAirAsymmetry, Dot(d, to_sun_));
    const Vec3f even{ring[k].x / (1 + glow.x * phase), ring[k].y / (1 + glow.y * phase),
                     ring[k].z / (1 + glow.z * phase)};
    const float basis[5] = {1, 2 * d.x, 2 * d.y, 2 * (d.x * d.x - d.y * d.y), 4 * d.x * d.y};
    for (int i = 0; i < 5; ++i) fit[i] += even * (basis[i] / kAround);
  }
  for (int i = 0; i < 5; ++i) Put(air_.horizon[i], fit[i]);
  BakeWeather(environment);
}

// Fog, rain and snow: grey, lit by everything above.
void Sky::BakeWeather(const Environment& environment) {
  const float falling = PrecipitationExtinction(environment.rain_mm_h, environment.snowfall_mm_h);
  float fog = 0;
  if (environment.visibility_m > 0) {
    fog = std::max(0.0f, kKoschmieder / static_cast<float>(environment.visibility_m) - extinction_.y - falling);
  }
  air_.weather = fog + falling;
  air_.weather_height = (fog * kFogHeight + falling * kPrecipitationHeight) / std::max(air_.weather, 1e-9f);
  const Vec3f level = Irradiance({0, 0, 1}) + sun_irradiance_ * (std::max(0.0f, to_sun_.z) * cloud_shadow_.mean());
  const float depth = air_.weather * air_.weather_height / std::max(to_sun_.z, 0.05f);
  sun_irradiance_ *= std::exp(-depth);
  Put(air_.weather_light, level * (kFogShare / kPi));
  // A forward peak passes several times the direct light.
  Put(air_.weather_glow, sun_irradiance_ * (std::exp(0.6f * std::min(depth, 8.0f)) / (4 * kPi)));
  air_.rain = static_cast<float>(environment.rain_mm_h), air_.snow = static_cast<float>(environment.snowfall_mm_h);
  Put(air_.drop_light, level * (0.75f / kPi));
}

}  // namespace airsim360::internal

#include "airsim360/render/sky/sky.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/render/sky/atmosphere.h"
#include "airsim360/render/sky/clouds.h"
#include "airsim360/render/sky/noise.h"
#include "airsim360/render/sky/sky_layers.h"
#include "airsim360/render/sky/sky_picture.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

constexpr float kSunSolidAngle = 6.72e-5f;  // disc of 0.53 degrees

Vec3f FromCompass(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * (M_PI / 180), elevation = elevation_deg * (M_PI / 180);
  return {static_cast<float>(std::sin(azimuth) * std::cos(elevation)), static_cast<float>(std::cos(azimuth) * std::cos(elevation)),
          static_cast<float>(std::sin(elevation))};
}

// Irradiance of level ground by an upper-hemisphere table.
Vec3f LevelIrradiance(const SkyTable& table) {
  Vec3f sum{};
  for (int y = 0; y < table.height; ++y) {
    const float weight = RowSolidAngle(table, y) * std::sin(table.ElevationOfRow(y));
    for (int x = 0; x < table.width; ++x) sum += table.Texel(x, y) * weight;
  }
  return sum;
}

// What shines by night beside the sun's afterglow.
struct Moon {
  Vec3f direction;
  float share = 0;  // of the sun's light; 0 = not up, or lost in daylight
};

Moon MoonOf(const Environment& environment) {
  constexpr double kDaylight = 5, kSet = -1;  // degrees
  Moon moon{FromCompass(environment.moon_azimuth_deg, environment.moon_elevation_deg)};
  if (environment.sun_elevation_deg < kDaylight && environment.moon_elevation_deg > kSet) moon.share = MoonShare(environment.moon_phase);
  return moon;
}

// Direction from the moon to the sun, so that the lit share of the disc is `phase` and lies on the sun's side.
Vec3f LightOnMoon(Vec3f to_moon, Vec3f to_sun, double phase) {
  const auto cosine = static_cast<float>(2 * std::clamp(phase, 0.0, 1.0) - 1);
  const Vec3f beside = to_sun - to_moon * Dot(to_sun, to_moon);
  const Vec3f side = Norm(beside) > 1e-4f ? Normalized(beside) : Normalized(Cross(to_moon, {0.6f, 0.3f, 0.74f}));
  return side * std::sqrt(std::max(0.0f, 1 - cosine * cosine)) - to_moon * cosine;
}

}  // namespace

Sky::Sky(const Environment& environment, Vec3f place, const Sky* like, float town)
    : place_(place), sun_radius_(SUN_RADIUS), town_(environment.lamps_on() ? town : 0) {
  if (like != nullptr) {
    TakeTable(*like);
  } else {
    environment.hdri ? BakePicture(environment) : BakeSky(environment);
    clear_sun_ = sun_irradiance_;
    BakeIrradiance();
    clear_sh_ = sh_;
  }
  BakeAir(environment);
  if (air_.weather > 0) BakeIrradiance();
  BakeBlurred();
  BakeSampler();
}

// All that does not depend on haze and weather.
void Sky::TakeTable(const Sky& like) {
  to_sun_ = like.to_sun_, moon_light_ = like.moon_light_;
  sun_irradiance_ = clear_sun_ = like.clear_sun_;
  table_ = like.table_;
  below_ = like.below_;
  cloud_shadow_ = like.cloud_shadow_;
  sh_ = clear_sh_ = like.clear_sh_;
  BakeGround();
}

Vec3f Sky::sun_radiance() const { return sun_irradiance_ * (1 / kSunSolidAngle); }

SunLight Sky::sun() const { return {to_sun_, sun_radius_, sun_radiance(), sun_irradiance_}; }

float Sky::sun_seen() const {
  const float direct = cloud_shadow_.At(place_);
  return direct * direct;
}

SkySample Sky::Sample(Vec2f u) const {
  const Vec3f d = sampler_.Direction(u);
  return {d, Radiance(d), sampler_.Pdf(d)};
}

void Sky::BakeSampler() {
  sampler_ = SkySampler([this](Vec3f d) { return Luminance(Radiance(d)); });
}

void Sky::BakeSky(const Environment& environment) {
  const Vec3f sun = FromCompass(environment.sun_azimuth_deg, environment.sun_elevation_deg);
  const Moon moon = MoonOf(environment);
  const Atmosphere atmosphere(sun, environment.turbidity), moonlit = atmosphere.WithSun(moon.direction);

  // The brighter of both throws the shadows.
  const bool by_moon = Luminance(atmosphere.SunIrradiance()) < moon.share * Luminance(moonlit.SunIrradiance());
  to_sun_ = by_moon ? moon.direction : sun;
  if (by_moon) moon_light_ = LightOnMoon(moon.direction, sun, environment.moon_phase);
  const auto light_at = [&](float height) {
    return by_moon ? moonlit.SunIrradiance(height) * moon.share : atmosphere.SunIrradiance(height);
  };
  sun_irradiance_ = light_at(60);

  // Clear sky first, coarse: it is smooth.
  SkyTable clear = MakeTable(256, 96, false);
  ParallelFor(clear.height, [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < clear.width; ++x) {
      const Vec3f d = DirectionOfTexel(clear, x, y);
      Vec3f light = atmosphere.Radiance(d) + NightGlow(d, town_);
      if (moon.share > 0) light += moonlit.Radiance(d) * moon.share;
      clear.SetTexel(x, y, light);
    }
  });

  // Then clouds before it, and stars behind them.
  const Vec3f level = LevelIrradiance(clear), open = level + sun_irradiance_ * std::max(0.0f, to_sun_.z);
  constexpr float kGroundAlbedo = 0.16f;
  // A large city sends up some 0.3 lm from a square metre; clouds over it are then some ten times brighter than its clear sky
  // (Kyba et al. 2011).
  const Vec3f town = kTownLight * (town_ * 0.1f / kLuxPerUnit);
  const Clouds clouds(environment, {to_sun_, light_at, level * (1 / kPiF), open * (kGroundAlbedo / kPiF), town,
                                    ClearAir(environment.turbidity), OvercastIlluminance(sun.z, Luminance(open))});
  table_ = MakeTable(2048, 512, false);
  if (sun.z < 0) AddStars(table_);
  ParallelFor(table_.height, [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < table_.width; ++x) {
      const Vec3f d = DirectionOfTexel(table_, x, y), air = clear.At(d);
      table_.SetTexel(x, y, clouds.Over(d, air + table_.Texel(x, y), air, HashUnit(x, y, 5)));
    }
  });
  if (clouds.closed()) {
    sun_irradiance_ = {};
  } else if (clouds.any() && Luminance(sun_irradiance_) > 0) {
    cloud_shadow_ = CloudShadowMap(place_, to_sun_, [&](float x, float y) { return clouds.SunAt(x, y); });
  }
}

void Sky::BakePicture(const Environment& environment) {
  SplitPicture split = SplitSkyPicture(environment);
  table_ = std::move(split.above);
  below_ = std::move(split.below);
  // Without a sun its direction does not matter; its irradiance is zero.
  const bool found = Luminance(split.sun.irradiance) > 0;
  to_sun_ = found ? split.sun.direction : Vec3f{0, 0, 1};
  sun_irradiance_ = split.sun.irradiance;
}

// Projects irradiance, not radiance: E_lm = A_l L_lm with A = pi, 2 pi / 3, pi / 4.
void Sky::BakeIrradiance() {
  sh_ = {};
  std::array<Vec3d, 9> sum{};
  for (int y = 0; y < table_.height; ++y) {
    const double weight = RowSolidAngle(table_, y);
    for (int x = 0; x < table_.width; ++x) {
      const Vec3f direction = DirectionOfTexel(table_, x, y);
      Vec3f seen = table_.Texel(x, y);
      if (air_.weather > 0) seen = ThroughAir(place_, direction, INFINITY, seen);
      const Vec3d d = VecCast<double>(direction), light = VecCast<double>(seen) * weight;
      const double basis[9] = {1, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3 * d.z * d.z - 1, d.x * d.z, d.x * d.x - d.y * d.y};
      for (int k = 0; k < 9; ++k) sum[k] += light * basis[k];
    }
  }
  // Squares of the basis normalisations, then the cosine lobe.
  constexpr double a0 = 0.282095 * 0.282095, a1 = 0.488603 * 0.488603, a2 = 1.092548 * 1.092548, a20 = 0.315392 * 0.315392,
                   a22 = 0.546274 * 0.546274;
  constexpr double scale[9] = {a0, a1, a1, a1, a2, a2, a20, a2, a22};
  for (int k = 0; k < 9; ++k) {
    const double lobe = k == 0 ? M_PI : k < 4 ? 2 * M_PI / 3 : M_PI / 4;
    sh_[k] = VecCast<float>(sum[k] * (scale[k] * lobe));
  }
  BakeGround();
}

void Sky::BakeGround() {
  const Vec3f up = Irradiance({0, 0, 1}) + sun_irradiance_ * (std::max(0.0f, to_sun_.z) * cloud_shadow_.mean());
  ground_radiance_ = up * Vec3f{0.21f, 0.20f, 0.17f} * (1 / kPiF);
}

Vec3f Sky::Irradiance(Vec3f n) const {
  const Vec3f e = scalar::sh9_irradiance(sh_[0], sh_[1], sh_[2], sh_[3], sh_[4], sh_[5], sh_[6], sh_[7], sh_[8], n);
  return Max(e, Vec3f{});
}

float Sky::GroundIlluminance() const { return Luminance(Irradiance({0, 0, 1}) + sun_irradiance_ * std::max(0.0f, to_sun_.z)); }

Vec3f Sky::Radiance(Vec3f d) const {
  if (d.z >= 0) return ThroughAir(place_, d, INFINITY, table_.At(d));
  if (below_.height > 0) return ThroughAir(place_, d, INFINITY, below_.At({d.x, d.y, -d.z}));
  // Ground 30 m below, seen through the air.
  const Vec3f eye = place_ + Vec3f{0, 0, 30};
  return ThroughAir(eye, d, 30.0f / std::max(-d.z, 1e-4f), ground_radiance_);
}

}  // namespace airsim360::internal

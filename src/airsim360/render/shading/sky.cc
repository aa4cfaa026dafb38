#include "airsim360/render/shading/sky.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/render/shading/atmosphere.h"
#include "airsim360/render/shading/clouds.h"
#include "airsim360/render/shading/noise.h"
#include "airsim360/render/shading/shading_scalar.h"
#include "airsim360/render/shading/sky_table.h"

namespace airsim360::internal {
namespace {

constexpr float kPi = 3.14159265f;
constexpr float kSunSolidAngle = 6.72e-5f;  // disc of 0.53 degrees

}  // namespace

Sky::Sky(const Environment& environment) {
  const double azimuth = environment.sun_azimuth_deg * (kPi / 180.0),
               elevation = environment.sun_elevation_deg * (kPi / 180.0);
  to_sun_ = {static_cast<float>(std::sin(azimuth) * std::cos(elevation)),
             static_cast<float>(std::cos(azimuth) * std::cos(elevation)),
             static_cast<float>(std::sin(elevation))};
  BakeTable(environment);
  BakeIrradiance();
  BakeHorizon();
  BakeBlurred();
}

Vec3f Sky::sun_radiance() const { return sun_irradiance_ * (1 / kSunSolidAngle); }

void Sky::BakeTable(const Environment& environment) {
  const Atmosphere atmosphere(to_sun_, environment.turbidity);
  sun_irradiance_ = atmosphere.SunIrradiance();
  extinction_ = atmosphere.GroundExtinction();

  // Clear sky first, coarse: it is smooth.
  SkyTable clear = MakeTable(256, 96, false);
  ParallelFor(clear.height, [&](int64_t y) {
    for (int x = 0; x < clear.width; ++x)
      clear.SetTexel(x, static_cast<int>(y),
                     atmosphere.Radiance(DirectionOfTexel(clear, x, static_cast<int>(y))));
  });
  Vec3f ambient{};
  for (int y = 0; y < clear.height; ++y) {
    for (int x = 0; x < clear.width; ++x)
      ambient += clear.Texel(x, y) * (RowSolidAngle(clear, y) * std::sin(clear.ElevationOfRow(y)) / kPi);
  }

  // Then clouds before it.
  const Clouds clouds(environment.cloud_cover, {to_sun_, sun_irradiance_, ambient});
  table_ = MakeTable(2048, 512, false);
  ParallelFor(table_.height, [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < table_.width; ++x) {
      const Vec3f d = DirectionOfTexel(table_, x, y);
      const Vec3f haze = clear.At(Normalized(Vec3f{d.x, d.y, std::max(d.z, 0.02f)}));
      table_.SetTexel(x, y, clouds.Over(d, clear.At(d), haze, HashUnit(x, y, 5)));
    }
  });
}

// Projects irradiance, not radiance: E_lm = A_l L_lm with A = pi, 2 pi / 3, pi / 4.
void Sky::BakeIrradiance() {
  std::array<Vec3d, 9> sum{};
  for (int y = 0; y < table_.height; ++y) {
    const double weight = RowSolidAngle(table_, y);
    for (int x = 0; x < table_.width; ++x) {
      const Vec3d d = VecCast<double>(DirectionOfTexel(table_, x, y)),
                  light = VecCast<double>(table_.Texel(x, y)) * weight;
      const double basis[9] = {
          1, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3 * d.z * d.z - 1, d.x * d.z, d.x * d.x - d.y * d.y};
      for (int k = 0; k < 9; ++k) sum[k] += light * basis[k];
    }
  }
  // Squares of the basis normalisations, then the cosine lobe.
  constexpr double a0 = 0.282095 * 0.282095, a1 = 0.488603 * 0.488603, a2 = 1.092548 * 1.092548,
                   a20 = 0.315392 * 0.315392, a22 = 0.546274 * 0.546274;
  constexpr double scale[9] = {a0, a1, a1, a1, a2, a2, a20, a2, a22};
  for (int k = 0; k < 9; ++k) {
    const double lobe = k == 0 ? M_PI : k < 4 ? 2 * M_PI / 3 : M_PI / 4;
    sh_[k] = VecCast<float>(sum[k] * (scale[k] * lobe));
  }
  const Vec3f up = Irradiance({0, 0, 1}) + sun_irradiance_ * std::max(0.0f, to_sun_.z);
  ground_radiance_ = up * Vec3f{0.21f, 0.20f, 0.17f} * (1 / kPi);
}

Vec3f Sky::Irradiance(Vec3f n) const {
  const Vec3f e =
      scalar::sh9_irradiance(sh_[0], sh_[1], sh_[2], sh_[3], sh_[4], sh_[5], sh_[6], sh_[7], sh_[8], n);
  return Max(e, Vec3f{});
}

// Mean and first harmonic in azimuth of a band low over the horizon.
void Sky::BakeHorizon() {
  constexpr int kAround = 64, kUp = 6;
  for (int k = 0; k < kAround * kUp; ++k) {
    const float azimuth = (static_cast<float>(k % kAround) + 0.5f) * 2 * kPi / kAround;
    const Vec3f d = DirectionOf(azimuth, 0.01f + 0.012f * static_cast<float>(k / kAround));
    const Vec3f c = table_.At(d) * (1.0f / (kAround * kUp));
    horizon_mean_ += c;
    horizon_x_ += c * (2 * std::cos(azimuth));
    horizon_y_ += c * (2 * std::sin(azimuth));
  }
}

Vec3f Sky::Radiance(Vec3f d) const {
  if (d.z >= 0) return table_.At(d);
  // Ground 30 m below, seen through the air.
  const float distance = 30.0f / std::max(-d.z, 1e-4f);
  const Vec3f kept = scalar::transmittance(extinction_, distance);
  const Vec3f horizon = table_.At({d.x, d.y, 0});
  return ground_radiance_ * kept + horizon * (Vec3f{1, 1, 1} - kept);
}

}  // namespace airsim360::internal

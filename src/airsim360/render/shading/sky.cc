#include "airsim360/render/shading/sky.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/render/shading/atmosphere.h"
#include "airsim360/render/shading/clouds.h"
#include "airsim360/render/shading/noise.h"
#include "airsim360/render/shading/shading_scalar.h"

namespace airsim360::internal {
namespace {

constexpr float kPi = 3.14159265f;
constexpr float kSunSolidAngle = 6.72e-5f;  // disc of 0.53 degrees

Vec3f DirectionOf(float azimuth, float elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

Vec3f DirectionOfTexel(const SkyTable& table, int x, int y) {
  return DirectionOf((static_cast<float>(x) + 0.5f) * 2 * kPi / static_cast<float>(table.width), table.ElevationOfRow(y));
}

SkyTable MakeTable(int width, int height, bool full_sphere) {
  SkyTable table{width, height, full_sphere, {}};
  table.texels.assign(static_cast<size_t>(table.stride()) * height * 4, 0.0f);
  return table;
}

// Solid angle of the texels of a row: rows end half-way to their neighbours.
float RowSolidAngle(const SkyTable& table, int y) {
  const float here = table.ElevationOfRow(y);
  const float below = y > 0 ? 0.5f * (here + table.ElevationOfRow(y - 1)) : here;
  const float above = y + 1 < table.height ? 0.5f * (here + table.ElevationOfRow(y + 1)) : here;
  return (std::sin(above) - std::sin(below)) * 2 * kPi / static_cast<float>(table.width);
}

Vec3f Mix(Vec3f a, Vec3f b, float t) { return a + (b - a) * t; }

}  // namespace

float SkyTable::ElevationOfRow(int row) const {
  const float t = static_cast<float>(row) / static_cast<float>(height - 1);
  if (full_sphere) return (t - 0.5f) * kPi;
  return (kSkyRowSlope * t + (1 - kSkyRowSlope) * t * t) * (kPi / 2);
}

Vec3f SkyTable::Texel(int x, int y) const {
  const float* p = &texels[(static_cast<size_t>(y) * stride() + x) * 4];
  return {p[0], p[1], p[2]};
}

void SkyTable::SetTexel(int x, int y, Vec3f c) {
  float* p = &texels[(static_cast<size_t>(y) * stride() + x) * 4];
  p[0] = c.x, p[1] = c.y, p[2] = c.z, p[3] = 0;
  if (x == 0) SetTexel(width, y, c);
}

Vec3f SkyTable::At(Vec3f d) const {
  // Column.
  float column = scalar::atan2_approx(d.y, d.x) * (static_cast<float>(width) / (2 * kPi)) - 0.5f;
  if (column < 0) column += static_cast<float>(width);
  const int x = std::clamp(static_cast<int>(column), 0, width - 1);
  const float fx = column - static_cast<float>(x);
  // Row: the inverse of ElevationOfRow.
  float e = scalar::asin_approx(std::clamp(d.z, -1.0f, 1.0f)) * (2 / kPi), t = 0.5f + 0.5f * e;
  if (!full_sphere) {
    e = std::max(e, 0.0f);
    constexpr float a = kSkyRowSlope, b = 1 - kSkyRowSlope;
    t = (std::sqrt(a * a + 4 * b * e) - a) / (2 * b);
  }
  const float row = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(height - 1);
  const int y = std::clamp(static_cast<int>(row), 0, height - 2);
  const float fy = row - static_cast<float>(y);
  return Mix(Mix(Texel(x, y), Texel(x + 1, y), fx), Mix(Texel(x, y + 1), Texel(x + 1, y + 1), fx), fy);
}

Sky::Sky(const Daylight& daylight) {
  const double azimuth = daylight.sun_azimuth_deg * (kPi / 180.0), elevation = daylight.sun_elevation_deg * (kPi / 180.0);
  to_sun_ = {static_cast<float>(std::sin(azimuth) * std::cos(elevation)), static_cast<float>(std::cos(azimuth) * std::cos(elevation)),
             static_cast<float>(std::sin(elevation))};
  BakeTable(daylight);
  BakeIrradiance();
  BakeHorizon();
  BakeBlurred();
}

Vec3f Sky::sun_radiance() const { return sun_irradiance_ * (1 / kSunSolidAngle); }

void Sky::BakeTable(const Daylight& daylight) {
  const Atmosphere atmosphere(to_sun_, daylight.turbidity);
  sun_irradiance_ = atmosphere.SunIrradiance();
  extinction_ = atmosphere.GroundExtinction();

  // Clear sky first, coarse: it is smooth.
  SkyTable clear = MakeTable(256, 96, false);
  ParallelFor(clear.height, [&](int64_t y) {
    for (int x = 0; x < clear.width; ++x) clear.SetTexel(x, static_cast<int>(y), atmosphere.Radiance(DirectionOfTexel(clear, x, static_cast<int>(y))));
  });
  Vec3f ambient{};
  for (int y = 0; y < clear.height; ++y) {
    for (int x = 0; x < clear.width; ++x) ambient += clear.Texel(x, y) * (RowSolidAngle(clear, y) * std::sin(clear.ElevationOfRow(y)) / kPi);
  }

  // Then clouds before it.
  const Clouds clouds(daylight.cloud_cover, {to_sun_, sun_irradiance_, ambient});
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
      const Vec3d d = VecCast<double>(DirectionOfTexel(table_, x, y)), light = VecCast<double>(table_.Texel(x, y)) * weight;
      const double basis[9] = {1, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3 * d.z * d.z - 1, d.x * d.z, d.x * d.x - d.y * d.y};
      for (int k = 0; k < 9; ++k) sum[k] += light * basis[k];
    }
  }
  // Squares of the basis normalisations, then the cosine lobe.
  constexpr double a0 = 0.282095 * 0.282095, a1 = 0.488603 * 0.488603, a2 = 1.092548 * 1.092548, a20 = 0.315392 * 0.315392, a22 = 0.546274 * 0.546274;
  constexpr double scale[9] = {a0, a1, a1, a1, a2, a2, a20, a2, a22};
  for (int k = 0; k < 9; ++k) {
    const double lobe = k == 0 ? M_PI : k < 4 ? 2 * M_PI / 3 : M_PI / 4;
    sh_[k] = VecCast<float>(sum[k] * (scale[k] * lobe));
  }
  const Vec3f up = Irradiance({0, 0, 1}) + sun_irradiance_ * std::max(0.0f, to_sun_.z);
  ground_radiance_ = up * Vec3f{0.21f, 0.20f, 0.17f} * (1 / kPi);
}

Vec3f Sky::Irradiance(Vec3f n) const {
  const Vec3f e = scalar::sh9_irradiance(sh_[0], sh_[1], sh_[2], sh_[3], sh_[4], sh_[5], sh_[6], sh_[7], sh_[8], n);
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

namespace {

// One direction of a coarse sky with its radiance and solid angle.
struct SkySample {
  Vec3f direction, radiance;
  float solid_angle;
};

std::vector<SkySample> CoarseSky(const Sky& sky, int width, int height) {
  const SkyTable grid{width, height, true, {}};
  std::vector<SkySample> samples(static_cast<size_t>(width) * height);
  ParallelFor(height, [&](int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      SkySample& sample = samples[static_cast<size_t>(y) * width + x];
      sample = {DirectionOfTexel(grid, x, y), {}, std::max(RowSolidAngle(grid, y), 1e-7f)};
      for (int k = 0; k < 16; ++k) {
        const float azimuth = (static_cast<float>(x) + (static_cast<float>(k % 4) + 0.5f) / 4) * 2 * kPi / static_cast<float>(width);
        const float elevation = grid.ElevationOfRow(y) + ((static_cast<float>(k / 4) + 0.5f) / 4 - 0.5f) * kPi / static_cast<float>(height - 1);
        sample.radiance += sky.Radiance(DirectionOf(azimuth, std::clamp(elevation, -kPi / 2, kPi / 2))) * (1 / 16.0f);
      }
    }
  });
  return samples;
}

// Mean of the sky over a cosine-power lobe about d.
Vec3f LobeMean(const std::vector<SkySample>& sky, Vec3f d, float exponent) {
  Vec3f sum{};
  float total = 0;
  const float least = std::exp2(-12.0f / exponent);  // the rest of the lobe is below 2^-12 of its peak
  for (const SkySample& sample : sky) {
    const float mu = Dot(sample.direction, d);
    if (mu < least) continue;
    const float weight = scalar::pow_approx(mu, exponent) * sample.solid_angle;
    sum += sample.radiance * weight;
    total += weight;
  }
  return sum * (1 / total);
}

}  // namespace

// Cosine-power lobes about as wide as the GGX lobes of the same roughness: the reflected direction turns twice as far as
// the microfacet, hence a quarter of its exponent.
void Sky::BakeBlurred() {
  for (int level = 0; level < kBlurLevels; ++level) {
    const int width = level == 0 ? 128 : 64, height = width / 2 + 1;
    const std::vector<SkySample> source = CoarseSky(*this, width, height);
    const float alpha = kBlurRoughness[level] * kBlurRoughness[level];
    const float exponent = std::max(1.0f, (2 / (alpha * alpha) - 2) * 0.25f);
    SkyTable& table = blurred_[level] = MakeTable(width, height, true);
    ParallelFor(height, [&](int64_t row) {
      for (int x = 0; x < width; ++x) {
        table.SetTexel(x, static_cast<int>(row), LobeMean(source, DirectionOfTexel(table, x, static_cast<int>(row)), exponent));
      }
    });
  }
}

}  // namespace airsim360::internal

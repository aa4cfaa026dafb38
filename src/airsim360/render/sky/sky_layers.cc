#include "airsim360/render/sky/sky_layers.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/sky/atmosphere.h"

namespace airsim360::internal {
namespace {

// A star's light over a small disc of directions, so that no texel alone carries it.
void AddStar(SkyTable& table, float azimuth, float elevation, Vec3f irradiance) {
  constexpr float kRadius = 0.13f * kPiF / 180;
  const auto each = [&](const auto& visit) {
    const float across = 2 * kPiF / static_cast<float>(table.width), shrink = std::max(std::cos(elevation), 1e-3f);
    const int reach = std::min(static_cast<int>(kRadius / shrink / across) + 1, table.width / 4);
    const int middle = static_cast<int>(azimuth / across);
    for (int y = 0; y < table.height; ++y) {
      const float dy = (table.ElevationOfRow(y) - elevation) / kRadius;
      if (std::fabs(dy) >= 1) continue;
      for (int i = middle - reach; i <= middle + reach; ++i) {
        const float dx = ((static_cast<float>(i) + 0.5f) * across - azimuth) * shrink / kRadius;
        const float weight = 1 - dx * dx - dy * dy;
        if (weight > 0) visit((i + table.width) % table.width, y, weight);
      }
    }
  };
  float all = 0;
  each([&](int, int y, float weight) { all += weight * RowSolidAngle(table, y); });
  if (all <= 0) return;
  each([&](int x, int y, float weight) { table.SetTexel(x, y, table.Texel(x, y) + irradiance * (weight / all)); });
}

}  // namespace

float MoonShare(double phase) { return 2.5e-6f * static_cast<float>(std::pow(std::clamp(phase, 0.0, 1.0), 3.6)); }

Vec3f NightGlow(Vec3f direction, float town) {
  // The airglow's layer at 90 km.
  const float s = (1 - direction.z * direction.z) * (6360.0f / 6450.0f) * (6360.0f / 6450.0f);
  const float slant = std::min(1 / std::sqrt(1 - s), 4.0f);
  Vec3f light = Vec3f{0.9f, 1.03f, 1.0f} * (1.7e-4f * (0.6f + 0.4f * slant) / kLuxPerUnit);
  if (town > 0) {
    const float low = 1 - std::clamp(direction.z, 0.0f, 1.0f);
    light += kTownLight * (town * 6.8e-3f * (1 + 5 * low * low * low * low) / kLuxPerUnit);
  }
  return light;
}

void AddStars(SkyTable& table) {
  constexpr int kStars = 4500;
  RngStream random(0, "stars");
  for (int i = 0; i < kStars; ++i) {
    const auto azimuth = static_cast<float>(random.Uniform(0, 2 * kPiF)), z = static_cast<float>(random.Uniform());
    const double magnitude = 6.5 + 2 * std::log10(std::max(random.Uniform(), 1e-5));
    const auto warm = static_cast<float>(random.Uniform(-1, 1));
    const auto lux = static_cast<float>(2.54e-6 * std::pow(10, -0.4 * magnitude));
    AddStar(table, azimuth, std::asin(z), Vec3f{1 + 0.15f * warm, 1, 1 - 0.2f * warm} * (lux / kLuxPerUnit));
  }
}

float OvercastIlluminance(float sun_z, float clear) {
  return sun_z > 0 ? std::min((300 + 21000 * sun_z) / kLuxPerUnit, clear) : 0.4f * clear;
}

}  // namespace airsim360::internal

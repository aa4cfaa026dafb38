#include "airsim360/render/sky/sky_table.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/render/sky/noise.h"

namespace airsim360::internal {
namespace {}  // namespace

Vec3f DirectionOf(float azimuth, float elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

Vec3f DirectionOfTexel(const SkyTable& table, int x, int y) {
  return DirectionOf((static_cast<float>(x) + 0.5f) * 2 * kPiF / static_cast<float>(table.width), table.ElevationOfRow(y));
}

SkyTable MakeTable(int width, int height, bool full_sphere) {
  SkyTable table{width, height, full_sphere, {}};
  table.texels.assign(static_cast<size_t>(table.stride()) * height * 4, 0.0f);
  return table;
}

float RowSolidAngle(const SkyTable& table, int y) {
  const float here = table.ElevationOfRow(y);
  const float below = y > 0 ? 0.5f * (here + table.ElevationOfRow(y - 1)) : here;
  const float above = y + 1 < table.height ? 0.5f * (here + table.ElevationOfRow(y + 1)) : here;
  return (std::sin(above) - std::sin(below)) * 2 * kPiF / static_cast<float>(table.width);
}

float SkyTable::ElevationOfRow(int row) const {
  const float t = static_cast<float>(row) / static_cast<float>(height - 1);
  if (full_sphere) return (t - 0.5f) * kPiF;
  return (kSkyRowSlope * t + (1 - kSkyRowSlope) * t * t) * (kPiF / 2);
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
  float column = scalar::atan2_approx(d.y, d.x) * (static_cast<float>(width) / (2 * kPiF)) - 0.5f;
  if (column < 0) column += static_cast<float>(width);
  const int x = std::clamp(static_cast<int>(column), 0, width - 1);
  const float fx = column - static_cast<float>(x);
  // Row: the inverse of ElevationOfRow.
  float e = scalar::asin_approx(std::clamp(d.z, -1.0f, 1.0f)) * (2 / kPiF), t = 0.5f + 0.5f * e;
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

}  // namespace airsim360::internal

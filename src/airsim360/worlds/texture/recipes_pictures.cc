// Pictures: shop interiors and shop signs with drawn letters.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "airsim360/worlds/texture/recipe_shapes.h"
#include "airsim360/worlds/texture/sign_lettering.h"

namespace airsim360::internal {

namespace {
struct SignStyle {
  std::string_view text;
  Vec3f ground, letters;
};
constexpr std::array<SignStyle, 16> kSignStyles = {{
    {"CAFE CENTRAL", {0.04f, 0.10f, 0.06f}, {0.80f, 0.66f, 0.32f}},
    {"BOOKS & MAPS", {0.03f, 0.05f, 0.12f}, {0.80f, 0.78f, 0.70f}},
    {"BAKERY", {0.42f, 0.10f, 0.05f}, {0.85f, 0.80f, 0.65f}},
    {"FLOWERS", {0.72f, 0.70f, 0.62f}, {0.10f, 0.26f, 0.10f}},
    {"WEST DELI", {0.05f, 0.05f, 0.05f}, {0.80f, 0.20f, 0.08f}},
    {"OPTICS", {0.75f, 0.76f, 0.78f}, {0.04f, 0.10f, 0.30f}},
    {"PHARMACY", {0.03f, 0.22f, 0.12f}, {0.85f, 0.85f, 0.82f}},
    {"TAILOR & SON", {0.06f, 0.04f, 0.03f}, {0.66f, 0.52f, 0.28f}},
    {"PIZZERIA", {0.50f, 0.05f, 0.04f}, {0.85f, 0.82f, 0.70f}},
    {"RECORDS", {0.08f, 0.06f, 0.14f}, {0.85f, 0.55f, 0.08f}},
    {"HARDWARE", {0.55f, 0.36f, 0.06f}, {0.05f, 0.05f, 0.05f}},
    {"TEA HOUSE", {0.10f, 0.16f, 0.12f}, {0.75f, 0.80f, 0.66f}},
    {"WEST PRINT", {0.10f, 0.11f, 0.13f}, {0.85f, 0.83f, 0.80f}},
    {"BARBER", {0.70f, 0.68f, 0.66f}, {0.45f, 0.05f, 0.05f}},
    {"BIKES", {0.05f, 0.20f, 0.34f}, {0.85f, 0.85f, 0.85f}},
    {"GALLERY", {0.78f, 0.77f, 0.74f}, {0.04f, 0.04f, 0.04f}},
}};
}  // namespace

// Looking into a lit shop: back wall with shelves of goods, ceiling lamps, a counter.
Texel Shop(float u, float v, uint32_t kind) {
  const float lamp = v < 0.16f && std::fmod(u * 6 + 0.2f, 1.0f) < 0.45f && v > 0.09f ? 1.0f : 0.0f;
  Vec3f color = Vec3f{0.34f, 0.29f, 0.22f} * (1.1f - 0.5f * v);
  if (v < 0.2f) color = Vec3f{0.42f, 0.39f, 0.33f} * (0.7f + v);
  if (lamp > 0) return {{1.6f, 1.45f, 1.15f}, 0, 0.5f};
  if (v > 0.86f) return {Vec3f{0.16f, 0.11f, 0.07f}, 0, 0.5f};
  // Goods on shelves: boxes of hashed colour, width and height.
  const int rows = kind == 2 ? 3 : 5;
  const float fy = (v - 0.24f) / 0.62f * static_cast<float>(rows);
  if (v > 0.24f && fy < static_cast<float>(rows)) {
    const auto row = static_cast<uint32_t>(fy);
    const float columns = kind == 0 ? 42 : kind == 1 ? 26 : 14;
    const auto column = static_cast<uint32_t>(u * columns);
    const float in_y = fy - static_cast<float>(row), top = 0.15f + 0.5f * HashUnit(row, column, kind + 3);
    if (in_y > 0.93f)
      color = {0.12f, 0.09f, 0.06f};
    else if (in_y > top && HashUnit(row, column, kind + 8) < 0.85f) {
      const float gray = HashUnit(row, column, 5);
      const Vec3f hue{HashUnit(row, column, 1), HashUnit(row, column, 2), HashUnit(row, column, 4)};
      color = Mix(Vec3f{0.30f, 0.26f, 0.21f} * (0.3f + gray), hue * Vec3f{0.40f, 0.30f, 0.24f}, 0.45f);
    }
  }
  // A counter and hanging lamps in front.
  if (v > 0.62f && u > 0.12f && u < 0.42f) color = Vec3f{0.20f, 0.12f, 0.07f} * (v < 0.65f ? 1.8f : 1.0f);
  return {color, 0, 0.5f};
}

// Sixteen signs stacked; each is 5 m by 0.8 m, so a letter cell is square when 6 units wide of 12 high in the
// strip.
Texel Sign(float u, float v) {
  const float strip = v * 16;
  const auto index = std::min(static_cast<size_t>(strip), kSignStyles.size() - 1);
  const SignStyle& sign = kSignStyles[index];
  const float y = strip - static_cast<float>(index);
  const auto n = static_cast<float>(sign.text.size());
  const float unit = std::min(0.8f / 11, 4.3f / (n * 6 - 1)), width = (n * 6 - 1) * unit,
              x = u * 5 - (5 - width) / 2;
  Texel texel{sign.ground, 0, 0.55f};
  if (y < 0.04f || y > 0.96f) texel.color = sign.letters * 0.8f;
  // Four by four samples of the texel's area.
  static const std::vector<SignLettering> lines = [] {
    std::vector<SignLettering> made;
    for (size_t i = 0; i < kSignStyles.size(); ++i) made.emplace_back(kSignStyles[i].text, 0.13f + 0.02f * static_cast<float>(i % 4));
    return made;
  }();
  const SignLettering& line = lines[index];
  const float high = 7 * unit, top = y * 0.8f - 2 * unit, scale = line.width() / width;
  if (x < -0.02f || x > width + 0.02f || top < -0.02f || top > high + 0.02f) return texel;
  float ink = 0;
  for (int k = 0; k < 16; ++k) {
    const float dx = (static_cast<float>(k % 4) - 1.5f) * 0.0015f, dy = (static_cast<float>(k / 4) - 1.5f) * 0.003f;
    ink += line.Inked((x + dx) * scale, (top + dy) / high) ? 1.0f / 16 : 0.0f;
  }
  texel.color = Mix(sign.ground, sign.letters, ink);
  return texel;
}

}  // namespace airsim360::internal

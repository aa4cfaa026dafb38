// Pictures: what is seen through shop windows.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/texture/recipe_shapes.h"

namespace airsim360::internal {

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

}  // namespace airsim360::internal

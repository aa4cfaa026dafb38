#include "airsim360/worlds/texture/recipe_shapes.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {

float Step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

Unit Bond(float u, float v, float tile, int columns, int rows, float offset) {
  const float fy = v * static_cast<float>(rows);
  const int row = static_cast<int>(fy);
  const float shift = offset * static_cast<float>(row % 2);
  const float fx = u * static_cast<float>(columns) + shift;
  const int column = static_cast<int>(std::floor(fx)) % columns;
  const float x = fx - std::floor(fx), y = fy - std::floor(fy);
  const float w = tile / static_cast<float>(columns), h = tile / static_cast<float>(rows);
  const float edge = std::min(std::min(x, 1 - x) * w, std::min(y, 1 - y) * h);
  return {edge, static_cast<uint32_t>(row * 131 + column), x, y};
}

Unit Herringbone(float u, float v, float tile, int n) {
  const float x = u * static_cast<float>(n), y = v * static_cast<float>(n), cell = tile / static_cast<float>(n);
  const int ix = static_cast<int>(x), iy = static_cast<int>(y);
  const float fx = x - std::floor(x), fy = y - std::floor(y);
  // In row iy the pattern is shifted by iy: two cells of a lying brick, then one cell each of two standing
  // bricks.
  const int k = ((ix - iy) % 4 + 4) % 4;
  float bx = fx, by = fy;
  int ox = ix, oy = iy;
  float length_x = 1, length_y = 1;
  if (k < 2) {
    length_x = 2;
    bx = fx + static_cast<float>(k);
    ox = ix - k;
  } else {
    length_y = 2;
    by = k == 2 ? fy + 1 : fy;
    oy = k == 2 ? iy - 1 : iy;
  }
  const auto wrap = [n](int i) { return (i % n + n) % n; };
  const float edge = std::min(std::min(bx, length_x - bx), std::min(by, length_y - by)) * cell;
  return {edge, static_cast<uint32_t>(wrap(oy) * 977 + wrap(ox) * 3 + (k < 2)), bx / length_x, by / length_y};
}

}  // namespace airsim360::internal

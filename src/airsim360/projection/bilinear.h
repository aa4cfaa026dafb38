// Bilinear interpolation over pictures with different borders. Not for other modules.
#pragma once

#include <algorithm>
#include <cmath>

#include "airsim360/image/image.h"
#include "airsim360/math/vector.h"

namespace airsim360::internal {

// Reads an equirectangular picture beyond its borders: columns wrap, rows beyond a pole come back on the
// other side.
struct SphereReader {
  const Image<Rgb32f>& image;
  const Rgb32f& operator()(int x, int y) const {
    const int w = image.width(), h = image.height();
    if (y < 0 || y >= h) {
      y = y < 0 ? -1 - y : 2 * h - 1 - y;
      x += w / 2;
    }
    return image((x % w + w) % w, y);
  }
};

// Holds the border.
struct ClampReader {
  const Image<Rgb32f>& image;
  const Rgb32f& operator()(int x, int y) const { return image(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1)); }
};

// The four pixels around a position, weighted; pixel centres are at +0.5. `read(x, y)` gives pixels, also
// beyond the border.
template <class Reader>
Rgb32f Bilinear(const Reader& read, Vec2d at) {
  const double fx = std::floor(at.x - 0.5), fy = std::floor(at.y - 0.5);
  const int x = static_cast<int>(fx), y = static_cast<int>(fy);
  const auto u = static_cast<float>(at.x - 0.5 - fx), v = static_cast<float>(at.y - 0.5 - fy);
  const float w00 = (1 - u) * (1 - v), w10 = u * (1 - v), w01 = (1 - u) * v, w11 = u * v;
  const Rgb32f &a = read(x, y), &b = read(x + 1, y), &c = read(x, y + 1), &d = read(x + 1, y + 1);
  return {w00 * a.r + w10 * b.r + w01 * c.r + w11 * d.r, w00 * a.g + w10 * b.g + w01 * c.g + w11 * d.g,
          w00 * a.b + w10 * b.b + w01 * c.b + w11 * d.b};
}

}  // namespace airsim360::internal

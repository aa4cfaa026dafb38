#include "airsim360/scene/material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "airsim360/image/color.h"

namespace airsim360 {
namespace {

// Mean of the 2x2 block above a pixel; odd borders repeat their last column or row.
Image<Rgba8> HalfSize(const Image<Rgba8>& fine, bool srgb) {
  Image<Rgba8> coarse(std::max(1, fine.width() / 2), std::max(1, fine.height() / 2));
  const auto decode = [&](uint8_t v) { return srgb ? SrgbToLinear(v) : static_cast<float>(v) / 255.0f; };
  static const SrgbEncoder kEncode;
  const auto encode = [&](float v) { return srgb ? kEncode(v) : static_cast<uint8_t>(v * 255.0f + 0.5f); };
  std::array<float, 256> decoded;
  for (size_t v = 0; v < decoded.size(); ++v) decoded[v] = decode(static_cast<uint8_t>(v));
  const size_t wide = static_cast<size_t>(fine.width()), last = wide - 1;
  for (int y = 0; y < coarse.height(); ++y) {
    const Rgba8* upper = &fine.pixels()[static_cast<size_t>(2 * y) * wide];
    const Rgba8* lower = 2 * y + 1 < fine.height() ? upper + wide : upper;
    for (int x = 0; x < coarse.width(); ++x) {
      float r = 0, g = 0, b = 0, a = 0;
      const size_t left = 2 * static_cast<size_t>(x), right = std::min(left + 1, last);
      for (const Rgba8 p : {upper[left], upper[right], lower[left], lower[right]}) {
        r += decoded[p.r];
        g += decoded[p.g];
        b += decoded[p.b];
        a += static_cast<float>(p.a);
      }
      coarse(x, y) = {encode(r / 4), encode(g / 4), encode(b / 4), static_cast<uint8_t>(a / 4 + 0.5f)};
    }
  }
  return coarse;
}

}  // namespace

Texture Texture::FromImage(std::string name, Image<Rgba8> image, bool srgb) {
  Texture texture;
  texture.name = std::move(name);
  texture.srgb = srgb;
  texture.levels.push_back(std::move(image));
  while (texture.levels.back().width() > 1 || texture.levels.back().height() > 1) {
    texture.levels.push_back(HalfSize(texture.levels.back(), srgb));
  }
  return texture;
}

}  // namespace airsim360

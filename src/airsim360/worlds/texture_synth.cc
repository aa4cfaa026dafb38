#include "airsim360/worlds/texture_synth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "airsim360/image/color.h"

namespace airsim360 {
namespace {

constexpr uint32_t Hash(uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

uint32_t HashCell(uint32_t seed, int x, int y, int period) {
  const auto wrap = [period](int i) { return static_cast<uint32_t>((i % period + period) % period); };
  return Hash(seed * 0x9e3779b9u ^ Hash(wrap(x) + Hash(wrap(y) + 0x51ed270bu)));
}

float ToUnit(uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }
float Smooth(float t) { return t * t * (3 - 2 * t); }
float Luminance(Vec3f c) { return Dot(c, {0.2126f, 0.7152f, 0.0722f}); }
uint8_t ToByte(float x) { return static_cast<uint8_t>(std::clamp(x, 0.0f, 1.0f) * 255 + 0.5f); }

}  // namespace

float HashUnit(uint32_t a, uint32_t b, uint32_t c) {
  return ToUnit(Hash(a + Hash(b + Hash(c + 0x2545f491u))));
}

float TilingNoise(uint32_t seed, float x, float y, int period) {
  const float fx = std::floor(x), fy = std::floor(y);
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
  const float u = Smooth(x - fx), v = Smooth(y - fy);
  const auto at = [&](int dx, int dy) { return ToUnit(HashCell(seed, ix + dx, iy + dy, period)); };
  const float low = at(0, 0) + (at(1, 0) - at(0, 0)) * u, high = at(0, 1) + (at(1, 1) - at(0, 1)) * u;
  return 2 * (low + (high - low) * v) - 1;
}

float TilingFbm(uint32_t seed, float u, float v, int period, int octaves) {
  float sum = 0, amplitude = 0.6f;
  for (int i = 0; i < octaves; ++i) {
    const auto p = static_cast<float>(period);
    sum += amplitude * TilingNoise(seed + static_cast<uint32_t>(i), u * p, v * p, period);
    amplitude *= 0.55f;
    period *= 2;
  }
  return sum;
}

WorleyResult TilingWorley(uint32_t seed, float u, float v, int period) {
  const float x = u * static_cast<float>(period), y = v * static_cast<float>(period);
  const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
  WorleyResult result{9, 9, 0};
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const uint32_t cell = HashCell(seed, ix + dx, iy + dy, period);
      const float px = static_cast<float>(ix + dx) + ToUnit(cell) - x;
      const float py = static_cast<float>(iy + dy) + ToUnit(Hash(cell)) - y;
      const float d = std::hypot(px, py);
      if (d < result.first) {
        result = {d, result.first, cell};
      } else {
        result.second = std::min(result.second, d);
      }
    }
  }
  return result;
}

TextureSet SynthesizeTextures(const TextureRecipe& recipe, int size) {
  // Evaluate the recipe and measure its mean luminance.
  std::vector<Texel> texels(static_cast<size_t>(size) * static_cast<size_t>(size));
  double luminance = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const auto n = static_cast<float>(size);
      Texel& t = texels[static_cast<size_t>(y) * size + x];
      t = recipe.texel((static_cast<float>(x) + 0.5f) / n, (static_cast<float>(y) + 0.5f) / n);
      luminance += Luminance(t.color);
    }
  }
  const auto gain =
      static_cast<float>(recipe.luminance * static_cast<double>(texels.size()) / std::max(luminance, 1e-9));

  // Encode; normals from central differences over the torus, image rows grow downwards while texture +Y is
  // up.
  Image<Rgba8> color(size, size), normal(size, size), roughness(size, size);
  const float step = 2 * recipe.tile / static_cast<float>(size);
  const auto height = [&](int x, int y) {
    return texels[static_cast<size_t>((y + size) % size) * size + (x + size) % size].height;
  };
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Texel& t = texels[static_cast<size_t>(y) * size + x];
      const auto srgb = [gain](float c) { return LinearToSrgb8(std::clamp(c * gain, 0.012f, 0.9f)); };
      color(x, y) = {srgb(t.color.x), srgb(t.color.y), srgb(t.color.z), 255};
      const Vec3f n = Normalized(Vec3f{(height(x - 1, y) - height(x + 1, y)) / step,
                                       (height(x, y + 1) - height(x, y - 1)) / step, 1});
      normal(x, y) = {ToByte(n.x / 2 + 0.5f), ToByte(n.y / 2 + 0.5f), ToByte(n.z / 2 + 0.5f), 255};
      roughness(x, y) = {255, ToByte(t.roughness), 0, 255};
    }
  }
  return {Texture::FromImage(recipe.name, std::move(color), true),
          Texture::FromImage(recipe.name + " normal", std::move(normal), false),
          Texture::FromImage(recipe.name + " roughness", std::move(roughness), false)};
}

}  // namespace airsim360

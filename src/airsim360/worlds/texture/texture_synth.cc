#include "airsim360/worlds/texture/texture_synth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "airsim360/base/scramble.h"
#include "airsim360/image/color.h"
#include "airsim360/scene/luminance.h"
#include "airsim360/worlds/texture/texture_maps.h"

namespace airsim360 {
namespace {

// Bits of the lattice cells of one tile: scramble of seed, column and row, the row's part of it made once for all columns.
struct NoiseLattice {
  NoiseLattice(uint32_t seed, int period) : salt(seed * 0x9e3779b9u), cells(period) {}
  // Into [0, cells).
  uint32_t Wrap(int i) const {
    const int rest = i % cells;
    return static_cast<uint32_t>(rest < 0 ? rest + cells : rest);
  }
  uint32_t Next(uint32_t wrapped) const { return wrapped + 1 == static_cast<uint32_t>(cells) ? 0 : wrapped + 1; }
  static uint32_t Row(uint32_t y) { return Scramble(y + 0x51ed270bu); }
  uint32_t Cell(uint32_t x, uint32_t row) const { return Scramble(salt ^ Scramble(x + row)); }

  uint32_t salt;
  int cells;
};

float ToUnit(uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }
float Smooth(float t) { return t * t * (3 - 2 * t); }
uint8_t ToByte(float x) { return static_cast<uint8_t>(std::clamp(x, 0.0f, 1.0f) * 255 + 0.5f); }

}  // namespace

float HashUnit(uint32_t a, uint32_t b, uint32_t c) { return ToUnit(Scramble(a + Scramble(b + Scramble(c + 0x2545f491u)))); }

float TilingNoise(uint32_t seed, float x, float y, int period) {
  const float fx = std::floor(x), fy = std::floor(y);
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
  const float u = Smooth(x - fx), v = Smooth(y - fy);
  const NoiseLattice lattice(seed, period);
  const uint32_t x0 = lattice.Wrap(ix), x1 = lattice.Next(x0), y0 = lattice.Wrap(iy);
  const uint32_t row0 = NoiseLattice::Row(y0), row1 = NoiseLattice::Row(lattice.Next(y0));
  const float a = ToUnit(lattice.Cell(x0, row0)), b = ToUnit(lattice.Cell(x1, row0));
  const float c = ToUnit(lattice.Cell(x0, row1)), d = ToUnit(lattice.Cell(x1, row1));
  const float low = a + (b - a) * u, high = c + (d - c) * u;
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
  const NoiseLattice lattice(seed, period);
  WorleyResult result{9, 9, 0};
  for (int dy = -1; dy <= 1; ++dy) {
    const uint32_t row = NoiseLattice::Row(lattice.Wrap(iy + dy));
    for (int dx = -1; dx <= 1; ++dx) {
      const uint32_t cell = lattice.Cell(lattice.Wrap(ix + dx), row);
      const float px = static_cast<float>(ix + dx) + ToUnit(cell) - x;
      const float py = static_cast<float>(iy + dy) + ToUnit(Scramble(cell)) - y;
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

namespace {

using internal::SurfaceMaps;

SurfaceMaps Paint(const TextureRecipe& recipe, int size) {
  SurfaceMaps maps(size, recipe.tile);
  if (recipe.paint) {
    recipe.paint(maps);
    return maps;
  }
  maps.ForEach([&](size_t i, float u, float v) {
    const Texel t = recipe.texel(u, v);
    maps.SetColor(i, t.color);
    maps.height[i] = t.height;
    maps.roughness[i] = t.roughness;
  });
  return maps;
}

TextureFit FitOf(const TextureRecipe& recipe, const SurfaceMaps& maps) {
  double luminance = 0, roughness = 0;
  for (size_t i = 0; i < maps.count(); ++i) {
    luminance += Luminance(maps.color(i));
    roughness += maps.roughness[i];
  }
  const auto n = static_cast<double>(maps.count());
  TextureFit fit;
  fit.luminance_gain = static_cast<float>(recipe.luminance / std::max(luminance / n, 1e-9));
  if (recipe.roughness > 0) fit.roughness_shift = static_cast<float>(recipe.roughness - roughness / n);
  if (recipe.slope > 0) fit.slope_gain = static_cast<float>(recipe.slope / std::max(internal::SlopeOf(maps), 1e-9));
  return fit;
}

}  // namespace

namespace internal {

double SlopeOf(const SurfaceMaps& maps) {
  const float step = 2 / maps.texels_per_metre();
  double sum = 0;
  for (int y = 0; y < maps.size; ++y) {
    for (int x = 0; x < maps.size; ++x) {
      const float dx = (maps.height.At(x + 1, y) - maps.height.At(x - 1, y)) / step,
                  dy = (maps.height.At(x, y + 1) - maps.height.At(x, y - 1)) / step;
      sum += static_cast<double>(dx * dx + dy * dy);
    }
  }
  return std::sqrt(sum / static_cast<double>(maps.count()));
}

void Flatten(SurfaceMaps& maps, float radius) {
  const float texels = radius * maps.texels_per_metre();
  for (Field* field : {&maps.red, &maps.green, &maps.blue}) {
    const Field soft = Blurred(*field, texels);
    double mean = 0;
    for (float v : field->values) mean += v;
    mean /= static_cast<double>(field->count());
    for (size_t i = 0; i < field->count(); ++i)
      (*field)[i] = std::min(0.9f, (*field)[i] * static_cast<float>(mean) / std::max(soft[i], 0.01f));
  }
  const Field soft = Blurred(maps.height, texels);
  for (size_t i = 0; i < maps.count(); ++i) maps.height[i] -= soft[i];
}

}  // namespace internal

TextureSet SynthesizeTextures(const TextureRecipe& recipe, int size, TextureFit* fit_out) {
  static const SrgbEncoder kEncode;
  const SurfaceMaps maps = Paint(recipe, size);
  const TextureFit fit = FitOf(recipe, maps);
  if (fit_out) *fit_out = fit;

  // Encode; normals from central differences over the torus, image rows grow downwards while texture +Y is
  // up. Natural albedo lies between 0.03 and 0.9, in blue down to 0.012 (soil, grass).
  Image<Rgba8> color(size, size), normal(size, size), roughness(size, size);
  const float step = 2 / maps.texels_per_metre() / fit.slope_gain;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const size_t i = maps.height.Index(x, y);
      const auto srgb = [&](float c, float least) { return kEncode(std::clamp(c * fit.luminance_gain, least, 0.9f)); };
      color(x, y) = {srgb(maps.red[i], 0.02f), srgb(maps.green[i], 0.02f), srgb(maps.blue[i], 0.012f), 255};
      const Vec3f n = Normalized(Vec3f{(maps.height.At(x - 1, y) - maps.height.At(x + 1, y)) / step,
                                       (maps.height.At(x, y + 1) - maps.height.At(x, y - 1)) / step, 1});
      normal(x, y) = {ToByte(n.x / 2 + 0.5f), ToByte(n.y / 2 + 0.5f), ToByte(n.z / 2 + 0.5f), 255};
      roughness(x, y) = {255, ToByte(std::clamp(maps.roughness[i] + fit.roughness_shift, 0.03f, 1.0f)), 255, 255};
    }
  }
  return {Texture::FromImage(recipe.name, std::move(color), true), Texture::FromImage(recipe.name + " normal", std::move(normal), false),
          Texture::FromImage(recipe.name + " roughness", std::move(roughness), false)};
}

}  // namespace airsim360

// Tiling textures made from noise at load time: a recipe fills colour, height and roughness, which are
// brought to the means of measured scans; then normals and mip chains are derived.
#pragma once

#include <functional>
#include <string>

#include "airsim360/math/vector.h"
#include "airsim360/scene/material.h"

namespace airsim360 {

/// One texel of a recipe: linear base colour, height in metres, roughness.
struct Texel {
  Vec3f color{0.5f, 0.5f, 0.5f};
  float height = 0;
  float roughness = 0.8f;
};

/// Value noise that repeats every `period` lattice cells in both axes; range [-1, 1].
float TilingNoise(uint32_t seed, float x, float y, int period);
/// Sum of `octaves` of TilingNoise from `period` cells per tile on, each half as strong; (u, v) in [0, 1).
/// About [-1, 1].
float TilingFbm(uint32_t seed, float u, float v, int period, int octaves);
/// Distance to the nearest (first) and second nearest feature point, in cells, with the id of the nearest
/// cell.
struct WorleyResult {
  float first, second;
  uint32_t cell;
};
WorleyResult TilingWorley(uint32_t seed, float u, float v, int period);
/// Uniform in [0, 1) from integers.
float HashUnit(uint32_t a, uint32_t b, uint32_t c = 0);

namespace internal {
struct SurfaceMaps;
}

/// A square tile of `tile` metres: either what the texel at (u, v) in [0, 1)², v downwards, looks like, or a
/// painter of whole maps. The targets are means over the tile that the result is brought to.
struct TextureRecipe {
  std::string name;
  float tile = 2;          ///< metres
  float luminance = 0.5f;  ///< mean linear luminance the colours are scaled to
  std::function<Texel(float u, float v)> texel;
  std::function<void(internal::SurfaceMaps&)> paint = nullptr;
  float roughness = 0;  ///< mean; 0 = as painted
  float slope = 0;      ///< root mean square slope of the normal map; 0 = as painted
};

/// What bringing a recipe to its targets took: near 1 and 0 where the recipe itself is right.
struct TextureFit {
  float luminance_gain = 1, roughness_shift = 0, slope_gain = 1;
};

/// Base colour, normal map and roughness of a recipe.
struct TextureSet {
  Texture color, normal, roughness;
};
/// `size`: texels a side, a power of two. `fit`, if given, receives the corrections.
TextureSet SynthesizeTextures(const TextureRecipe& recipe, int size, TextureFit* fit = nullptr);

}  // namespace airsim360

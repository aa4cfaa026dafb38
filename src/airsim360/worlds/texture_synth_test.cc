#include "airsim360/worlds/texture_synth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/image/color.h"
#include "airsim360/worlds/surface_recipes.h"

namespace airsim360 {
namespace {

double MeanLuminance(const Image<Rgba8>& image) {
  double sum = 0;
  for (Rgba8 p : image.pixels())
    sum += 0.2126 * SrgbToLinear(p.r) + 0.7152 * SrgbToLinear(p.g) + 0.0722 * SrgbToLinear(p.b);
  return sum / static_cast<double>(image.size());
}

TEST(TextureSynth, EveryRecipeMeetsItsMeanLuminance) {
  for (int i = 0; i < static_cast<int>(internal::Recipe::kCount); ++i) {
    const TextureRecipe recipe = internal::MakeRecipe(static_cast<internal::Recipe>(i));
    const TextureSet set = SynthesizeTextures(recipe, 128);
    // Clipping at the natural limits may move the mean a little.
    EXPECT_NEAR(MeanLuminance(set.color.levels[0]), recipe.luminance, 0.1 * recipe.luminance) << recipe.name;
  }
}

TEST(TextureSynth, NoiseRepeatsAfterItsPeriod) {
  for (int i = 0; i < 200; ++i) {
    const float x = 0.37f * static_cast<float>(i), y = 0.11f * static_cast<float>(i);
    EXPECT_NEAR(TilingNoise(5, x, y, 8), TilingNoise(5, x + 8, y - 16, 8), 2e-5);
  }
}

TEST(TextureSynth, FlatHeightGivesTheFlatNormal) {
  const TextureSet set = SynthesizeTextures({"flat", 1, 0.5f, [](float, float) { return Texel{}; }}, 8);
  for (Rgba8 p : set.normal.levels[0].pixels()) EXPECT_EQ(p, (Rgba8{128, 128, 255, 255}));
}

TEST(TextureSynth, ASlopeRisingToTheRightTiltsTheNormalToTheLeft) {
  const TextureSet set = SynthesizeTextures({"ramp", 1, 0.5f,
                                             [](float u, float) {
                                               return Texel{{0.5f, 0.5f, 0.5f}, u, 0.5f};
                                             }},
                                            16);
  const Rgba8 middle = set.normal.levels[0](8, 8);  // slope 1: normal (-1, 0, 1) / sqrt 2
  EXPECT_NEAR(middle.r, 255 * (0.5 - 0.5 * std::sqrt(0.5)), 1.5);
  EXPECT_EQ(middle.g, 128);
}

}  // namespace
}  // namespace airsim360

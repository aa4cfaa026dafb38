#include "airsim360/worlds/texture/texture_synth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "airsim360/image/color.h"
#include "airsim360/worlds/texture/surface_recipes.h"
#include "airsim360/worlds/texture/surfaces.h"
#include "airsim360/worlds/texture/texture_field.h"

namespace airsim360 {
namespace {

using internal::MaterialTarget;
using internal::MaterialTargets;

// What the encoded pictures show.
struct Statistics {
  double luminance = 0, deviation = 0, roughness = 0, spread = 0, slope = 0;
};

Statistics Measure(const TextureSet& set) {
  Statistics s;
  const auto n = static_cast<double>(set.color.levels[0].size());
  for (Rgba8 p : set.color.levels[0].pixels()) {
    const double y = 0.2126 * SrgbToLinear(p.r) + 0.7152 * SrgbToLinear(p.g) + 0.0722 * SrgbToLinear(p.b);
    s.luminance += y / n;
    s.deviation += y * y / n;
  }
  for (Rgba8 p : set.roughness.levels[0].pixels()) {
    s.roughness += p.g / 255.0 / n;
    s.spread += p.g * p.g / 65025.0 / n;
  }
  for (Rgba8 p : set.normal.levels[0].pixels()) {
    const double x = p.r / 127.5 - 1, y = p.g / 127.5 - 1, z = std::max(p.b / 127.5 - 1, 0.05);
    s.slope += (x * x + y * y) / (z * z) / n;
  }
  s.deviation = std::sqrt(std::max(0.0, s.deviation - s.luminance * s.luminance));
  s.spread = std::sqrt(std::max(0.0, s.spread - s.roughness * s.roughness));
  s.slope = std::sqrt(s.slope);
  return s;
}

class EveryMaterial : public testing::TestWithParam<size_t> {};

// Bands: albedo within a quarter, roughness within 0.1, slope within a factor 1.6.
TEST_P(EveryMaterial, ShowsWhatScansOfItShow) {
  const MaterialTarget& target = MaterialTargets()[GetParam()];
  const TextureRecipe recipe = internal::MakeRecipe(target.recipe);
  TextureFit fit;
  const Statistics s = Measure(SynthesizeTextures(recipe, internal::SizeOf(target.recipe), &fit));
  std::printf("| %s | %.3f / %.3f / %.3f | %.3f / %.3f | %.2f / %.2f / %.2f | %.2f / %.2f | %.2f / %.2f / %.2f |\n", recipe.name.c_str(),
              target.luminance, target.luminance / fit.luminance_gain, s.luminance, target.deviation, s.deviation, target.roughness,
              target.roughness - fit.roughness_shift, s.roughness, target.spread, s.spread, target.slope, target.slope / fit.slope_gain,
              s.slope);
  EXPECT_NEAR(s.luminance, target.luminance, 0.06 * target.luminance);
  EXPECT_NEAR(s.roughness, target.roughness, 0.03);
  EXPECT_LT(std::fabs(std::log(s.slope / target.slope)), std::log(1.6));
  EXPECT_LT(std::fabs(std::log(s.deviation / target.deviation)), std::log(2.0));
  // The recipe itself, before its means are corrected.
  EXPECT_NEAR(fit.luminance_gain, 1, 0.25);
  EXPECT_NEAR(fit.roughness_shift, 0, 0.1);
  EXPECT_LT(std::fabs(std::log(fit.slope_gain)), std::log(1.6));
}
INSTANTIATE_TEST_SUITE_P(TextureSynth, EveryMaterial, testing::Range<size_t>(0, MaterialTargets().size()));

TEST(TextureSynth, PicturesMeetTheirMeanLuminance) {
  for (int i = 0; i < static_cast<int>(internal::Recipe::kCount); ++i) {
    const TextureRecipe recipe = internal::MakeRecipe(static_cast<internal::Recipe>(i));
    if (recipe.paint) continue;
    const TextureSet set = SynthesizeTextures(recipe, 128);
    // Clipping at the natural limits may move the mean a little.
    EXPECT_NEAR(Measure(set).luminance, recipe.luminance, 0.1 * recipe.luminance) << recipe.name;
  }
}

// A wrap line that differs more than the lines inside the tile would show as a seam.
TEST(TextureSynth, TilesCloseAtTheirBorder) {
  for (const MaterialTarget& target : MaterialTargets()) {
    const TextureRecipe recipe = internal::MakeRecipe(target.recipe);
    const TextureSet set = SynthesizeTextures(recipe, 256);
    const Image<Rgba8>& image = set.color.levels[0];
    const auto step = [&](int x) {
      double sum = 0;
      for (int y = 0; y < 256; ++y) sum += std::abs(image(x, y).g - image((x + 1) % 256, y).g);
      return sum;
    };
    double most = 0;
    for (int x = 0; x < 255; ++x) most = std::max(most, step(x));
    EXPECT_LE(step(255), 1.1 * most) << recipe.name;
  }
}

// Natural limits: nothing below 0.02 or above 0.9 after the colour of the surface is multiplied in.
TEST(Surfaces, NoAlbedoIsOutsideWhatNatureHas) {
  SceneBuilder builder("test");
  const Surfaces surfaces = AddSurfaces(builder);
  const auto scene = builder.Build();
  for (size_t i = 0; i < static_cast<size_t>(Surface::kCount); ++i) {
    const Material& m = scene->materials[surfaces[static_cast<Surface>(i)]];
    if (m.kind != SurfaceKind::kStandard) continue;
    Vec3f mean = m.base_color;
    if (m.base_color_texture != kNoTexture) {
      const Rgba8 p = scene->textures[m.base_color_texture].levels.back()(0, 0);
      mean = mean * Vec3f{SrgbToLinear(p.r), SrgbToLinear(p.g), SrgbToLinear(p.b)};
    }
    const double y = 0.2126 * mean.x + 0.7152 * mean.y + 0.0722 * mean.z;
    EXPECT_GE(y, 0.02) << m.name;
    EXPECT_LE(std::max({mean.x, mean.y, mean.z}), 0.9f) << m.name;
  }
}

TEST(TextureField, FractalNoiseIsStandardAndPeriodic) {
  const internal::Field f = internal::FractalField(256, 5, 4, 5);
  double sum = 0, squares = 0, inside = 0, across = 0;
  for (float v : f.values) sum += v, squares += v * v;
  EXPECT_NEAR(sum / 65536, 0, 1e-3);
  EXPECT_NEAR(squares / 65536, 1, 1e-3);
  for (int y = 0; y < 256; ++y) {
    inside += std::fabs(f.At(100, y) - f.At(101, y));
    across += std::fabs(f.At(255, y) - f.At(256, y));
  }
  EXPECT_LT(across, 2 * inside);
}

TEST(TextureField, CellsKnowTheDistanceToTheirBorder) {
  // On a lattice the border is half a cell from the point in x or y.
  const internal::CellPattern lattice(8, 8, 0, 1);
  for (int i = 0; i < 100; ++i) {
    const float u = 0.0101f * static_cast<float>(i), v = 0.37f + 0.0071f * static_cast<float>(i);
    const auto cell = lattice.At(u, v);
    EXPECT_NEAR(cell.edge, 0.5f - std::max(std::fabs(cell.x), std::fabs(cell.y)), 1e-4);
  }
}

TEST(TextureField, BlurringKeepsTheMean) {
  const internal::Field f = internal::WhiteField(64, 3), soft = internal::Blurred(f, 6);
  double a = 0, b = 0, most = 0;
  for (size_t i = 0; i < f.count(); ++i) a += f[i], b += soft[i], most = std::max<double>(most, std::fabs(soft[i]));
  EXPECT_NEAR(a, b, 0.05);
  EXPECT_LT(most, 0.5);
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
  const TextureSet set = SynthesizeTextures({"ramp", 1, 0.5f, [](float u, float) { return Texel{{0.5f, 0.5f, 0.5f}, u, 0.5f}; }}, 16);
  const Rgba8 middle = set.normal.levels[0](8, 8);  // slope 1: normal (-1, 0, 1) / sqrt 2
  EXPECT_NEAR(middle.r, 255 * (0.5 - 0.5 * std::sqrt(0.5)), 1.5);
  EXPECT_EQ(middle.g, 128);
}

}  // namespace
}  // namespace airsim360

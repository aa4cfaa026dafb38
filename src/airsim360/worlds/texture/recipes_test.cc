// Every recipe of the texture list: tiles, values within what pictures and nature hold, the same from run to
// run.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "airsim360/base/parallel.h"
#include "airsim360/image/color.h"
#include "airsim360/worlds/texture/recipe_shapes.h"
#include "airsim360/worlds/texture/surface_recipes.h"
#include "airsim360/worlds/texture/texture_field.h"

namespace airsim360::internal {
namespace {

constexpr int kSize = 128;

std::string NameOf(Recipe recipe) {
  std::string name = MakeRecipe(recipe).name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::vector<Recipe> AllRecipes() {
  std::vector<Recipe> recipes;
  for (int i = 0; i < static_cast<int>(Recipe::kCount); ++i) recipes.push_back(static_cast<Recipe>(i));
  return recipes;
}

class EveryRecipe : public testing::TestWithParam<Recipe> {
 protected:
  TextureRecipe recipe() const { return MakeRecipe(GetParam()); }
  // Made once for all claims.
  const TextureSet& set() const {
    static std::map<Recipe, TextureSet> sets;
    const auto it = sets.find(GetParam());
    return it != sets.end() ? it->second : sets.emplace(GetParam(), SynthesizeTextures(recipe(), kSize)).first->second;
  }
};

INSTANTIATE_TEST_SUITE_P(Textures, EveryRecipe, testing::ValuesIn(AllRecipes()), [](const auto& info) { return NameOf(info.param); });

// The step over the border is no larger than the largest inside, in all channels and both directions.
TEST_P(EveryRecipe, TilesWithoutSeamsInEveryChannel) {
  const bool picture = GetParam() >= Recipe::kShop0;  // shown once, not tiled
  for (const Texture* texture : {&set().color, &set().normal, &set().roughness}) {
    const Image<Rgba8>& image = texture->levels[0];
    for (bool down : {false, true}) {
      if (picture && down) continue;
      const auto step = [&](int i) {
        double sum = 0;
        for (int k = 0; k < kSize; ++k) {
          const Rgba8 a = down ? image(k, i) : image(i, k), b = down ? image(k, (i + 1) % kSize) : image((i + 1) % kSize, k);
          sum += std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
        }
        return sum;
      };
      double most = 0;
      for (int i = 0; i + 1 < kSize; ++i) most = std::max(most, step(i));
      EXPECT_LE(step(kSize - 1), 1.15 * most + 3) << texture->name << (down ? " downwards" : " across");
    }
  }
}

TEST_P(EveryRecipe, NormalsAreUnitVectorsOutOfTheSurface) {
  double x = 0, y = 0;
  for (Rgba8 p : set().normal.levels[0].pixels()) {
    const double nx = p.r / 127.5 - 1, ny = p.g / 127.5 - 1, nz = p.b / 127.5 - 1;
    ASSERT_GT(nz, 0);
    ASSERT_NEAR(std::sqrt(nx * nx + ny * ny + nz * nz), 1, 0.02);
    x += nx / nz;
    y += ny / nz;
  }
  // Heights that close have no slope in the mean.
  const double n = kSize * kSize;
  EXPECT_NEAR(x / n, 0, 0.035);
  EXPECT_NEAR(y / n, 0, 0.035);
}

TEST_P(EveryRecipe, ColoursAndRoughnessAreWhatNatureHas) {
  double sum = 0;
  int clipped = 0;
  for (Rgba8 p : set().color.levels[0].pixels()) {
    clipped += std::max({p.r, p.g, p.b}) == 255 || std::max({p.r, p.g, p.b}) == 0;
    sum += 0.2126 * SrgbToLinear(p.r) + 0.7152 * SrgbToLinear(p.g) + 0.0722 * SrgbToLinear(p.b);
    ASSERT_EQ(p.a, 255);
  }
  EXPECT_LE(clipped, kSize * kSize / 50);
  EXPECT_NEAR(sum / (kSize * kSize), recipe().luminance, 0.12 * recipe().luminance);
  for (Rgba8 p : set().roughness.levels[0].pixels()) ASSERT_GE(p.g, 8);
}

// Every coarser level is the mean of the finer one, down to a texel.
TEST_P(EveryRecipe, LevelsHalveToOneTexelAndKeepTheMean) {
  for (const Texture* texture : {&set().color, &set().normal, &set().roughness}) {
    int size = kSize;
    ASSERT_EQ(texture->levels.size(), 8u) << texture->name;
    std::vector<double> means;
    for (const Image<Rgba8>& level : texture->levels) {
      EXPECT_EQ(level.width(), size);
      EXPECT_EQ(level.height(), size);
      size /= 2;
      double sum = 0;
      for (Rgba8 p : level.pixels()) sum += texture->srgb ? SrgbToLinear(p.g) : p.g / 255.0;
      means.push_back(sum / static_cast<double>(level.size()));
    }
    // Normals are made units again at every level, and may lean a little more or less.
    for (double mean : means) EXPECT_NEAR(mean, means[0], texture == &set().normal ? 0.03 : 0.012) << texture->name;
  }
  EXPECT_TRUE(set().color.srgb);
  EXPECT_FALSE(set().normal.srgb);
  EXPECT_FALSE(set().roughness.srgb);
}

TEST_P(EveryRecipe, IsTheSameFromRunToRunWithAnyNumberOfThreads) {
  const ThreadLimit one(1);
  const TextureSet again = SynthesizeTextures(recipe(), kSize);
  EXPECT_EQ(again.color.levels[0], set().color.levels[0]);
  EXPECT_EQ(again.normal.levels[0], set().normal.levels[0]);
  EXPECT_EQ(again.roughness.levels[0], set().roughness.levels[0]);
}

TEST_P(EveryRecipe, HasANameATileAndASizeOfItsOwn) {
  std::set<std::string> names;
  for (Recipe other : AllRecipes()) names.insert(NameOf(other));
  EXPECT_EQ(names.size(), static_cast<size_t>(Recipe::kCount));
  EXPECT_GT(recipe().tile, 0);
  EXPECT_NE(recipe().texel == nullptr, recipe().paint == nullptr);
  const int size = SizeOf(GetParam());
  EXPECT_EQ(size & (size - 1), 0);
  // 2 to 6 mm a texel for what is near.
  if (recipe().paint) {
    EXPECT_LE(recipe().tile / static_cast<float>(size), 0.006f);
  }
}

struct Pattern {
  const char* name;
  std::function<Unit(float, float)> at;
  int units;
  float tile;
};
void PrintTo(const Pattern& pattern, std::ostream* out) { *out << pattern.name; }

class EveryBond : public testing::TestWithParam<Pattern> {};

INSTANTIATE_TEST_SUITE_P(Textures, EveryBond,
                         testing::Values(Pattern{"brick", [](float u, float v) { return Bond(u, v, 2, 8, 26, 0.5f); }, 208, 2},
                                         Pattern{"slabs", [](float u, float v) { return Bond(u, v, 3, 4, 6, 0.5f); }, 24, 3},
                                         Pattern{"stack", [](float u, float v) { return Bond(u, v, 1, 5, 5, 0); }, 25, 1},
                                         Pattern{"third", [](float u, float v) { return Bond(u, v, 2, 6, 12, 0.33f); }, 72, 2},
                                         Pattern{"herringbone4", [](float u, float v) { return Herringbone(u, v, 1, 4); }, 8, 1},
                                         Pattern{"herringbone12", [](float u, float v) { return Herringbone(u, v, 2, 12); }, 72, 2}),
                         [](const auto& info) { return info.param.name; });

TEST_P(EveryBond, UnitsAreEqualAndTheirEdgesAreJoints) {
  constexpr int kFine = 480;
  std::map<uint32_t, int> cells;
  std::vector<Unit> units;
  for (int y = 0; y < kFine; ++y)
    for (int x = 0; x < kFine; ++x) {
      const Unit unit = GetParam().at((static_cast<float>(x) + 0.5f) / kFine, (static_cast<float>(y) + 0.5f) / kFine);
      ++cells[unit.id];
      ASSERT_GE(unit.edge, -1e-5f);
      ASSERT_GE(std::min(unit.x, unit.y), -1e-4f);
      ASSERT_LE(std::max(unit.x, unit.y), 1 + 1e-4f);
      units.push_back(unit);
    }
  EXPECT_EQ(cells.size(), static_cast<size_t>(GetParam().units));
  const double mean = static_cast<double>(kFine) * kFine / GetParam().units;
  for (const auto& [id, count] : cells) EXPECT_NEAR(count, mean, 0.16 * mean + 8);
  // A neighbour texel of another unit is nearer than a texel and a half: the wrap-around included.
  const float texel = GetParam().tile / kFine;
  for (int y = 0; y < kFine; ++y)
    for (int x = 0; x < kFine; ++x) {
      const Unit &a = units[static_cast<size_t>(y * kFine + x)], &b = units[static_cast<size_t>(y * kFine + (x + 1) % kFine)];
      if (a.id != b.id) {
        ASSERT_LT(std::min(a.edge, b.edge), 1.5f * texel);
      }
    }
}

class EveryPeriod : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Textures, EveryPeriod, testing::Values(1, 2, 3, 8, 17));

TEST_P(EveryPeriod, NoiseStaysWithinItsRangeAndCloses) {
  const int period = GetParam();
  for (uint32_t seed : {1u, 99u}) {
    for (int i = 0; i < 400; ++i) {
      const float x = 0.173f * static_cast<float>(i), y = 0.719f * static_cast<float>(i % 37), p = static_cast<float>(period);
      const float noise = TilingNoise(seed, x, y, period);
      EXPECT_LE(std::abs(noise), 1);
      EXPECT_NEAR(noise, TilingNoise(seed, x + p, y, period), 1e-3);
      const float u = x / p - std::floor(x / p), v = y / p - std::floor(y / p);
      EXPECT_LE(std::abs(TilingFbm(seed, u, v, period, 5)), 1.6f);
      const WorleyResult cell = TilingWorley(seed, u, v, period);
      EXPECT_GE(cell.first, 0);
      EXPECT_GE(cell.second, cell.first);
      EXPECT_LE(cell.first, 1.42f);
    }
    // Across the border, as far as between any two neighbours.
    for (int i = 0; i < 50; ++i) {
      const float v = (static_cast<float>(i) + 0.5f) / 50, e = 1e-3f / static_cast<float>(period);
      EXPECT_NEAR(TilingFbm(seed, 0, v, period, 3), TilingFbm(seed, 1 - e, v, period, 3), 0.02);
      EXPECT_NEAR(TilingWorley(seed, 0, v, period).first, TilingWorley(seed, 1 - e, v, period).first, 0.02);
      EXPECT_NEAR(TilingWorley(seed, v, 0, period).first, TilingWorley(seed, v, 1 - e, period).first, 0.02);
    }
  }
}

TEST_P(EveryPeriod, FieldsAreStandardAndRepeatable) {
  for (int cells_y : {GetParam(), 2 * GetParam()}) {
    Field field = FractalField(256, 7, GetParam(), cells_y, 4);
    double sum = 0, squares = 0;
    for (float v : field.values) sum += static_cast<double>(v), squares += static_cast<double>(v * v);
    EXPECT_NEAR(sum / 65536, 0, 1e-3);
    EXPECT_NEAR(squares / 65536, 1, 1e-2);
    EXPECT_EQ(field.values, FractalField(256, 7, GetParam(), cells_y, 4).values);
    EXPECT_NE(field.values, FractalField(256, 8, GetParam(), cells_y, 4).values);
  }
}

TEST(HashUnit, IsUniform) {
  std::vector<int> bins(16, 0);
  for (uint32_t a = 0; a < 64; ++a)
    for (uint32_t b = 0; b < 64; ++b) {
      const float x = HashUnit(a, b, 3);
      ASSERT_GE(x, 0);
      ASSERT_LT(x, 1);
      ++bins[static_cast<size_t>(16 * x)];
    }
  double chi = 0;
  for (int count : bins) chi += (count - 256.0) * (count - 256.0) / 256;
  EXPECT_LT(chi, 37.7);  // 15 degrees of freedom, 0.1 %
}

}  // namespace
}  // namespace airsim360::internal

#include "airsim360/scene/category_colors.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace airsim360 {
namespace {

int Difference(Rgb8 a, Rgb8 b) { return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b); }

TEST(CategoryColors, EveryBuiltInCategoryHasAColourOfItsOwn) {
  const SemanticTree tree;
  const auto& palette = CategoryPalette();
  EXPECT_EQ(palette[kVoid], Rgb8{});
  for (const auto& [a, first] : tree.categories()) {
    EXPECT_GE(Difference(palette[a], Rgb8{}), 20) << first.path;
    for (const auto& [b, second] : tree.categories()) {
      if (a >= b) continue;
      EXPECT_GE(Difference(palette[a], palette[b]), 20) << first.path << " " << second.path;
    }
  }
  for (size_t id = tree.categories().size() + 1; id < palette.size(); ++id) EXPECT_EQ(palette[id], Rgb8{});
}

TEST(CategoryColors, ClassesOfCityscapesHaveItsColours) {
  const SemanticTree tree;
  EXPECT_EQ(CategoryColor(tree, tree.At("human/person")), (Rgb8{220, 20, 60}));
  EXPECT_EQ(CategoryColor(tree, tree.At("ground/road")), (Rgb8{128, 64, 128}));
}

TEST(CategoryColors, CustomCategoriesAreOfTheirFamily) {
  SemanticTree tree;
  const Rgb8 shrub = CategoryColor(tree, tree.Add("vegetation/shrub/fern"));
  EXPECT_TRUE(shrub.g > shrub.r && shrub.g > shrub.b);
  EXPECT_NE(CategoryColor(tree, tree.Add("robot/arm")), Rgb8{});
}

}  // namespace
}  // namespace airsim360

#include "airsim360/image/draw.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "airsim360/base/error.h"
#include "airsim360/image/color.h"

namespace airsim360 {
namespace {

constexpr Rgb8 kBlack{0, 0, 0}, kWhite{255, 255, 255};

int CountWhite(const Image<Rgb8>& canvas) {
  int count = 0;
  for (Rgb8 p : canvas.pixels()) count += p == kWhite;
  return count;
}

TEST(Draw, BlitAndRectanglesAreClippedAtTheCanvas) {
  Image<Rgb8> canvas(4, 3);
  Blit(Image<Rgb8>(3, 3, kWhite), -2, 1, canvas);
  EXPECT_EQ(CountWhite(canvas), 2);
  EXPECT_EQ(canvas(0, 1), kWhite);
  EXPECT_EQ(canvas(0, 2), kWhite);
  Blit(Image<Rgb8>(3, 3, kWhite), 4, 0, canvas);
  Blit(Image<Rgb8>(3, 3, kWhite), -9, -9, canvas);
  EXPECT_EQ(CountWhite(canvas), 2);
  FillRectangle(2, -5, 99, 6, kWhite, canvas);
  EXPECT_EQ(CountWhite(canvas), 4);
}

TEST(Draw, ResizingAveragesLightNotCodeValues) {
  Image<Rgb8> checker(2, 1);
  checker(1, 0) = kWhite;
  EXPECT_EQ(ResizeBox(checker, 1, 1)(0, 0).g, LinearToSrgb8(0.5f));  // 188, not 128
}

TEST(Draw, ResizingKeepsAConstantPictureAndTheSameSize) {
  const Rgb8 color{17, 130, 240};
  EXPECT_EQ(ResizeBox(Image<Rgb8>(7, 5, color), 3, 11), Image<Rgb8>(3, 11, color));
  Image<Rgb8> ramp(256, 2);
  for (int x = 0; x < 256; ++x) ramp(x, 0) = ramp(x, 1) = {static_cast<uint8_t>(x), 0, 255};
  EXPECT_EQ(ResizeBox(ramp, 256, 2), ramp);
  EXPECT_THROW(ResizeBox(ramp, 0, 2), InputError);
}

TEST(Draw, PartsOfPixelsCountAsParts) {
  // Three pixels to two: the first takes pixel 0 whole and half of pixel 1.
  Image<Rgb8> line(3, 1);
  line(1, 0) = kWhite;
  EXPECT_EQ(ResizeBox(line, 2, 1)(0, 0).r, LinearToSrgb8(1.0f / 3));
}

TEST(Draw, TheColourScaleGetsSteadilyLighter) {
  const auto luminance = [](Rgb8 c) { return 0.2126 * SrgbToLinear(c.r) + 0.7152 * SrgbToLinear(c.g) + 0.0722 * SrgbToLinear(c.b); };
  for (int i = 1; i < 256; ++i) {
    EXPECT_GT(luminance(ScaleColor(i / 255.0)) + 1e-3, luminance(ScaleColor((i - 1) / 255.0))) << i;
  }
  EXPECT_GT(luminance(ScaleColor(1)) - luminance(ScaleColor(0)), 0.6);
  EXPECT_EQ(ScaleColor(-3), ScaleColor(0));
  EXPECT_EQ(ScaleColor(7), ScaleColor(1));
  EXPECT_EQ(ScaleColor(std::numeric_limits<double>::quiet_NaN()), ScaleColor(0));
}

TEST(Draw, TheLogScaleIsEvenInRatios) {
  EXPECT_DOUBLE_EQ(LogScale(10, 1, 100), 0.5);
  EXPECT_EQ(LogScale(0, 1, 100), 0);
  EXPECT_EQ(LogScale(1e9, 1, 100), 1);
  EXPECT_EQ(LogScale(std::numeric_limits<double>::quiet_NaN(), 1, 100), 0);
  EXPECT_THROW(LogScale(1, 0, 100), InputError);
}

TEST(Draw, NeighbouringIdsHaveClearlyDifferentColours) {
  EXPECT_EQ(IdColor(0), kBlack);
  std::set<std::tuple<int, int, int>> colors;
  for (uint32_t id = 1; id <= 1000; ++id) {
    const Rgb8 a = IdColor(id), b = IdColor(id + 1);
    colors.insert({a.r, a.g, a.b});
    EXPECT_GT(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b), 40) << id;
  }
  EXPECT_GT(colors.size(), 990u);
}

TEST(Draw, EveryLetterIsDifferentAndScalesExactly) {
  std::set<std::vector<bool>> shapes;
  for (char c = 32; c < 127; ++c) {
    Image<Rgb8> small(kGlyphCellWidth, kGlyphCellHeight), large(3 * kGlyphCellWidth, 3 * kGlyphCellHeight);
    DrawText(std::string_view(&c, 1), 0, 0, kWhite, 1, small);
    DrawText(std::string_view(&c, 1), 0, 0, kWhite, 3, large);
    std::vector<bool> shape;
    for (Rgb8 p : small.pixels()) shape.push_back(p == kWhite);
    shapes.insert(shape);
    EXPECT_EQ(CountWhite(large), 9 * CountWhite(small));
    // The spare column and row of the cell stay empty.
    for (int y = 0; y < kGlyphCellHeight; ++y) EXPECT_EQ(small(kGlyphCellWidth - 1, y), kBlack);
    for (int x = 0; x < kGlyphCellWidth; ++x) EXPECT_EQ(small(x, kGlyphCellHeight - 1), kBlack);
  }
  EXPECT_EQ(shapes.size(), 95u);
}

TEST(Draw, BytesOutsideTheFontShowAsQuestionMarks) {
  Image<Rgb8> a(12, 8), b(12, 8);
  DrawText("\xc3\x7f", 0, 0, kWhite, 1, a);
  DrawText("??", 0, 0, kWhite, 1, b);
  EXPECT_EQ(a, b);
  EXPECT_EQ(TextWidth("??", 2), 24);
}

}  // namespace
}  // namespace airsim360

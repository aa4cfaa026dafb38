#include "airsim360/eval/coco/mask.h"

#include <gtest/gtest.h>

#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/eval/sphere/pixel_view.h"

namespace airsim360 {
namespace {

constexpr int kWidth = 23, kHeight = 17;

std::vector<uint8_t> RandomPixels(uint64_t id) {
  RngStream random(7, "mask", id);
  std::vector<uint8_t> pixels(kWidth * kHeight);
  for (uint8_t& p : pixels) p = random.Chance(0.4);
  return pixels;
}

TEST(RleMask, DecodesWhatWasEncodedAlsoAsText) {
  for (uint64_t i = 0; i < 20; ++i) {
    const auto pixels = RandomPixels(i);
    const RleMask mask = EncodeMask(pixels, kWidth, kHeight);
    EXPECT_EQ(DecodeMask(mask), pixels);
    EXPECT_EQ(ParseCompressedRle(CompressRle(mask), kWidth, kHeight), mask);
  }
}

TEST(RleMask, AreasAndBoxesCountPixels) {
  const auto a = RandomPixels(1), b = RandomPixels(2);
  uint64_t area = 0, shared = 0, either = 0;
  for (size_t i = 0; i < a.size(); ++i) area += a[i], shared += a[i] && b[i], either += a[i] || b[i];
  const RleMask ma = EncodeMask(a, kWidth, kHeight), mb = EncodeMask(b, kWidth, kHeight);
  EXPECT_EQ(MaskArea(ma), area);
  EXPECT_EQ(SharedArea(ma, mb), shared);
  EXPECT_EQ(MaskArea(UniteMasks(std::vector<RleMask>{ma, mb})), either);
  std::vector<uint8_t> one(kWidth * kHeight, 0);
  for (int y = 3; y < 9; ++y) one[static_cast<size_t>(y) * kWidth + 5] = one[static_cast<size_t>(y) * kWidth + 6] = 1;
  EXPECT_EQ(MaskBox(EncodeMask(one, kWidth, kHeight)), (std::array<double, 4>{5, 3, 2, 6}));
  EXPECT_EQ(MaskBox(EncodeMask(std::vector<uint8_t>(kWidth * kHeight, 0), kWidth, kHeight)), (std::array<double, 4>{0, 0, 0, 0}));
}

TEST(RleMask, WeighedAreasOfAWholePanoramaAreFourPi) {
  const RowSums sums(RowWeights(16, 32, PixelWeight::kSolidAngle));
  const RleMask all = EncodeMask(std::vector<uint8_t>(512, 1), 32, 16);
  EXPECT_NEAR(WeighedArea(all, sums), 4 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(WeighedSharedArea(all, all, sums), 4 * std::numbers::pi, 1e-12);
}

TEST(Polygons, CoverThePixelsThatCocosToolsSay) {
  // Golden: run lengths that pycocotools 2.0 gives. They protect the rule of which pixels an edge takes.
  const std::vector<double> oblique = {1.2, 0.6, 9.4, 2.1, 7.7, 8.9, 2.3, 6.5}, outside = {-3, -2, 5, 4.5, 20, 1, 6.5, 6.5},
                            twice = {2, 2, 2, 2, 6, 2, 6, 5, 2, 5};
  EXPECT_EQ(CompressRle(RasterizePolygon(oblique, 12, 10)), ";195K000010O01OMo0");
  EXPECT_EQ(CompressRle(RasterizePolygon(outside, 12, 8)), "b018000O1O00000O01000M");
  EXPECT_EQ(CompressRle(RasterizePolygon(twice, 8, 7)), "`03400000<");
  EXPECT_EQ(MaskArea(RasterizeBox({2, 3, 5, 4}, 12, 10)), 20u);
}

TEST(RleMask, DamageIsRefused) {
  EXPECT_THROW(ParseCompressedRle("PP", 4, 4), InputError);
  EXPECT_THROW(ParseCompressedRle("\x7f", 4, 4), InputError);
  EXPECT_THROW(ParseCompressedRle("oooooooooooooooooooo", 4, 4), InputError);
  EXPECT_THROW(CheckMask({4, 4, {3, 4}}), InputError);
  EXPECT_THROW(CheckMask({4000000000u, 4000000000u, {3, 4}}), InputError);
  EXPECT_THROW(RasterizePolygon(std::vector<double>{0, 0, 1e9, 1}, 4, 4), InputError);
  EXPECT_THROW(SharedArea(EncodeMask(std::vector<uint8_t>(4, 1), 2, 2), EncodeMask(std::vector<uint8_t>(4, 1), 4, 1)), InputError);
}

}  // namespace
}  // namespace airsim360

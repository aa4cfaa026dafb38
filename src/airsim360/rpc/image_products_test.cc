#include "airsim360/rpc/image_products.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/rpc/detections.h"
#include "airsim360/rpc/segmentation_palette.h"

namespace airsim360 {
namespace {

// Compared with the compiler's own half type.
TEST(ImageProducts, HalvesAreRoundedToTheNearest) {
  for (float value = 0.01f; value < 60000; value *= 1.0037f) {
    EXPECT_EQ(RoundToHalf(value), static_cast<float>(static_cast<_Float16>(value))) << value;
  }
  EXPECT_EQ(RoundToHalf(1e9f), 65504);
  EXPECT_EQ(RoundToHalf(65519.9f), 65504);
}

Frame TinyFrame() {
  Frame frame;
  frame.range = Image<float>(4, 2, 10.0f);
  frame.range(3, 1) = 0;
  frame.entity = Image<EntityId>(4, 2, 2);
  frame.rgb = Image<Rgb8>(4, 2, Rgb8{1, 2, 3});
  return frame;
}

TEST(ImageProducts, BytesAreBlueGreenRed) {
  const Frame frame = TinyFrame();
  const Camera camera = PinholeOf({4, 2, 90});
  const std::string bytes = BgrPixelsOf(ImageContent::kColor, frame, camera, {});
  ASSERT_EQ(bytes.size(), 24u);
  EXPECT_EQ(bytes.substr(0, 3), std::string("\3\2\1"));
  const std::vector<uint32_t> ids = {0, 5, 1};
  const std::string labels = BgrPixelsOf(ImageContent::kSegmentation, frame, camera, {.segmentation = &ids});
  EXPECT_EQ(static_cast<uint8_t>(labels[0]), kSegmentationPalette[1].b);
  EXPECT_EQ(static_cast<uint8_t>(labels[2]), kSegmentationPalette[1].r);
}

TEST(ImageProducts, DepthIsRangeTimesTheCosine) {
  const Frame frame = TinyFrame();
  const Camera camera = PinholeOf({4, 2, 90});  // fx = 2
  const auto planar = FloatPixelsOf(ImageContent::kPlanarDepth, frame, camera, {.half_depth = false});
  EXPECT_NEAR(planar[0], 10 / std::sqrt(1 + 0.75 * 0.75 + 0.25 * 0.25), 1e-5);
  EXPECT_EQ(planar[7], kSkyDepth);
  const auto range = FloatPixelsOf(ImageContent::kRange, frame, camera, {.half_depth = false});
  EXPECT_EQ(range[0], 10);
  const std::string centimetres = BgrPixelsOf(ImageContent::kRange, frame, camera, {.centimetres = true});
  EXPECT_EQ(static_cast<uint8_t>(centimetres[0]), 255);
}

TEST(Palette, IdsHaveColoursOfTheirOwn) {
  std::vector<Rgb8> seen;
  for (uint32_t id = 0; id < 256; ++id) {
    for (const Rgb8& other : seen) EXPECT_FALSE(SegmentationColor(id) == other) << id;
    seen.push_back(SegmentationColor(id));
  }
  EXPECT_EQ(SegmentationColor(0x123456), (Rgb8{0x56, 0x34, 0x12}));
}

TEST(Wildcards, StarsAndQuestionMarks) {
  EXPECT_TRUE(MatchesWildcard("Cylinder*", "Cylinder_12"));
  EXPECT_TRUE(MatchesWildcard("*", ""));
  EXPECT_TRUE(MatchesWildcard("*a*b*", "xxayybzz"));
  EXPECT_TRUE(MatchesWildcard("a?c", "abc"));
  EXPECT_FALSE(MatchesWildcard("a?c", "ac"));
  EXPECT_FALSE(MatchesWildcard("Cylinder", "Cylinder_12"));
  EXPECT_FALSE(MatchesWildcard("", "x"));
  // Many stars do not take for ever.
  EXPECT_FALSE(MatchesWildcard(std::string(30, '*') + "b", std::string(5000, 'a')));
}

}  // namespace
}  // namespace airsim360

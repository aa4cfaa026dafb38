#include "airsim360/rpc/images/image_products.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "airsim360/rpc/images/segmentation_palette.h"

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

std::shared_ptr<char[]> Fresh(size_t size) { return std::shared_ptr<char[]>(new char[size]); }

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
  const TakeBytes pool = Fresh;
  const WireBlock block = BytePixelsOf(ImageContent::kColor, frame, camera, {}, pool);
  const std::string_view bytes = block.view();
  ASSERT_EQ(bytes.size(), 24u);
  for (size_t i = 0; i < 24; i += 3) EXPECT_EQ(bytes.substr(i, 3), std::string_view("\3\2\1"));
  const WireBlock entities = BytePixelsOf(ImageContent::kEntity, frame, camera, {}, pool);
  EXPECT_EQ(entities.view().substr(0, 6), std::string_view("\0\0\2\0\0\2", 6));
  EXPECT_EQ(entities.view().substr(21, 3), std::string_view("\0\0\2", 3));
  const std::vector<uint32_t> ids = {0, 5, 1};
  const WireBlock labels = BytePixelsOf(ImageContent::kSegmentation, frame, camera, {.segmentation = &ids}, pool);
  EXPECT_EQ(static_cast<uint8_t>(labels.view()[0]), kSegmentationPalette[1].b);
  EXPECT_EQ(static_cast<uint8_t>(labels.view()[2]), kSegmentationPalette[1].r);

  // The other order is each pixel turned round.
  for (const ImageContent content : {ImageContent::kColor, ImageContent::kEntity, ImageContent::kSegmentation}) {
    const WireBlock bgr = BytePixelsOf(content, frame, camera, {.segmentation = &ids}, pool);
    const WireBlock rgb = BytePixelsOf(content, frame, camera, {.rgb_order = true, .segmentation = &ids}, pool);
    ASSERT_EQ(rgb.size(), bgr.size());
    for (size_t i = 0; i < rgb.size(); ++i) EXPECT_EQ(rgb.view()[i], bgr.view()[i / 3 * 3 + 2 - i % 3]);
  }
}

TEST(ImageProducts, DepthIsRangeTimesTheCosine) {
  const Frame frame = TinyFrame();
  const Camera camera = PinholeOf({4, 2, 90});  // fx = 2
  const auto planar = FloatPixelsOf(ImageContent::kPlanarDepth, frame, camera, {.half_depth = false});
  EXPECT_NEAR(planar[0], 10 / std::sqrt(1 + 0.75 * 0.75 + 0.25 * 0.25), 1e-5);
  EXPECT_EQ(planar[7], kSkyDepth);
  const auto range = FloatPixelsOf(ImageContent::kRange, frame, camera, {.half_depth = false});
  EXPECT_EQ(range[0], 10);
  const TakeBytes pool = Fresh;
  const WireBlock centimetres = BytePixelsOf(ImageContent::kRange, frame, camera, {.centimetres = true}, pool);
  EXPECT_EQ(static_cast<uint8_t>(centimetres.view()[0]), 255);
}

TEST(ImageProducts, FloatsOnTheWireAreTheFloatsOfTheImage) {
  const Frame frame = TinyFrame();
  const Camera camera = PinholeOf({4, 2, 90});
  const TakeBytes pool = Fresh;
  const auto expected = FloatPixelsOf(ImageContent::kPlanarDepth, frame, camera, {});
  const auto stock = FloatBytesOf(ImageContent::kPlanarDepth, frame, camera, {}, false, pool);
  const auto ours = FloatBytesOf(ImageContent::kPlanarDepth, frame, camera, {}, true, pool);
  WireWriter writer;
  ToWire(writer, stock);
  std::string bytes;
  for (const WireBlock& block : writer.Take()) bytes += block.view();
  const WireValue value = DecodeWire({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
  ASSERT_EQ(value.items.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(static_cast<float>(value.items[i].real), expected[i]);
  ASSERT_EQ(ours.bytes.size(), expected.size() * sizeof(float));
  EXPECT_EQ(std::memcmp(ours.bytes.data(), expected.data(), ours.bytes.size()), 0);
}

// Rows of all lengths around those that whole vectors fill, each with a guard behind it.
TEST(ImageProducts, EveryPixelOfARowIsSwappedAndNothingBehindIt) {
  for (int width = 1; width < 50; ++width) {
    Frame frame;
    frame.rgb = Image<Rgb8>(width, 1);
    frame.entity = Image<EntityId>(width, 1);
    for (int x = 0; x < width; ++x) {
      const auto v = static_cast<uint8_t>(3 * x);
      frame.rgb(x, 0) = {v, static_cast<uint8_t>(v + 1), static_cast<uint8_t>(v + 2)};
      frame.entity(x, 0) = 0x40000000u + 0x10203u * static_cast<uint32_t>(x);
    }
    const size_t size = 3 * static_cast<size_t>(width);
    const TakeBytes guarded = [&](size_t) {
      auto bytes = Fresh(size + 16);
      std::memset(bytes.get(), 0x55, size + 16);
      return bytes;
    };
    const Camera camera = PinholeOf({width, 1, 90});
    for (const ImageContent content : {ImageContent::kColor, ImageContent::kEntity}) {
      const WireBlock block = BytePixelsOf(content, frame, camera, {}, guarded);
      for (int x = 0; x < width; ++x) {
        const EntityId id = frame.entity(x, 0);
        const Rgb8 c = content == ImageContent::kColor
                           ? frame.rgb(x, 0)
                           : Rgb8{static_cast<uint8_t>(id), static_cast<uint8_t>(id >> 8), static_cast<uint8_t>(id >> 16)};
        const uint8_t expected[] = {c.b, c.g, c.r};
        ASSERT_EQ(std::memcmp(block.data() + 3 * x, expected, 3), 0) << width << " " << x;
      }
      for (size_t i = size; i < size + 16; ++i) ASSERT_EQ(block.data()[i], 0x55) << width;
    }
  }
}

TEST(BlockPool, MemoryIsUsedAgainOnceItsLastHolderHasLetGo) {
  BlockPool pool;
  constexpr size_t kSize = size_t{1} << 20;
  std::shared_ptr<char[]> first = pool.Take(kSize);
  const char* place = first.get();
  WireBlock held(first, kSize);
  first.reset();
  EXPECT_NE(pool.Take(kSize).get(), place);  // still held
  held = {};
  const auto a = pool.Take(kSize), b = pool.Take(kSize);
  EXPECT_TRUE(a.get() == place || b.get() == place);
}

TEST(Palette, IdsHaveColoursOfTheirOwn) {
  std::vector<Rgb8> seen;
  for (uint32_t id = 0; id < 256; ++id) {
    for (const Rgb8& other : seen) EXPECT_FALSE(SegmentationColor(id) == other) << id;
    seen.push_back(SegmentationColor(id));
  }
  EXPECT_EQ(SegmentationColor(0x123456), (Rgb8{0x56, 0x34, 0x12}));
}

}  // namespace
}  // namespace airsim360

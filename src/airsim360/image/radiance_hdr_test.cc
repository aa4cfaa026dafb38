#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs.h"

namespace airsim360 {
namespace {

Bytes BytesOf(const std::string& text) {
  const auto* p = reinterpret_cast<const std::byte*>(text.data());
  return Bytes(p, p + text.size());
}

std::string Header(int width, int height, const std::string& more = "") {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n" + more + "\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
}

std::string Pixel(int r, int g, int b, int e) {
  return {static_cast<char>(r), static_cast<char>(g), static_cast<char>(b), static_cast<char>(e)};
}

TEST(RadianceHdr, ReadsFlatPixelsAsMantissaTimesPowerOfTwo) {
  const auto image = DecodeRadianceHdr(BytesOf(Header(2, 1) + Pixel(128, 64, 255, 129) + Pixel(9, 9, 9, 0)), "t");
  ASSERT_EQ(image.width(), 2);
  EXPECT_EQ(image(0, 0), (Rgb32f{1.0f, 0.5f, 255 / 128.0f}));
  EXPECT_EQ(image(1, 0), (Rgb32f{0, 0, 0}));
}

TEST(RadianceHdr, ReadsPackedRowsOfRunsAndLiterals) {
  std::string data = Header(8, 2);
  for (int y = 0; y < 2; ++y) {
    data += Pixel(2, 2, 0, 8);
    data += std::string("\x88\x40", 2);                       // r: eight times 64
    data += std::string("\x03\x01\x02\x03\x85\x80", 6);       // g: 1 2 3, then five times 128
    data += std::string("\x08", 1) + std::string(8, '\x20');  // b: eight literals
    data += std::string("\x88\x81", 2);                       // e: 129
  }
  const auto image = DecodeRadianceHdr(BytesOf(data), "t");
  EXPECT_EQ(image(7, 1), (Rgb32f{0.5f, 1.0f, 0.25f}));
  EXPECT_EQ(image(1, 0).g, 2 / 128.0f);
}

TEST(RadianceHdr, ReadsOldRunsAndUndoesTheExposure) {
  const auto image =
      DecodeRadianceHdr(BytesOf(Header(4, 1, "EXPOSURE= 4\nEXPOSURE=0.5\n") + Pixel(128, 128, 128, 129) + Pixel(1, 1, 1, 3)), "t");
  for (int x = 0; x < 4; ++x) EXPECT_EQ(image(x, 0).g, 0.5f) << x;
}

TEST(RadianceHdr, RefusesDamage) {
  const std::string good = Header(8, 1) + Pixel(2, 2, 0, 8) + std::string("\x88\x40\x88\x40\x88\x40\x88\x81", 8);
  EXPECT_NO_THROW(DecodeRadianceHdr(BytesOf(good), "t"));
  for (size_t n = 0; n < good.size(); ++n) EXPECT_THROW(DecodeRadianceHdr(BytesOf(good.substr(0, n)), "t"), InputError) << n;
  EXPECT_THROW(DecodeRadianceHdr(BytesOf(Header(8, 1) + Pixel(2, 2, 0, 8) + "\x89\x40"), "t"), InputError);
  EXPECT_THROW(DecodeRadianceHdr(BytesOf(Header(65000, 65000) + std::string(300000, 'x')), "t"), InputError);
  EXPECT_THROW(DecodeRadianceHdr(BytesOf(Header(2, 1) + Pixel(1, 1, 1, 2)), "t"), InputError);
}

TEST(ExrRgb, ComesBackExactlyAndOneChannelAsGrey) {
  Image<Rgb32f> image(5, 3);
  for (int i = 0; i < 15; ++i) image.pixels()[static_cast<size_t>(i)] = {0.1f * static_cast<float>(i), 1e5f, -2.0f};
  EXPECT_EQ(DecodeExrRgb(EncodeExr(image), "t"), image);
  Image<float> grey(2, 1);
  grey(1, 0) = 7;
  EXPECT_EQ(DecodeExrRgb(EncodeExr(grey), "t")(1, 0), (Rgb32f{7, 7, 7}));
}

}  // namespace
}  // namespace airsim360

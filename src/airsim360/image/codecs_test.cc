#include "airsim360/image/codecs.h"

#include <gtest/gtest.h>
#include <webp/encode.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

// Odd sizes on purpose: strides, last partial JPEG blocks and EXR chunks of 16 lines.
constexpr std::pair<int, int> kSizes[] = {{1, 1}, {1, 7}, {7, 1}, {13, 5}, {64, 33}, {257, 40}};

template <class Pixel, class Draw>
Image<Pixel> Filled(int width, int height, Draw draw) {
  Image<Pixel> image(width, height);
  for (auto& pixel : image.pixels()) pixel = draw();
  return image;
}

Image<Rgb8> SmoothPicture(int width, int height) {
  Image<Rgb8> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y) = {static_cast<uint8_t>(128 + 100 * std::sin(x * 0.05)), static_cast<uint8_t>(128 + 100 * std::cos(y * 0.07)),
                     static_cast<uint8_t>((x + y) / 2 % 256)};
    }
  }
  return image;
}

TEST(Png, EveryKindComesBackExactlyAtOddSizes) {
  RngStream rng(1, "png");
  for (const auto& [w, h] : kSizes) {
    const auto rgb = Filled<Rgb8>(w, h, [&] {
      const uint64_t b = rng.Bits();
      return Rgb8{static_cast<uint8_t>(b), static_cast<uint8_t>(b >> 8), static_cast<uint8_t>(b >> 16)};
    });
    const auto rgba = DecodeRgba8(EncodePng(rgb), "rgb");
    ASSERT_EQ(std::pair(rgba.width(), rgba.height()), std::pair(w, h));
    for (size_t i = 0; i < rgb.size(); ++i) {
      const Rgb8 p = rgb.pixels()[i];
      EXPECT_EQ(rgba.pixels()[i], (Rgba8{p.r, p.g, p.b, 255}));
    }

    const auto wide = Filled<Rgb16>(w, h, [&] {
      const uint64_t b = rng.Bits();
      return Rgb16{static_cast<uint16_t>(b), static_cast<uint16_t>(b >> 16), static_cast<uint16_t>(b >> 32)};
    });
    EXPECT_EQ(DecodeRgb16Png(EncodePng(wide), "rgb16"), wide);

    const auto gray = Filled<uint8_t>(w, h, [&] { return static_cast<uint8_t>(rng.Bits()); });
    const auto gray_back = DecodeGrayPng(EncodePng(gray), "gray");
    ASSERT_EQ(gray_back.size(), gray.size());
    for (size_t i = 0; i < gray.size(); ++i) EXPECT_EQ(gray_back.pixels()[i], gray.pixels()[i]);

    const auto gray16 = Filled<uint16_t>(w, h, [&] { return static_cast<uint16_t>(rng.Bits()); });
    EXPECT_EQ(DecodeGrayPng(EncodePng(gray16), "gray16"), gray16);

    const auto ids = Filled<uint32_t>(w, h, [&] { return static_cast<uint32_t>(rng.Bits() & 0xffffff); });
    EXPECT_EQ(DecodeIdPng(EncodeIdPng(ids), "ids"), ids);
  }
}

TEST(Png, LabelsWithLongRunsComeBackExactly) {
  Image<uint32_t> ids(2048, 64, 7);
  for (int x = 300; x < 900; ++x) ids(x, 20) = 0xffffff;
  EXPECT_EQ(DecodeIdPng(EncodeIdPng(ids), "ids"), ids);
}

TEST(Png, AnIdOf24BitsFitsAndTheNextOneIsRefused) {
  Image<uint32_t> ids(2, 1, 0xffffff);
  EXPECT_EQ(DecodeIdPng(EncodeIdPng(ids), "ids"), ids);
  ids(1, 0) = 1u << 24;
  EXPECT_THROW(EncodeIdPng(ids), InputError);
}

TEST(Png, EightBitColourIsScaledTo16BitsAnd8BitGrayIsNot) {
  const auto wide = DecodeRgb16Png(EncodePng(Image<Rgb8>(1, 1, {1, 128, 255})), "x");
  EXPECT_EQ(wide(0, 0), (Rgb16{257, 128 * 257, 65535}));
  EXPECT_EQ(DecodeGrayPng(EncodePng(Image<uint8_t>(1, 1, 200)), "x")(0, 0), 200);
}

TEST(Png, TheWrongKindIsAnErrorThatNamesTheFile) {
  const Bytes colour = EncodePng(Image<Rgb8>(2, 2)), gray = EncodePng(Image<uint8_t>(2, 2));
  EXPECT_THROW(DecodeGrayPng(colour, "a.png"), InputError);
  EXPECT_THROW(DecodeIdPng(gray, "a.png"), InputError);
  EXPECT_THROW(DecodeIdPng(EncodePng(Image<Rgb16>(2, 2)), "a.png"), InputError);
}

TEST(Png, TheKindIsReadFromTheHeader) {
  const auto kind = [](const Bytes& png) {
    const PngKind k = ReadPngKind(png, "x");
    return std::pair(k.channels, k.bit_depth);
  };
  EXPECT_EQ(kind(EncodePng(Image<uint8_t>(2, 2))), std::pair(1, 8));
  EXPECT_EQ(kind(EncodePng(Image<uint16_t>(2, 2))), std::pair(1, 16));
  EXPECT_EQ(kind(EncodePng(Image<Rgb8>(2, 2))), std::pair(3, 8));
  EXPECT_EQ(kind(EncodePng(Image<Rgb16>(2, 2))), std::pair(3, 16));
}

// Types of the chunks of a PNG in order.
std::vector<std::string> ChunkTypes(const Bytes& png) {
  std::vector<std::string> types;
  for (size_t at = 8; at + 12 <= png.size();) {
    uint32_t length = 0;
    for (int i = 0; i < 4; ++i) length = length << 8 | static_cast<uint32_t>(png[at + i]);
    types.emplace_back(AsText(std::span(png).subspan(at + 4, 4)));
    at += 12 + length;
  }
  return types;
}

TEST(Png, HoldsNothingButPixelsAndTheGPanoPacketBeforeThem) {
  const Image<Rgb8> image(8, 4);
  EXPECT_EQ(ChunkTypes(EncodePng(image)), (std::vector<std::string>{"IHDR", "IDAT", "IEND"}));
  EXPECT_EQ(ChunkTypes(EncodePng(image, GPano{})), (std::vector<std::string>{"IHDR", "iTXt", "IDAT", "IEND"}));
}

TEST(GPano, ThePacketIsInPngAndJpegWithSizeAndPose) {
  using std::string_literals::operator""s;
  const auto image = SmoothPicture(64, 32);
  const GPano pose{-90.25, -3.5, 4};  // heading is written as a compass bearing
  const Bytes png = EncodePng(image, pose), jpeg = EncodeJpeg(image, 90, pose);
  EXPECT_NE(AsText(png).find("iTXtXML:com.adobe.xmp\0\0\0\0\0<?xpacket"s), std::string_view::npos);
  EXPECT_NE(AsText(jpeg).find("http://ns.adobe.com/xap/1.0/\0<?xpacket"s), std::string_view::npos);
  for (const Bytes& bytes : {png, jpeg}) {
    for (const char* property :
         {"<GPano:UsePanoramaViewer>True<", "<GPano:ProjectionType>equirectangular<", "<GPano:FullPanoWidthPixels>64<",
          "<GPano:FullPanoHeightPixels>32<", "<GPano:CroppedAreaImageWidthPixels>64<", "<GPano:CroppedAreaImageHeightPixels>32<",
          "<GPano:CroppedAreaLeftPixels>0<", "<GPano:CroppedAreaTopPixels>0<", "<GPano:PoseHeadingDegrees>269.75<",
          "<GPano:PosePitchDegrees>-3.5<", "<GPano:PoseRollDegrees>4<"}) {
      EXPECT_NE(AsText(bytes).find(property), std::string_view::npos) << property;
    }
  }
  EXPECT_EQ(DecodeRgba8(png, "png"), DecodeRgba8(EncodePng(image), "png"));
  EXPECT_EQ(DecodeRgba8(jpeg, "jpeg"), DecodeRgba8(EncodeJpeg(image, 90), "jpeg"));
  EXPECT_THROW(EncodePng(image, GPano{std::nan("")}), InputError);
}

TEST(Jpeg, ComesBackWithinTheErrorOfItsQualityAtOddSizes) {
  for (const auto& [w, h] : kSizes) {
    const auto image = SmoothPicture(w, h);
    const auto back = DecodeRgba8(EncodeJpeg(image, 98), "jpeg");
    ASSERT_EQ(std::pair(back.width(), back.height()), std::pair(w, h));
    for (size_t i = 0; i < image.size(); ++i) {
      const Rgb8 a = image.pixels()[i];
      const Rgba8 b = back.pixels()[i];
      EXPECT_NEAR(a.r, b.r, 9);
      EXPECT_NEAR(a.g, b.g, 9);
      EXPECT_NEAR(a.b, b.b, 9);
      EXPECT_EQ(b.a, 255);
    }
  }
}

TEST(Jpeg, QualityOutsideOneToHundredIsRefused) {
  EXPECT_THROW(EncodeJpeg(Image<Rgb8>(2, 2), 0), InputError);
  EXPECT_THROW(EncodeJpeg(Image<Rgb8>(2, 2), 101), InputError);
}

TEST(Exr, KeepsEveryBitOfAFloat) {
  RngStream rng(2, "exr");
  for (const auto& [w, h] : kSizes) {
    auto range = Filled<float>(w, h, [&] { return static_cast<float>(rng.Uniform(0, 1000)); });
    const float special[] = {0.0f,
                             -0.0f,
                             std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::denorm_min(),
                             std::numeric_limits<float>::max(),
                             std::bit_cast<float>(0x7fc12345u)};
    for (size_t i = 0; i < std::min(range.size(), std::size(special)); ++i) range.pixels()[i] = special[i];
    const auto back = DecodeExr(EncodeExr(range), "range");
    ASSERT_EQ(std::pair(back.width(), back.height()), std::pair(w, h));
    for (size_t i = 0; i < range.size(); ++i) {
      EXPECT_EQ(std::bit_cast<uint32_t>(back.pixels()[i]), std::bit_cast<uint32_t>(range.pixels()[i]));
    }
  }
}

TEST(Exr, OfAColourFileTheRedChannelIsRead) {
  EXPECT_EQ(DecodeExr(EncodeExr(Image<Rgb32f>(3, 2, {0.25f, 2, 3})), "rgb"), Image<float>(3, 2, 0.25f));
  // Halves: eleven bits of mantissa, held at the largest.
  EXPECT_EQ(DecodeExr(EncodeHalfExr(Image<Rgb32f>(3, 2, {0.25f, 2, 3})), "rgb"), Image<float>(3, 2, 0.25f));
  EXPECT_NEAR(DecodeExr(EncodeHalfExr(Image<Rgb32f>(3, 2, {0.1f, 2, 3})), "rgb")(1, 1), 0.1f, 0.1f / 2048);
  EXPECT_EQ(DecodeExr(EncodeHalfExr(Image<Rgb32f>(3, 2, {1e9f, 2, 3})), "rgb")(1, 1), 65504.0f);
}

// One small file of every kind, with the decoder that reads it.
struct Sample {
  const char* name;
  Bytes bytes;
  void (*decode)(std::span<const std::byte>);
};

Bytes Webp() {
  const auto image = SmoothPicture(17, 9);
  uint8_t* out = nullptr;
  const size_t n = WebPEncodeLosslessRGB(&image.pixels()[0].r, 17, 9, 17 * 3, &out);
  Bytes bytes(reinterpret_cast<std::byte*>(out), reinterpret_cast<std::byte*>(out) + n);
  WebPFree(out);
  return bytes;
}

std::vector<Sample> Samples() {
  constexpr auto kRgba = [](std::span<const std::byte> b) { DecodeRgba8(b, "file"); };
  const auto picture = SmoothPicture(17, 9);
  return {{"png rgb", EncodePng(picture, GPano{}), kRgba},
          {"png rgb16", EncodePng(Image<Rgb16>(5, 3, {1, 2, 3})), [](std::span<const std::byte> b) { DecodeRgb16Png(b, "file"); }},
          {"png gray16", EncodePng(Image<uint16_t>(5, 3, 9)), [](std::span<const std::byte> b) { DecodeGrayPng(b, "file"); }},
          {"png ids", EncodeIdPng(Image<uint32_t>(5, 3, 70000)), [](std::span<const std::byte> b) { DecodeIdPng(b, "file"); }},
          {"jpeg", EncodeJpeg(picture, 80, GPano{}), kRgba},
          {"webp", Webp(), kRgba},
          {"exr", EncodeExr(Image<float>(9, 37, 2.5f)), [](std::span<const std::byte> b) { DecodeExr(b, "file"); }}};
}

TEST(Decoders, EveryTruncationIsAnInputErrorThatStartsWithTheName) {
  for (const Sample& sample : Samples()) {
    ASSERT_NO_THROW(sample.decode(sample.bytes)) << sample.name;
    for (size_t n = 0; n < sample.bytes.size(); ++n) {
      // A fresh block of exactly n bytes, so that AddressSanitizer sees any read past the end.
      const Bytes part(sample.bytes.begin(), sample.bytes.begin() + static_cast<ptrdiff_t>(n));
      try {
        sample.decode(part);
        ADD_FAILURE() << sample.name << ": " << n << " of " << sample.bytes.size() << " bytes were accepted";
      } catch (const InputError& error) {
        EXPECT_TRUE(std::string_view(error.what()).starts_with("file: ")) << error.what();
      }
    }
  }
}

TEST(Decoders, FlippedBytesGiveAPictureOrAnInputErrorAndNothingElse) {
  RngStream rng(3, "flip");
  for (const Sample& sample : Samples()) {
    for (int round = 0; round < 500; ++round) {
      Bytes bytes = sample.bytes;
      for (int k = 0; k < 3; ++k) bytes[rng.Index(static_cast<uint32_t>(bytes.size()))] = static_cast<std::byte>(rng.Bits());
      try {
        sample.decode(bytes);
      } catch (const InputError&) {
      }
    }
  }
}

TEST(Decoders, AHugeSizeInASmallFileIsRefused) {
  // The width and height of a PNG are bytes 16..23; the CRC of the header chunk (bytes 12..28) follows.
  for (const uint8_t high : {0x7f, 0x00}) {  // more than kMaxPixels; 16384 x 16384, more than 70 bytes can hold
    Bytes png = EncodePng(Image<uint8_t>(2, 2));
    for (size_t side : {16, 20}) {
      png[side] = std::byte{high};
      png[side + 2] = std::byte{0x40};
      png[side + 3] = std::byte{0};
    }
    const auto crc = static_cast<uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(png.data()) + 12, 17));
    for (int i = 0; i < 4; ++i) png[29 + i] = static_cast<std::byte>(crc >> (24 - 8 * i));
    try {
      DecodeRgba8(png, "huge");
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string_view(error.what()).find(high ? "the limit is" : "truncated"), std::string_view::npos) << error.what();
    }
  }
  // The data window of an EXR: name, type, length, then x0 y0 x1 y1.
  Bytes exr = EncodeExr(Image<float>(2, 2));
  const size_t window = AsText(exr).find("dataWindow") + 11 + 6 + 4;
  for (size_t i = window + 8; i < window + 16; ++i) exr[i] = std::byte{0x20};
  EXPECT_THROW(DecodeExr(exr, "huge"), InputError);
}

TEST(Encoders, TheSamePictureGivesTheSameBytesAndAnEmptyOneIsRefused) {
  const auto picture = SmoothPicture(100, 50);
  EXPECT_EQ(EncodePng(picture, GPano{1, 2, 3}), EncodePng(picture, GPano{1, 2, 3}));
  EXPECT_EQ(EncodeJpeg(picture, 95, GPano{1, 2, 3}), EncodeJpeg(picture, 95, GPano{1, 2, 3}));
  EXPECT_EQ(EncodeExr(Image<float>(100, 50, 3)), EncodeExr(Image<float>(100, 50, 3)));
  EXPECT_THROW(EncodePng(Image<Rgb8>()), InputError);
  EXPECT_THROW(EncodeJpeg(Image<Rgb8>()), InputError);
  EXPECT_THROW(EncodeExr(Image<float>()), InputError);
}

TEST(Decoders, SomethingThatIsNoPictureIsNamed) {
  EXPECT_THROW(DecodeRgba8(AsBytes("hello, this is text"), "text.png"), InputError);
  EXPECT_THROW(DecodeRgba8({}, "empty.png"), InputError);
}

}  // namespace
}  // namespace airsim360

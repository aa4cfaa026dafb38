#include "airsim360/image/palette_png.h"

#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/image/codecs.h"

namespace airsim360 {
namespace {

std::vector<Rgb8> Colors(size_t count, uint64_t seed) {
  RngStream rng(seed, "palette");
  std::vector<Rgb8> colors(count);
  for (Rgb8& c : colors) {
    const uint64_t bits = rng.Bits();
    c = {static_cast<uint8_t>(bits), static_cast<uint8_t>(bits >> 8), static_cast<uint8_t>(bits >> 16)};
  }
  return colors;
}

TEST(PalettePng, IndicesAndColoursOfEveryPaletteSizeComeBack) {
  for (const size_t count : {1u, 2u, 3u, 16u, 17u, 255u, 256u}) {
    RngStream rng(count, "indices");
    Image<uint8_t> indices(37, 11);
    for (uint8_t& index : indices.pixels()) index = static_cast<uint8_t>(rng.Bits() % count);
    const std::vector<Rgb8> palette = Colors(count, count);
    const Bytes png = EncodePalettePng(indices, palette);
    EXPECT_TRUE(IsPalettePng(png, "x"));
    const PalettePicture back = DecodePalettePng(png, "x");
    EXPECT_EQ(back.indices, indices);
    EXPECT_EQ(back.palette, palette);
    // Second method: libpng's own expansion to colours, which is what viewers do.
    const Image<Rgba8> shown = DecodeRgba8(png, "x");
    for (size_t i = 0; i < indices.size(); ++i) {
      const Rgb8 c = palette[indices.pixels()[i]];
      ASSERT_EQ(shown.pixels()[i], (Rgba8{c.r, c.g, c.b, 255}));
    }
  }
}

TEST(PalettePng, LabelsAreReadFromPalettesAndGrayAlike) {
  Image<uint8_t> narrow(5, 3);
  for (size_t i = 0; i < narrow.size(); ++i) narrow.pixels()[i] = static_cast<uint8_t>(17 * i);
  EXPECT_EQ(DecodeLabelPng(EncodePalettePng(narrow, Colors(256, 1)), "a"), DecodeLabelPng(EncodePng(narrow), "b"));
  const Image<uint16_t> wide(3, 2, 60000);
  EXPECT_EQ(DecodeLabelPng(EncodePng(wide), "c"), wide);
  EXPECT_THROW(DecodeLabelPng(EncodePng(Image<Rgb8>(2, 2)), "d"), InputError);
}

TEST(PalettePng, WhatDoesNotFitIsRefused) {
  const Image<uint8_t> three(1, 1, 3);
  EXPECT_THROW(EncodePalettePng(three, Colors(3, 1)), InputError);
  EXPECT_THROW(EncodePalettePng(three, {}), InputError);
  EXPECT_THROW(EncodePalettePng(three, Colors(257, 1)), InputError);
  EXPECT_THROW(DecodePalettePng(EncodePng(three), "gray"), InputError);
  // A file whose palette was cut: PLTE with one colour for the index 3. The CRC is not that of the chunk then.
  Bytes png = EncodePalettePng(three, Colors(4, 1));
  png.resize(png.size() / 2);
  EXPECT_THROW(DecodePalettePng(png, "cut"), InputError);
}

}  // namespace
}  // namespace airsim360

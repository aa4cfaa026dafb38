#include <array>
#include <cstdint>

#include "airsim360/base/error.h"
#include "airsim360/image/draw.h"

namespace airsim360 {
namespace {

// One glyph a number: 7 rows of 5 bits, top row and left pixel in the highest bits. Drawn for this project.
constexpr std::array<uint64_t, 95> kGlyphs = {
    0x000000000, 0x108421004, 0x294000000, 0x295f57d4a, 0x11f4717c4, 0x672222273, 0x32544564d, 0x108000000, 0x088842082, 0x208210888,
    0x02aefbaa0, 0x0084f9080, 0x000001888, 0x0000f8000, 0x00000018c, 0x042222210, 0x3a33ae62e, 0x11942109f, 0x3a213221f, 0x78217043e,
    0x08ca97c42, 0x7e1e0862e, 0x1910f462e, 0x7c2221108, 0x3a317462e, 0x3a317844c, 0x018c03180, 0x018c03088, 0x04d8860c1, 0x001f07c00,
    0x418308d90, 0x3a2131004, 0x3a37ada0f, 0x11518fe31, 0x7a31f463e, 0x3e108420f, 0x72518c65c, 0x7e10f421f, 0x7e10f4210, 0x3e109c62f,
    0x4631fc631, 0x7c842109f, 0x1c210862e, 0x4654c5251, 0x42108421f, 0x4775ac631, 0x4739ace71, 0x3a318c62e, 0x7a31f4210, 0x3a318d64d,
    0x7a31f5251, 0x3e107043e, 0x7c8421084, 0x46318c62e, 0x46318a944, 0x4631ad771, 0x462a22a31, 0x462a21084, 0x7c222221f, 0x39084210e,
    0x420820821, 0x38421084e, 0x115100000, 0x00000001f, 0x208000000, 0x000e0be2f, 0x421e8c63e, 0x000f8420f, 0x042f8c62f, 0x000e8fe0e,
    0x1908f2108, 0x000f8bc2e, 0x421e8c631, 0x100c2108e, 0x080610a4c, 0x4212a6292, 0x30842108e, 0x001aad6b5, 0x001e8c631, 0x000e8c62e,
    0x001e8fa10, 0x000f8bc21, 0x0016c4210, 0x000f8383e, 0x211e42106, 0x00118c62f, 0x00118c544, 0x0011ad6aa, 0x001151151, 0x00118bc2e,
    0x001f1111f, 0x0c8441083, 0x108421084, 0x608411098, 0x0009ac800,
};

}  // namespace

bool HasInk(char letter, int column, int row) {
  if (column < 0 || column > 4 || row < 0 || row > 6) return false;
  const uint64_t glyph = kGlyphs[static_cast<size_t>((letter < 32 || letter > 126 ? '?' : letter) - 32)];
  return (glyph >> (34 - (row * 5 + column)) & 1) != 0;
}

int TextWidth(std::string_view text, int scale) { return static_cast<int>(text.size()) * kGlyphCellWidth * scale; }

void DrawText(std::string_view text, int x, int y, Rgb8 color, int scale, Image<Rgb8>& canvas) {
  if (scale < 1) throw InputError("DrawText: scale must be at least 1");
  for (char c : text) {
    for (int row = 0; row < 7; ++row) {
      for (int column = 0; column < 5; ++column) {
        if (HasInk(c, column, row)) FillRectangle(x + column * scale, y + row * scale, scale, scale, color, canvas);
      }
    }
    x += kGlyphCellWidth * scale;
  }
}

}  // namespace airsim360

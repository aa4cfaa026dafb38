// PNGs with a palette for pictures of labels: pixels are ids below 256, the colours are for people's eyes.
// Programs that ask for colours (viewers, cv2.imread) get colours; those that ask for pixels as stored (PIL's
// mode P, libpng without expansion) get ids.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/image/image.h"

namespace airsim360 {

struct PalettePicture {
  Image<uint8_t> indices;
  std::vector<Rgb8> palette;
};

/// 8 bits a pixel. InputError for no colours or more than 256, or an index beyond them.
Bytes EncodePalettePng(const Image<uint8_t>& indices, std::span<const Rgb8> palette);

/// Whether a PNG has a palette; reads the header alone. InputError that names `name` if it is no PNG.
bool IsPalettePng(std::span<const std::byte> bytes, std::string_view name);
/// InputError that names `name` for damage, a PNG without a palette and pixels beyond it.
PalettePicture DecodePalettePng(std::span<const std::byte> bytes, std::string_view name);

/// Ids of a label picture: indices of a palette, or 8- or 16-bit gray. InputError as DecodeGrayPng.
Image<uint16_t> DecodeLabelPng(std::span<const std::byte> bytes, std::string_view name);

}  // namespace airsim360

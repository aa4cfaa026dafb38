// Parts that the codecs share; not for other modules.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "airsim360/image/codecs.h"

namespace airsim360::internal {

/// InputError "`name`: `what`".
[[noreturn]] void ThrowDamaged(std::string_view name, std::string_view what);

/// Throws the InputError for a picture without pixels or with more than kMaxPixels.
void CheckSize(int64_t width, int64_t height, std::string_view name);

/// XMP packet (UTF-8) with the GPano properties of a full-sphere picture of this size
/// (developers.google.com/streetview/spherical-metadata).
std::string GPanoXmp(const GPano& gpano, int width, int height);

/// 8-bit RGBA of one format each.
Image<Rgba8> DecodePngRgba8(std::span<const std::byte> bytes, std::string_view name);
Image<Rgba8> DecodeJpegRgba8(std::span<const std::byte> bytes, std::string_view name);
Image<Rgba8> DecodeWebpRgba8(std::span<const std::byte> bytes, std::string_view name);

}  // namespace airsim360::internal

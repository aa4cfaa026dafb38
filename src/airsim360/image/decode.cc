// Telling picture formats apart, WebP, and the checks all decoders share.
#include <webp/decode.h>

#include <cstring>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs_internal.h"

namespace airsim360 {
namespace internal {

void ThrowDamaged(std::string_view name, std::string_view what) { throw InputError(std::string(name) + ": " + std::string(what)); }

void CheckSize(int64_t width, int64_t height, std::string_view name) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  if (width <= 0 || height <= 0) ThrowDamaged(name, "a picture of " + size + " pixels has no content");
  if (width > kMaxPixels || height > kMaxPixels / width) {
    ThrowDamaged(name, size + " pixels, the limit is " + std::to_string(kMaxPixels));
  }
}

Image<Rgba8> DecodeWebpRgba8(std::span<const std::byte> bytes, std::string_view name) {
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  int width = 0, height = 0;
  if (!WebPGetInfo(data, bytes.size(), &width, &height)) ThrowDamaged(name, "damaged WebP");
  CheckSize(width, height, name);
  Image<Rgba8> image(width, height);
  auto* out = reinterpret_cast<uint8_t*>(image.pixels().data());
  if (!WebPDecodeRGBAInto(data, bytes.size(), out, image.size() * sizeof(Rgba8), width * 4)) {
    ThrowDamaged(name, "damaged or truncated WebP");
  }
  return image;
}

}  // namespace internal

Image<Rgba8> DecodeRgba8(std::span<const std::byte> bytes, std::string_view name) {
  const std::string_view text = AsText(bytes);
  if (text.starts_with("\x89PNG")) return internal::DecodePngRgba8(bytes, name);
  if (text.starts_with("\xff\xd8")) return internal::DecodeJpegRgba8(bytes, name);
  if (text.starts_with("RIFF") && text.substr(0, 12).ends_with("WEBP")) return internal::DecodeWebpRgba8(bytes, name);
  internal::ThrowDamaged(name, "not a PNG, JPEG or WebP picture");
}

}  // namespace airsim360

// libFuzzer target: no bytes may crash a decoder or give anything but a picture or an InputError.
#include <zlib.h>

#include <cstdint>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs.h"

namespace airsim360 {
namespace {

template <class Decode>
void Try(const Decode& decode, std::span<const std::byte> bytes) {
  try {
    decode(bytes, "fuzz");
  } catch (const InputError&) {
  }
}

uint32_t BigEndian32(const Bytes& bytes, size_t at) {
  uint32_t v = 0;
  for (size_t i = 0; i < 4; ++i) v = v << 8 | static_cast<uint32_t>(bytes[at + i]);
  return v;
}

// Makes the check sums of the chunks right, without which libpng looks no further.
Bytes WithRightCrcs(Bytes png) {
  for (size_t at = 8; at + 12 <= png.size();) {
    const uint32_t length = BigEndian32(png, at);
    if (length > png.size() - at - 12) break;
    const auto crc = static_cast<uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(png.data()) + at + 4, length + 4));
    for (size_t i = 0; i < 4; ++i) png[at + 8 + length + i] = static_cast<std::byte>(crc >> (24 - 8 * i));
    at += size_t{12} + length;
  }
  return png;
}

}  // namespace
}  // namespace airsim360

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  if (size == 0 || size > (1 << 16)) return 0;
  Bytes bytes(reinterpret_cast<const std::byte*>(data), reinterpret_cast<const std::byte*>(data) + size);
  if (AsText(bytes).starts_with("\x89PNG")) {
    bytes = WithRightCrcs(std::move(bytes));
    Try([](auto... a) { DecodeGrayPng(a...); }, bytes);
    Try([](auto... a) { DecodeRgb16Png(a...); }, bytes);
    Try([](auto... a) { DecodeIdPng(a...); }, bytes);
    Try([](auto... a) { ReadPngKind(a...); }, bytes);
  }
  Try([](auto... a) { DecodeRgba8(a...); }, bytes);
  Try([](auto... a) { DecodeExr(a...); }, bytes);
  Try([](auto... a) { DecodeExrRgb(a...); }, bytes);
  Try([](auto... a) { DecodeRadianceHdr(a...); }, bytes);
  return 0;
}

// libFuzzer target: no bytes may crash a decoder or give anything but a picture or an InputError.
#include <cstdint>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs.h"

namespace {

template <class Decode>
void Try(const Decode& decode, std::span<const std::byte> bytes) {
  try {
    decode(bytes, "fuzz");
  } catch (const airsim360::InputError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  if (size == 0 || size > (1 << 16)) return 0;
  const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
  Try([](auto... a) { DecodeRgba8(a...); }, bytes);
  Try([](auto... a) { DecodeExr(a...); }, bytes);
  Try([](auto... a) { DecodeGrayPng(a...); }, bytes);
  Try([](auto... a) { DecodeRgb16Png(a...); }, bytes);
  Try([](auto... a) { DecodeIdPng(a...); }, bytes);
  return 0;
}

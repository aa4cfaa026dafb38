// KTX2 pictures from arbitrary bytes.
#include <cstddef>
#include <cstdint>

#include "airsim360/assets/textures/ktx2.h"
#include "airsim360/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  std::string unread;
  try {
    static_cast<void>(internal::DecodeKtx2(std::as_bytes(std::span(data, size)), "fuzz", 1 << 18, unread));
  } catch (const InputError&) {
  }
  return 0;
}

// Any bytes as .npy either decode or throw InputError.
#include "airsim360/eval/files/number_array.h"

#include <cstddef>
#include <cstdint>

#include "airsim360/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  try {
    DecodeNpy({reinterpret_cast<const std::byte*>(data), size}, "fuzz");
  } catch (const InputError&) {
  }
  return 0;
}

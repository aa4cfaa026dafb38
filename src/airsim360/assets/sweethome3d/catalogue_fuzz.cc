// Furniture catalogues (.properties) from arbitrary bytes.
#include <cstddef>
#include <cstdint>

#include "airsim360/assets/sweethome3d/sweethome3d.h"
#include "airsim360/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  try {
    static_cast<void>(internal::ParseCatalogue("fuzz", {reinterpret_cast<const char*>(data), size}));
  } catch (const InputError&) {
  }
  return 0;
}

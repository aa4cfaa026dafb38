// Any bytes as a settings file either read or throw InputError.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "airsim360/base/error.h"
#include "airsim360/rpc/settings/settings.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    airsim360::ParseSettings({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const airsim360::InputError&) {
  }
  return 0;
}

// Any bytes as a drone's YAML either read as a model that can be integrated or throw InputError.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/drone_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  try {
    CheckModel(ReadDroneYaml({reinterpret_cast<const char*>(data), size}, "fuzz").model);
  } catch (const InputError&) {
  }
  return 0;
}

// Any bytes as people.yaml either read or throw InputError.
#include "airsim360/people/crowd/people_file.h"

#include <cstddef>
#include <cstdint>

#include "airsim360/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    airsim360::internal::ParsePeople({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const airsim360::InputError&) {
  }
  return 0;
}

// Any bytes as panoptic JSON either read or throw InputError, with categories of their own and with known ones.
#include "airsim360/eval/files/panoptic_file.h"

#include <cstddef>
#include <cstdint>

#include "airsim360/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::vector<PanopticCategory> known = {{1, "a", true}, {2, "b", false}};
  for (const auto* categories : {static_cast<const std::vector<PanopticCategory>*>(nullptr), &known}) {
    try {
      ParsePanopticFile(text, "fuzz", categories);
    } catch (const InputError&) {
    }
  }
  return 0;
}

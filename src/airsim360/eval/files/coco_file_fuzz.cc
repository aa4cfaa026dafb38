// Any bytes as a COCO file of truths or of results either read or throw InputError, whatever is compared.
#include "airsim360/eval/files/coco_file.h"

#include <cstddef>
#include <cstdint>

#include "airsim360/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const CocoKind kind : {CocoKind::kMasks, CocoKind::kBoxes, CocoKind::kKeypoints, CocoKind::kSphericalBoxes, CocoKind::kBoxes3d}) {
    try {
      CocoTruths truths = ParseCocoTruths(text, "fuzz", kind);
      ParseCocoResults(text, "fuzz", kind, truths);
    } catch (const InputError&) {
    }
  }
  return 0;
}

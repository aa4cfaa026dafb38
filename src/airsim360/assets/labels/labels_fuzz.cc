// Label files from arbitrary bytes.
#include <cstddef>
#include <cstdint>

#include "airsim360/assets/labels/label_rules.h"
#include "airsim360/assets/labels/labels.h"
#include "airsim360/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  using namespace airsim360::internal;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static_cast<void>(FindKeyword(text));
  try {
    const LabelRules rules = ParseLabelRules("fuzz", text);
    for (const LabelRule& rule : rules.rules) static_cast<void>(Matches(rule, "some node", "a mesh", "and material"));
  } catch (const InputError&) {
  }
  return 0;
}

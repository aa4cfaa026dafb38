// Any bytes as YAML either read or throw InputError.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "airsim360/base/config.h"
#include "airsim360/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  bool flag = false;
  uint64_t count = 0;
  double number = 0;
  std::string text;
  std::vector<std::string> list;
  try {
    ReadYaml({reinterpret_cast<const char*>(data), size}, "fuzz", [&](ConfigVisitor& v) {
      v.Field("a", "", flag);
      v.Field("b", "", count);
      v.Field("c", "", number, -1, 1);
      v.Field("d", "", text);
      v.Field("e", "", list);
      v.Group("f", "", [&](ConfigVisitor& g) { g.Field("a", "", flag); });
    });
  } catch (const InputError&) {
  }
  return 0;
}

// CityJSON from arbitrary bytes: anything but an InputError is a finding.
#include <cstddef>
#include <cstdint>

#include "airsim360/assets/cityjson/cityjson.h"
#include "airsim360/assets/importing/scene_assembly.h"
#include "airsim360/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  using namespace airsim360::internal;
  ImportLimits limits;
  limits.max_vertices = limits.max_triangles = 1 << 14;
  limits.max_nodes = 1 << 10;
  try {
    ImportedFile file = ReadCityJson("fuzz", {reinterpret_cast<const char*>(data), size}, limits);
    AssembleScene(std::move(file), {}, "fuzz", "fuzz");
  } catch (const InputError&) {
  }
  return 0;
}

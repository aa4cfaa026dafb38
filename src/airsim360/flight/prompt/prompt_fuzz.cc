// Any bytes as a prompt either make a drone that reads back from its YAML bit for bit, or throw InputError.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/drone_file.h"
#include "airsim360/flight/prompt/gate.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  try {
    const DroneDesign design = DroneFromPrompt({reinterpret_cast<const char*>(data), size});
    if (!GateProblems(design.model).empty()) std::abort();
    const DroneDesign again = ReadDroneYaml(DroneYaml(design), "fuzz");
    if (again.model.mass != design.model.mass || again.model.inertia_B != design.model.inertia_B) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}

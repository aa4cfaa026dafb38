// Any bytes as a route file: an error that names the place, or a route that can be evaluated everywhere.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "airsim360/base/error.h"
#include "airsim360/sim/route_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  try {
    const auto waypoints = ParseRouteCsv({reinterpret_cast<const char*>(data), size}, "fuzz");
    const Route route = RouteThrough(waypoints, 3);
    const RoutePoint middle = route.At(route.duration() / 2);
    if (std::isnan(middle.yaw)) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}

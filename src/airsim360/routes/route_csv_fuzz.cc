// Any bytes as a route file: an error that names the place, or a route that can be evaluated everywhere. The
// first byte chooses the format.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "airsim360/base/error.h"
#include "airsim360/routes/route_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    const auto waypoints = data[0] % 3 == 0   ? ParseRouteCsv(text, "fuzz")
                           : data[0] % 3 == 1 ? ParseRouteXml(text, "fuzz")
                                              : ParseRouteYaml(text, "fuzz");
    const Route route = RouteThrough(waypoints, 3);
    const RoutePoint middle = route.At(route.duration() / 2);
    if (std::isnan(middle.yaw)) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}

// Places on the Earth as people write them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "airsim360/math/geodesy.h"

namespace airsim360 {

/// "60.1708N" and "24.9375E", in either order: degrees north and east, altitude 0. nullopt if neither text is degrees with
/// a letter; InputError if only one is, both are of the same axis, or they are no place: `what` starts the message.
std::optional<GeoPoint> ParseLatitudeLongitude(std::string_view one, std::string_view two, const std::string& what);

}  // namespace airsim360

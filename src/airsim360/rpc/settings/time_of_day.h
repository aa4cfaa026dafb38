// The sun of a day and time as AirSim writes them.
#pragma once

#include <string>

#include "airsim360/rpc/wire/airsim_types.h"
#include "airsim360/scene/environment.h"

namespace airsim360 {

/// Sets the sun to that of `start`, "2018-02-12 15:20:00" in the local mean time of the place. std::invalid_argument for a text
/// of another form or a day or time that there is not; "" leaves the environment as it is.
void SetTimeOfDay(const std::string& start, const airsim::GeoPoint& place, Environment& environment);

}  // namespace airsim360

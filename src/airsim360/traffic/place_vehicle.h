// Putting a vehicle somewhere by hand.
#pragma once

#include "airsim360/traffic/traffic.h"

namespace airsim360 {

inline constexpr double kFarthestLane = 8;  ///< metres from a place to the lane that a vehicle is put on

/// The state with `vehicle` at rest on the lane nearest to `p`, its middle there; it drives on from there. Lanes in junctions and
/// lanes for others do not count. InputError if no lane is so near, or another vehicle is in the way.
TrafficState WithVehicleAt(const TrafficModel& model, const TrafficState& state, uint32_t vehicle, Vec3d p);

}  // namespace airsim360

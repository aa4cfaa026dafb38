// Vehicles of a live world that are put somewhere by hand.
#pragma once

#include <string>

#include "airsim360/sim/sim_loop.h"

namespace airsim360 {

/// {"cars": [{"name", "kind", "p"}]} as they stand now, a JSON object; empty without traffic.
std::string CarsJson(const SimLoop& loop);

/// Puts the vehicle of that name onto the lane nearest to p; it drives on from there. InputError for a name that is none and as
/// WithVehicleAt. The caller holds what keeps the loop to itself.
void BringCar(SimLoop& loop, const std::string& name, Vec3d p);

}  // namespace airsim360

// Which way a vehicle takes.
#pragma once

#include "airsim360/traffic/traffic.h"

namespace airsim360::internal {

/// The lane after `lane` that the vehicle chooses: straight on more often than round a corner, back only where nothing else
/// leads on. Deterministic by seed, vehicle and its number of choices, which grows by one.
LaneId ChooseNext(const TrafficModel& model, uint32_t vehicle, LaneId lane, DrivingVehicle& own);

/// Chooses all lanes ahead anew, for a vehicle that has come to another lane.
void ChooseAhead(const TrafficModel& model, uint32_t vehicle, DrivingVehicle& own);

}  // namespace airsim360::internal

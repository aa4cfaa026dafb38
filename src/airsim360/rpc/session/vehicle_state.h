// What AirSim tells of a vehicle, from a snapshot.
#pragma once

#include "airsim360/rpc/session/snapshot.h"
#include "airsim360/rpc/wire/airsim_types.h"

namespace airsim360 {

/// In the vehicle's own N frame.
airsim::KinematicsState KinematicsOf(const Snapshot& now, size_t vehicle);
airsim::CollisionInfo CollisionOf(const Snapshot& now, size_t vehicle, bool has_collided);
airsim::MultirotorState MultirotorStateOf(const Snapshot& now, size_t vehicle, bool collision);
airsim::RotorStates RotorStatesOf(const Snapshot& now, size_t vehicle);
airsim::EnvironmentState EnvironmentOf(const Snapshot& now, size_t vehicle);
airsim::GeoPoint GeoPointOf(const Snapshot& now, Vec3d p_W);

}  // namespace airsim360

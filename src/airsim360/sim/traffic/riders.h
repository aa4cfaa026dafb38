// Who sits on the bicycles of traffic.
#pragma once

#include <memory>

#include "airsim360/people/body/body.h"
#include "airsim360/sim/traffic/traffic.h"

namespace airsim360::internal {

/// Someone on a bicycle whose wheels stand on the ground around the origin of P, +X ahead: on the saddle, hands at the grips,
/// the left foot down.
SkeletonPose RidingPose(const Body& body);

/// The scene with a rider, an entity of its own (human/rider), for each bicycle, after everything that it has; notes their
/// instances in the bodies. In place where `scene` is the only reference.
std::shared_ptr<Scene> AddRiders(std::shared_ptr<Scene> scene, const TrafficModel& model, std::vector<TrafficBody>& bodies);

}  // namespace airsim360::internal

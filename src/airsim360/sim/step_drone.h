// One step of one drone: what Step calls for each vehicle that flies. Writes only to that vehicle.
#pragma once

#include "airsim360/sim/step.h"
#include "airsim360/sim/world_contacts.h"

namespace airsim360 {

/// Drones are kept within this distance of the scene's box, metres.
inline constexpr double kWorldMargin = 1000;

}  // namespace airsim360

namespace airsim360::internal {

/// What all drones share during one step.
struct StepContext {
  const SimModel& model;
  const DroneBoxes& boxes;
  Vec3d wind_W;
  int64_t t_ns;  ///< at the beginning of the step
};

/// PlanMotion: the autopilot's turn, where it is due.
void PlanDrone(const StepContext& context, size_t i, Vehicle& vehicle, std::vector<SimEvent>& events);
/// QueryContacts: the air and the ground around the drone.
DroneSurroundings Surround(const StepContext& context, size_t i, Vehicle& vehicle);
/// StepFlight: dynamics, then contacts, then what follows from them.
void FlyDrone(const StepContext& context, size_t i, const DroneSurroundings& surroundings, Vehicle& vehicle, std::vector<SimEvent>& events);

/// Sets `motion` from `drone`.
void CopyMotion(Vehicle& vehicle);
/// Sets `drone` from `motion`, as a drone that hovers there.
void FollowMotion(const SimDrone& drone, Vehicle& vehicle);

}  // namespace airsim360::internal

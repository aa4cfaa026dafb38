// Drones as others see them: bodies in the scene that move with the simulation's state.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "airsim360/scene/model_source.h"
#include "airsim360/sensors/rig.h"
#include "airsim360/sim/step.h"

namespace airsim360 {

/// A body to be added: `model` is in B (origin at the centre of mass, +X forward, +Z up).
struct DroneBodySpec {
  std::string name;  ///< of the entity
  Model model;
  RigidTransform X_WB;  ///< where it stands in the scene as built
  std::string category = "uav/other";
  std::optional<size_t> same_as = {};  ///< an earlier body whose model it shares; `model` then counts for nothing
};

/// The body that stands for a drone of this model (MakeDroneBody, turning propellers as discs).
Model DroneBodyModel(const DroneModel& drone);

/// Where a body has come to in the scene.
struct DroneBodyRef {
  uint32_t instance = kMiss;
  EntityId entity = kNoEntity;
};

/// The scene with bodies added, each an instance and an entity of its own, after those that it has: ids of
/// everything else stay. In place where `scene` is the only reference, else a copy. `refs`: one for each
/// body.
std::shared_ptr<const Scene> AddDroneBodies(std::shared_ptr<const Scene> scene, std::span<const DroneBodySpec> bodies,
                                            std::vector<DroneBodyRef>& refs);

inline constexpr size_t kNobody = SIZE_MAX;

/// What has moved, as sensors of vehicle `self` see it: bodies where the drones are, its own hidden (kNobody:
/// all are shown), and the people as they stand at state.t_ns. Drones without a body are left out.
std::shared_ptr<const SceneState> SceneStateOf(const SimModel& model, const SimState& state, size_t self);

/// The instant that optical flow leads to: vehicle `self` and what else has moved `seconds` after `now` if commands stay,
/// by steps taken beside the simulation. As SceneStateOf, people with the meshes that they have now, which flow needs.
NextTrigger InstantAfter(const SimModel& model, const SimState& now, size_t self, double seconds);

/// The scene of `base` without any of the bodies, people and vehicles, for SimModel::tracer; `base` itself if there are
/// none.
std::shared_ptr<const RayTracer> WithoutBodies(const std::shared_ptr<const RayTracer>& base, std::span<const DroneBodyRef> bodies,
                                               const SimPeople* people = nullptr, const SimTraffic* traffic = nullptr);

}  // namespace airsim360

// The simulation: a constant model, a copyable state and one function that advances it by one fixed step.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "airsim360/sensors/rig.h"
#include "airsim360/sim/route.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

/// What never changes during a run. Shared, read-only.
struct SimModel {
  std::shared_ptr<const RayTracer> tracer;  ///< the scene and its distance queries
  int64_t dt_ns = 20'000'000;               ///< length of a step, > 0
  float contact_range = 2;                  ///< metres up to which clearance is measured
};

/// Following a route from the step in which the command was applied.
struct FollowRoute {
  std::shared_ptr<const Route> route;
  int64_t start_ns = 0;
};

struct Vehicle {
  Kinematics motion;
  Vec3d a_WB;           ///< acceleration of B in W, m/s^2
  float clearance = 0;  ///< metres to the nearest surface, at most SimModel::contact_range
  std::optional<FollowRoute> following;
};

/// Everything that changes. A copy is a snapshot; assigning one back restores it, and the same bytes follow.
struct SimState {
  int64_t step = 0;
  int64_t t_ns = 0;  ///< step * dt_ns
  std::vector<Vehicle> vehicles;
};

/// Tells a vehicle to follow a route from now on.
struct RouteCommand {
  size_t vehicle = 0;
  std::shared_ptr<const Route> route;
};

/// A vehicle at rest.
Vehicle VehicleAt(const SimModel& model, const RigidTransform& X_WB);

/// Applies `commands` at the state's time, then advances it by one dt. InputError for a vehicle that does not
/// exist.
void Step(const SimModel& model, std::span<const RouteCommand> commands, SimState& state);

/// 64-bit hash of every number of the state: equal states have equal hashes on every machine with the same
/// arithmetic.
uint64_t HashState(const SimState& state);

}  // namespace airsim360

// Where vehicles begin.
#include <algorithm>

#include "airsim360/base/error.h"
#include "airsim360/sim/living_world.h"
#include "airsim360/sim/people/people.h"
#include "airsim360/sim/step_drone.h"

namespace airsim360 {
namespace {

// Height of B of a drone that stands on what is below a place; the place itself where there is nothing.
double StandingHeight(const SimModel& model, const SimDrone& drone, Vec3d p) {
  const auto hit = model.tracer->Intersect(VecCast<float>(p), {0, 0, -1});
  if (!hit) return p.z;
  return p.z - static_cast<double>(hit->distance) + drone.model().half_size_B.z;
}

}  // namespace

Vehicle VehicleAt(const SimModel& model, const RigidTransform& X_WB) {
  Vehicle vehicle;
  vehicle.motion.X_WB = X_WB;
  vehicle.clearance = model.tracer->Clearance(VecCast<float>(X_WB.p), model.contact_range);
  return vehicle;
}

Vehicle DroneAt(const SimModel& model, const SimState& state, size_t i, const RigidTransform& X_WB, bool airborne) {
  if (i >= model.drones.size()) {
    throw InputError("drone " + std::to_string(i) + " of " + std::to_string(model.drones.size()));
  }
  const SimDrone& drone = *model.drones[i];
  RigidTransform place = X_WB;
  if (!airborne) {
    place = BodyPose(X_WB.p, AnglesOf(X_WB.R).yaw, 0, 0);
    place.p.z = StandingHeight(model, drone, X_WB.p);
  }
  Vehicle vehicle = VehicleAt(model, place);
  internal::FollowMotion(drone, vehicle);
  if (!airborne) vehicle.drone.rotor_speeds.fill(0);
  vehicle.rotor_commands = vehicle.drone.rotor_speeds;
  const StateEstimate estimate = EstimateOf(vehicle.drone, state.t_ns);
  vehicle.autopilot = airborne ? drone.autopilot().HoverState(estimate) : drone.autopilot().GroundState(estimate);
  vehicle.gusts = StartWind(model.world.seed, i);
  vehicle.sensors = StartSensors(drone.setup().sensors, model.world, static_cast<uint32_t>(i), MotionOf(vehicle));
  return vehicle;
}

SimState StartState(const SimModel& model) {
  SimState state;
  state.wind_W = model.wind.mean_W;
  StartLife(model, state);
  for (size_t i = 0; i < model.drones.size(); ++i) {
    const DroneSetup& setup = model.drones[i]->setup();
    state.vehicles.push_back(DroneAt(model, state, i, setup.X_WB, setup.airborne));
  }
  return state;
}

}  // namespace airsim360

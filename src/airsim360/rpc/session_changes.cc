// What calls change in a session, beyond commands to vehicles.
#include <algorithm>

#include "airsim360/rpc/ned.h"
#include "airsim360/rpc/session.h"
#include "airsim360/sim/people/people.h"

namespace airsim360 {

void Session::ObjectsMoved() {
  auto scene_state = std::make_shared<SceneState>();
  scene_state->t_ns = state_.t_ns;
  for (const auto& [entity, place] : world().places) objects_.Move(entity, place, scene_state->moved);
  const bool any = !scene_state->moved.empty();
  // Drones meet each other otherwise.
  for (const DroneBodyRef& body : bodies_) scene_state->moved.push_back({body.instance, {}, true});
  if (options_.people) {
    for (const PersonRef& person : options_.people->refs) scene_state->moved.push_back({person.instance, {}, true});
  }
  std::sort(scene_state->moved.begin(), scene_state->moved.end(),
            [](const MovedInstance& a, const MovedInstance& b) { return a.instance < b.instance; });
  auto model = std::make_shared<SimModel>(*model_);
  model->tracer = any ? dynamic_tracer_.At(scene_state) : base_tracer_;
  model_ = model;
  // Free space is measured anew.
  for (Vehicle& vehicle : state_.vehicles) vehicle.contact.free_distance = 0;
}

void Session::GainsChanged(const VehicleControl& control) {
  const SimDrone& old = *model_->drones[control.index()];
  DroneSetup setup = old.setup();
  setup.autopilot.simple_flight = control.gains;
  auto model = std::make_shared<SimModel>(*model_);
  model->drones[control.index()] = std::make_shared<const SimDrone>(setup, model->dt_ns);
  model_ = model;
}

bool Session::AddVehicle(const std::string& name, const std::string& type, const RigidTransform& X_WB) {
  std::string lower = type;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr size_t kMostVehicles = 256;
  const bool taken = HasVehicle(name);
  // Drones come before all others in the simulation: after one of those there is no room for them.
  const bool only_drones = model_->drones.size() == state_.vehicles.size();
  if (taken || name.empty() || lower != "simpleflight" || !only_drones || controls_.size() >= kMostVehicles) {
    return false;
  }
  AddToModel(name, VehicleSettings{}, X_WB);
  return true;
}

void Session::Teleport(const VehicleControl& control, const RigidTransform& X_WB) {
  Vehicle& moved = vehicle(control);
  moved.motion.X_WB = X_WB;
  moved.clearance = model_->tracer->Clearance(VecCast<float>(X_WB.p), model_->contact_range);
  if (!control.status().is_drone) return;
  moved.drone.p_WB = X_WB.p;
  moved.drone.q_WB = ToQuaternion(X_WB.R);
  moved.contact = {};
  moved.autopilot.has_reference = moved.autopilot.has_history = 0;
}

void Session::Reset() {
  for (const auto& control : controls_) {
    control->Reset(false);
    Vehicle& reset = vehicle(*control);
    const RigidTransform X_WB = {reset.motion.X_WB.R, control->status().origin_W};
    if (!control->status().is_drone) {
      Teleport(*control, StartPose(control->settings()));
      continue;
    }
    const uint64_t id = reset.command.id;
    const RigidTransform start = {model_->drones[control->index()]->setup().X_WB.R, X_WB.p};
    reset = DroneAt(*model_, state_, control->index(), start, false);
    reset.motion.X_WB = start;
    reset.drone.p_WB = start.p;
    reset.drone.q_WB = ToQuaternion(start.R);
    reset.command.id = id + 1;
  }
  state_.wind_W = model_->wind.mean_W;
}

}  // namespace airsim360

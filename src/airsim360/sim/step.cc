#include "airsim360/sim/step.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/sim/living_world.h"
#include "airsim360/sim/people/people.h"
#include "airsim360/sim/step_drone.h"
#include "airsim360/sim/traffic/traffic.h"

namespace airsim360 {
namespace {

// Vehicles of one task: fewer are not worth the hand-over to another thread.
constexpr size_t kVehiclesPerTask = 8;

bool Flies(const SimModel& model, size_t i, const Vehicle& vehicle) { return i < model.drones.size() && !vehicle.following; }

/// Applies one command; visits its kind.
struct CommandVisitor {
  const SimModel& model;
  size_t i;
  SimState& state;

  Vehicle& vehicle() const { return state.vehicles[i]; }
  void operator()(const std::shared_ptr<const Route>& route) const { vehicle().following = FollowRoute{route, state.t_ns}; }
  void operator()(const FlightCommand& flight) const {
    if (vehicle().following) {
      // From here on it flies: it takes over in mid-air.
      vehicle().following.reset();
      internal::FollowMotion(*model.drones[i], vehicle());
      vehicle().autopilot = model.drones[i]->autopilot().HoverState(EstimateOf(vehicle().drone, state.t_ns));
    }
    vehicle().command = {flight.command, vehicle().command.id + 1, flight.timeout_ns};
  }
  void operator()(const GimbalCommand& gimbal) const { vehicle().sensors.gimbals[gimbal.gimbal].command = gimbal.angles; }
  void operator()(const RotorHealthCommand& rotors) const { vehicle().health = rotors.health; }
  void operator()(const ResetCommand& reset) const {
    const DroneSetup& setup = model.drones[i]->setup();
    const uint64_t id = vehicle().command.id;
    vehicle() = DroneAt(model, state, i, reset.X_WB.value_or(setup.X_WB), reset.airborne.value_or(setup.airborne));
    vehicle().command.id += id;
  }
  void operator()(const WindCommand& wind) const { state.wind_W = wind.wind_W; }
  void operator()(const PersonCommand& person) const {
    CommandPerson(*model.people->crowd, internal::OwnPeople(state).crowd, person.person, person.action);
  }
};

void ApplyCommands(const SimModel& model, std::span<const SimCommand> commands, SimState& state) {
  for (const SimCommand& command : commands) CheckCommand(model, state, command);
  for (const SimCommand& command : commands) {
    std::visit(CommandVisitor{model, command.vehicle, state}, command.action);
  }
}

// Vehicles that follow a route are where it is at time t.
void MoveAlong(const SimModel& model, int64_t t_ns, Vehicle& vehicle) {
  const FollowRoute& following = *vehicle.following;
  const RoutePoint point = following.route->At(static_cast<double>(t_ns - following.start_ns) * 1e-9);
  vehicle.motion = {BodyPose(point.p, point.yaw, 0, 0), point.v, {0, 0, point.yaw_rate}};
  vehicle.a_WB = point.a;
  vehicle.drone.p_WB = point.p;
  vehicle.drone.q_WB = ToQuaternion(vehicle.motion.X_WB.R);
  vehicle.drone.v_WB = point.v;
  vehicle.drone.w_WB_B = vehicle.motion.w_WB_B;
  vehicle.clearance = model.tracer->Clearance(VecCast<float>(point.p), model.contact_range);
}

// Those that are not there yet.
template <class Box>
void AddBoxes(const std::vector<Box>& near, std::vector<DroneBox>& boxes) {
  for (const Box& met : near) {
    const auto same = [&](const DroneBox& box) { return box.vehicle == kMiss && box.entity == met.entity; };
    if (std::ranges::any_of(boxes, same)) continue;
    boxes.push_back({met.X_WB, met.half_size_B, met.v_W, Norm(met.half_size_B), kMiss, met.entity, {}});
  }
}

// People and vehicles near a drone can be touched by it; they stand like drones without rotors.
void AddBoxesOfLife(const SimModel& model, const SimState& state, std::vector<DroneBox>& boxes) {
  constexpr double kPeopleReach = 4, kVehicleReach = 6;  // metres: far more than both come nearer in a step
  const size_t count = std::min(model.drones.size(), state.vehicles.size());
  for (size_t i = 0; state.people && model.people && i < count; ++i)
    AddBoxes(PeopleNear(*model.people, *state.people, state.t_ns + model.people->epoch_ns, state.vehicles[i].motion.X_WB.p, kPeopleReach),
             boxes);
  for (size_t i = 0; state.traffic && model.traffic && i < count; ++i)
    AddBoxes(
        VehiclesNear(*model.traffic, *state.traffic, state.t_ns + model.traffic->epoch_ns, state.vehicles[i].motion.X_WB.p, kVehicleReach),
        boxes);
}

// What others meet of the drones: where they are now.
DroneBoxes BoxesOf(const SimModel& model, const SimState& state) {
  std::vector<DroneBox> boxes;
  const size_t count = std::min(model.drones.size(), state.vehicles.size());
  for (size_t i = 0; i < count && (count > 1 || model.people || model.traffic); ++i) {
    const SimDrone& drone = *model.drones[i];
    const Kinematics& motion = state.vehicles[i].motion;
    const RotorWake wake = Flies(model, i, state.vehicles[i]) ? WakeOf(drone.model(), state.vehicles[i].drone) : RotorWake{};
    boxes.push_back({motion.X_WB, drone.model().half_size_B, motion.v_WB, drone.radius(), i, drone.setup().entity, wake});
  }
  AddBoxesOfLife(model, state, boxes);
  return DroneBoxes(std::move(boxes));
}

void RecordTrace(const SimModel& model, int64_t t_ns, Vehicle& vehicle) {
  if (model.trace_samples == 0 || t_ns % model.trace_period_ns >= model.dt_ns) return;
  if (vehicle.trace.size() >= model.trace_samples) vehicle.trace.erase(vehicle.trace.begin());
  vehicle.trace.push_back({t_ns, vehicle.motion.X_WB.p, ToQuaternion(vehicle.motion.X_WB.R)});
}

void StepVehicle(const internal::StepContext& context, size_t i, Vehicle& vehicle, std::vector<SimEvent>& events) {
  const SimModel& model = context.model;
  const int64_t t_ns = context.t_ns + model.dt_ns;
  if (Flies(model, i, vehicle)) {
    internal::PlanDrone(context, i, vehicle, events);
    const DroneSurroundings surroundings = internal::Surround(context, i, vehicle);
    internal::FlyDrone(context, i, surroundings, vehicle, events);
  } else if (vehicle.following) {
    MoveAlong(model, t_ns, vehicle);
  }
  if (i < model.drones.size()) {
    StepSensors(model.drones[i]->setup().sensors, model.world, static_cast<uint32_t>(i), MotionOf(vehicle), t_ns, model.dt_ns,
                vehicle.sensors);
  }
  RecordTrace(model, t_ns, vehicle);
}

}  // namespace

void CheckCommand(const SimModel& model, const SimState& state, const SimCommand& command) {
  if (std::holds_alternative<WindCommand>(command.action)) return;
  if (const auto* person = std::get_if<PersonCommand>(&command.action)) {
    if (!state.people || !model.people) throw InputError("command for a person: there are no people");
    CheckPersonCommand(*model.people->crowd, state.people->crowd, person->person, person->action);
    return;
  }
  const size_t i = command.vehicle;
  const std::string where = "command for vehicle " + std::to_string(i);
  if (i >= state.vehicles.size()) throw InputError(where + " of " + std::to_string(state.vehicles.size()));
  const auto* route = std::get_if<std::shared_ptr<const Route>>(&command.action);
  if (route != nullptr && *route == nullptr) throw InputError(where + ": there is no route");
  if (route == nullptr && i >= model.drones.size()) throw InputError(where + ": it is no drone, it can only follow a route");
  const auto* gimbal = std::get_if<GimbalCommand>(&command.action);
  if (gimbal != nullptr && gimbal->gimbal >= state.vehicles[i].sensors.gimbals.size()) {
    throw InputError(where + ": gimbal " + std::to_string(gimbal->gimbal) + " of " +
                     std::to_string(state.vehicles[i].sensors.gimbals.size()));
  }
}

BodyMotion MotionOf(const Vehicle& vehicle) { return {vehicle.motion, vehicle.a_WB, vehicle.alpha_WB_B}; }

void Step(const SimModel& model, std::span<const SimCommand> commands, SimState& state, std::vector<SimEvent>* events) {
  ApplyCommands(model, commands, state);
  StepLife(model, state, events);
  const DroneBoxes boxes = BoxesOf(model, state);
  const internal::StepContext context{model, boxes, state.wind_W, state.t_ns};
  const size_t count = state.vehicles.size(), tasks = (count + kVehiclesPerTask - 1) / kVehiclesPerTask;
  // Each task has its own events, so that their order does not depend on the threads.
  std::vector<std::vector<SimEvent>> happened(tasks);
  const auto step_task = [&](int64_t task) {
    const auto first = static_cast<size_t>(task) * kVehiclesPerTask;
    for (size_t i = first; i < std::min(first + kVehiclesPerTask, count); ++i)
      StepVehicle(context, i, state.vehicles[i], happened[static_cast<size_t>(task)]);
  };
  if (tasks == 1) {
    step_task(0);
  } else {
    ParallelFor(static_cast<int64_t>(tasks), step_task);
  }
  ++state.step;
  state.t_ns += model.dt_ns;
  if (events == nullptr) return;
  for (auto& some : happened) std::ranges::move(some, std::back_inserter(*events));
}

}  // namespace airsim360

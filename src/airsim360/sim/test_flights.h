// Drones in the analytic room, for tests of the simulation.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "airsim360/flight/drones/catalog.h"
#include "airsim360/sim/drone_bodies.h"
#include "airsim360/sim/step.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360::internal {

/// The room, traced once for all tests of a program.
inline std::shared_ptr<const RayTracer> TestRoom() {
  static const auto tracer = std::make_shared<const RayTracer>(BuildWorld("box_room", {}));
  return tracer;
}

inline DroneSetup HummingbirdAt(Vec3d p, bool airborne = true) {
  DroneSetup setup{.name = "hummingbird", .model = CatalogModel("hummingbird")};
  setup.X_WB.p = p;
  setup.airborne = airborne;
  return setup;
}

inline std::shared_ptr<SimModel> RoomModel(const std::vector<DroneSetup>& setups) {
  auto model = std::make_shared<SimModel>();
  model->tracer = TestRoom();
  for (const DroneSetup& setup : setups) model->drones.push_back(std::make_shared<const SimDrone>(setup, model->dt_ns));
  return model;
}

/// Gives `command` to a drone and takes `seconds` of steps; all events.
inline std::vector<SimEvent> Fly(const SimModel& model, SimState& state, size_t vehicle, const Command& command, double seconds) {
  std::vector<SimEvent> events;
  std::vector<SimCommand> commands = {{vehicle, FlightCommand{command}}};
  const auto steps = static_cast<int64_t>(seconds * 1e9 / static_cast<double>(model.dt_ns) + 0.5);
  for (int64_t i = 0; i < steps; ++i) {
    Step(model, commands, state, &events);
    commands.clear();
  }
  return events;
}

inline std::vector<SimEvent> Wait(const SimModel& model, SimState& state, double seconds) {
  std::vector<SimEvent> events;
  const auto steps = static_cast<int64_t>(seconds * 1e9 / static_cast<double>(model.dt_ns) + 0.5);
  for (int64_t i = 0; i < steps; ++i) Step(model, {}, state, &events);
  return events;
}

/// The first event of a kind; nullptr if there is none.
inline const SimEvent* FindEvent(const std::vector<SimEvent>& events, SimEvent::Kind kind) {
  for (const SimEvent& event : events) {
    if (event.kind == kind) return &event;
  }
  return nullptr;
}

}  // namespace airsim360::internal

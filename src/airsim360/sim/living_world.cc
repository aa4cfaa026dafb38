#include "airsim360/sim/living_world.h"

#include <cstdio>
#include <memory>
#include <vector>

#include "airsim360/sim/people/people.h"
#include "airsim360/sim/traffic/traffic.h"

namespace airsim360 {
namespace {

// Near passes, as the drones notice them.
void ReportNearPasses(const SimModel& model, std::span<const CrowdEvent> happened, std::vector<SimEvent>& events) {
  for (const CrowdEvent& crowd : happened) {
    if (crowd.kind != CrowdEvent::Kind::kNearPass) continue;
    SimEvent event{.kind = SimEvent::Kind::kNearPerson, .vehicle = crowd.drone, .person = crowd.person};
    event.t_ns = crowd.t_ns - model.people->epoch_ns;
    char text[64];
    std::snprintf(text, sizeof text, " at %.2f m", crowd.value);
    event.text = model.people->crowd->people[crowd.person].name + text;
    events.push_back(std::move(event));
  }
}

void StepPeople(const SimModel& model, SimState& state, std::vector<SimEvent>* events) {
  if (!state.people || !model.people) return;
  const int64_t end_ns = state.t_ns + model.dt_ns + model.people->epoch_ns;
  if (state.people->crowd.t_ns + kCrowdTickNs > end_ns) return;
  std::vector<CrowdDrone> drones;
  for (size_t i = 0; i < state.vehicles.size(); ++i) {
    const Kinematics& motion = state.vehicles[i].motion;
    drones.push_back({motion.X_WB.p, motion.v_WB});
    if (i < model.drones.size()) drones.back().radius = model.drones[i]->radius();
  }
  PeopleState& people = internal::OwnPeople(state);
  std::vector<CrowdEvent> happened;
  while (people.crowd.t_ns + kCrowdTickNs <= end_ns) TickPeople(*model.people, drones, people, &happened);
  if (events != nullptr) ReportNearPasses(model, happened, *events);
}

// What vehicles stop for: the people, and drones that are low over a street.
std::vector<TrafficObstacle> ObstaclesOf(const SimModel& model, const SimState& state) {
  std::vector<TrafficObstacle> obstacles;
  if (state.people) obstacles = ObstaclesOf(*state.people);
  for (size_t i = 0; i < state.vehicles.size(); ++i) {
    const double radius = i < model.drones.size() ? model.drones[i]->radius() : 0.5;
    obstacles.push_back({state.vehicles[i].motion.X_WB.p, state.vehicles[i].motion.v_WB, radius});
  }
  return obstacles;
}

void StepTraffic(const SimModel& model, SimState& state) {
  if (!state.traffic || !model.traffic) return;
  const int64_t end_ns = state.t_ns + model.dt_ns + model.traffic->epoch_ns;
  if (state.traffic->t_ns + kTrafficTickNs > end_ns) return;
  const std::vector<TrafficObstacle> obstacles = ObstaclesOf(model, state);
  auto traffic = std::make_shared<TrafficState>(*state.traffic);
  while (traffic->t_ns + kTrafficTickNs <= end_ns) TickTraffic(model.traffic->model, obstacles, *traffic);
  state.traffic = std::move(traffic);
}

}  // namespace

PeopleState& internal::OwnPeople(SimState& state) {
  if (state.people.use_count() > 1) state.people = std::make_shared<PeopleState>(*state.people);
  return const_cast<PeopleState&>(*state.people);
}

std::vector<TrafficObstacle> ObstaclesOf(const PeopleState& people) {
  constexpr double kPersonRadius = 0.3;  // metres
  std::vector<TrafficObstacle> obstacles;
  for (const PersonState& person : people.crowd.people)
    if (person.visible) obstacles.push_back({person.p_WP, person.v_WP, kPersonRadius});
  return obstacles;
}

void StartLife(const SimModel& model, SimState& state) {
  if (model.people) state.people = model.people->start;
  if (model.traffic) state.traffic = model.traffic->start;
}

void StepLife(const SimModel& model, SimState& state, std::vector<SimEvent>* events) {
  StepPeople(model, state, events);
  StepTraffic(model, state);
}

}  // namespace airsim360

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

void ReportNearMisses(const SimModel& model, std::span<const NearMiss> over, std::vector<SimEvent>& events) {
  for (const NearMiss& miss : over) {
    SimEvent event{.kind = SimEvent::Kind::kNearMiss, .vehicle = kNoDrone, .near_miss = miss};
    if (miss.b.kind == RoadUser::Kind::kDrone) event.vehicle = miss.b.index;
    event.t_ns = event.near_miss.t_ns = miss.t_ns - model.traffic->epoch_ns;
    event.text = TextOfNearMiss(model, miss);
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
    const RoadUser who{RoadUser::Kind::kDrone, static_cast<uint32_t>(i)};
    obstacles.push_back({state.vehicles[i].motion.X_WB.p, state.vehicles[i].motion.v_WB, radius, who});
  }
  return obstacles;
}

void StepTraffic(const SimModel& model, SimState& state, std::vector<SimEvent>* events) {
  if (!state.traffic || !model.traffic) return;
  const int64_t end_ns = state.t_ns + model.dt_ns + model.traffic->epoch_ns;
  if (state.traffic->t_ns + kTrafficTickNs > end_ns) return;
  const std::vector<TrafficObstacle> obstacles = ObstaclesOf(model, state);
  auto traffic = std::make_shared<TrafficState>(*state.traffic);
  std::vector<NearMiss> over;
  while (traffic->t_ns + kTrafficTickNs <= end_ns) TickTraffic(model.traffic->model, obstacles, *traffic, &over);
  state.traffic = std::move(traffic);
  if (events != nullptr) ReportNearMisses(model, over, *events);
}

}  // namespace

PeopleState& internal::OwnPeople(SimState& state) {
  if (state.people.use_count() > 1) state.people = std::make_shared<PeopleState>(*state.people);
  return const_cast<PeopleState&>(*state.people);
}

std::vector<TrafficObstacle> ObstaclesOf(const PeopleState& people) {
  constexpr double kPersonRadius = 0.3;  // metres
  std::vector<TrafficObstacle> obstacles;
  for (uint32_t i = 0; i < people.crowd.people.size(); ++i) {
    const PersonState& person = people.crowd.people[i];
    if (person.visible) obstacles.push_back({person.p_WP, person.v_WP, kPersonRadius, {RoadUser::Kind::kPerson, i}});
  }
  return obstacles;
}

const std::string& NameOfRoadUser(const SimModel& model, const RoadUser& user) {
  static const std::string kUnnamed = "a drone";
  switch (user.kind) {
    case RoadUser::Kind::kVehicle:
      return model.traffic->bodies[user.index].name;
    case RoadUser::Kind::kPerson:
      return model.people->cast[user.index].name;
    case RoadUser::Kind::kDrone:
      break;
  }
  return user.index < model.drones.size() ? model.drones[user.index]->setup().name : kUnnamed;
}

std::string TextOfNearMiss(const SimModel& model, const NearMiss& miss) {
  char text[48];
  std::snprintf(text, sizeof text, " %.2f s before a crash", miss.seconds);
  return NameOfRoadUser(model, miss.a) + " and " + NameOfRoadUser(model, miss.b) + text;
}

void StartLife(const SimModel& model, SimState& state) {
  if (model.people) state.people = model.people->start;
  if (model.traffic) state.traffic = model.traffic->start;
}

void StepLife(const SimModel& model, SimState& state, std::vector<SimEvent>* events) {
  StepPeople(model, state, events);
  StepTraffic(model, state, events);
}

}  // namespace airsim360

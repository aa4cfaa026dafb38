#include "airsim360/sim/living_world.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "airsim360/sim/people/people.h"
#include "airsim360/sim/traffic/traffic.h"
#include "airsim360/traffic/obstacles.h"

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

std::vector<CrowdDrone> DronesOf(const SimModel& model, const SimState& state) {
  std::vector<CrowdDrone> drones;
  for (size_t i = 0; i < state.vehicles.size(); ++i) {
    const Kinematics& motion = state.vehicles[i].motion;
    drones.push_back({motion.X_WB.p, motion.v_WB});
    if (i < model.drones.size()) drones.back().radius = model.drones[i]->radius();
  }
  return drones;
}

void TickPeople(const SimModel& model, SimState& state, std::vector<SimEvent>* events) {
  const std::vector<CrowdDrone> drones = DronesOf(model, state);
  std::vector<CrowdEvent> happened;
  TickPeopleAmong(model, model.traffic ? state.traffic.get() : nullptr, drones, internal::OwnPeople(state), &happened);
  if (events != nullptr) ReportNearPasses(model, happened, *events);
}

// Drones as vehicles see them, which stop for those that are low over a street.
std::vector<TrafficObstacle> ObstaclesOf(const SimModel& model, const SimState& state) {
  std::vector<TrafficObstacle> obstacles;
  for (size_t i = 0; i < state.vehicles.size(); ++i) {
    const double radius = i < model.drones.size() ? model.drones[i]->radius() : 0.5;
    const RoadUser who{RoadUser::Kind::kDrone, static_cast<uint32_t>(i)};
    obstacles.push_back({state.vehicles[i].motion.X_WB.p, state.vehicles[i].motion.v_WB, radius, who});
  }
  return obstacles;
}

void TickTraffic(const SimModel& model, SimState& state, std::vector<SimEvent>* events) {
  auto traffic = std::make_shared<TrafficState>(*state.traffic);
  std::vector<NearMiss> over;
  TickTrafficAmong(model, state.people.get(), *traffic, &over, ObstaclesOf(model, state));
  state.traffic = std::move(traffic);
  if (events != nullptr) ReportNearMisses(model, over, *events);
}

// Where people are, in squares so large that nobody meets a vehicle before its way has left those around theirs.
class AreasOfPeople {
 public:
  explicit AreasOfPeople(std::span<const PersonState> people) {
    std::vector<Square> own;
    for (const PersonState& person : people)
      if (person.visible) own.push_back(SquareOf(person.p_WP));
    std::ranges::sort(own);
    own.erase(std::unique(own.begin(), own.end()), own.end());
    for (const auto& [x, y] : own)
      for (int64_t dx = -1; dx <= 1; ++dx)
        for (int64_t dy = -1; dy <= 1; ++dy) around_.emplace_back(x + dx, y + dy);
    std::ranges::sort(around_);
  }
  bool Near(Vec3d p) const { return std::ranges::binary_search(around_, SquareOf(p)); }

 private:
  using Square = std::pair<int64_t, int64_t>;
  static Square SquareOf(Vec3d p) {
    constexpr double kEdge = 40;  // metres: 1.5 s at 16 m/s, half a bus, and what somebody walks in 3 s
    const auto index = [](double x) { return static_cast<int64_t>(std::floor(std::clamp(x, -1e9, 1e9) / kEdge)); };
    return {index(p.x), index(p.y)};
  }
  std::vector<Square> around_;
};

// The time after which a vehicle at its speed has come as far as it comes in `seconds` if it goes on braking or, for a second,
// accelerating as it does.
int64_t SameWayNs(const DrivingVehicle& vehicle, double seconds) {
  const double a = vehicle.a, time = a < 0 ? std::min(seconds, vehicle.v / -a) : std::min(seconds, 1.0);
  const double way = vehicle.v * (a < 0 ? time : seconds) + a * time * time / 2 + (a < 0 ? 0 : a * time * (seconds - time));
  return std::llround(way / std::max(vehicle.v, 0.01) * 1e9);
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

std::vector<CrowdVehicle> VehiclesNear(const SimTraffic& traffic, const TrafficState& state, const PeopleState& people) {
  constexpr double kLooksAhead = 3, kStands = 0.3;  // seconds, m/s
  const AreasOfPeople areas(people.crowd.people);
  std::vector<CrowdVehicle> vehicles;
  for (size_t i = 0; i < state.vehicles.size(); ++i) {
    const DrivingVehicle& driving = state.vehicles[i];
    const VehicleShape& shape = traffic.model.vehicles[i].shape;
    if (!areas.Near(internal::AlongWay(traffic.model, driving, shape, kLooksAhead / 2 * driving.v).p)) continue;
    CrowdVehicle vehicle{.places = {}, .half_length = shape.length / 2, .half_width = shape.width / 2};
    vehicle.stands = driving.v < kStands;
    for (size_t k = 0; k < vehicle.places.size(); ++k) {
      if (k > 0 && vehicle.stands) {
        vehicle.places[k] = vehicle.places[0];
        continue;
      }
      const int64_t later_ns = SameWayNs(driving, static_cast<double>(k) * kCrowdVehicleStep);
      const RigidTransform X = PoseOf(traffic.model, state, i, state.t_ns + later_ns);
      const Vec3d ahead = Normalized(Vec3d{X.R.column(0).x, X.R.column(0).y, 0});
      vehicle.places[k] = {{X.p.x, X.p.y}, {ahead.x, ahead.y}};
      if (k == 0) vehicle.z = X.p.z;
    }
    vehicles.push_back(vehicle);
  }
  return vehicles;
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

void TickPeopleAmong(const SimModel& model, const TrafficState* traffic, std::span<const CrowdDrone> drones, PeopleState& people,
                     std::vector<CrowdEvent>* events) {
  std::vector<CrowdVehicle> vehicles;
  if (traffic != nullptr) vehicles = VehiclesNear(*model.traffic, *traffic, people);
  TickPeople(*model.people, drones, people, events, vehicles);
}

void TickTrafficAmong(const SimModel& model, const PeopleState* people, TrafficState& traffic, std::vector<NearMiss>* over,
                      std::span<const TrafficObstacle> others) {
  std::vector<TrafficObstacle> obstacles;
  if (people != nullptr) obstacles = ObstaclesOf(*people);
  obstacles.insert(obstacles.end(), others.begin(), others.end());
  TickTraffic(model.traffic->model, obstacles, traffic, over);
}

void StartLife(const SimModel& model, SimState& state) {
  if (model.people) state.people = model.people->start;
  if (model.traffic) state.traffic = model.traffic->start;
}

void StepLife(const SimModel& model, SimState& state, std::vector<SimEvent>* events) {
  const int64_t end_ns = state.t_ns + model.dt_ns;
  constexpr int64_t kNever = INT64_MAX;
  while (true) {
    // People look at vehicles where they are, then vehicles at people.
    const int64_t people_ns = state.people && model.people ? state.people->crowd.t_ns + kCrowdTickNs - model.people->epoch_ns : kNever;
    const int64_t traffic_ns = state.traffic && model.traffic ? state.traffic->t_ns + kTrafficTickNs - model.traffic->epoch_ns : kNever;
    if (std::min(people_ns, traffic_ns) > end_ns) return;
    if (people_ns <= traffic_ns) {
      TickPeople(model, state, events);
    } else {
      TickTraffic(model, state, events);
    }
  }
}

}  // namespace airsim360

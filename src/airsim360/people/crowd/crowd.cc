#include "airsim360/people/crowd/crowd.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/nearest_name.h"
#include "airsim360/base/state_hash.h"
#include "airsim360/people/crowd/agent.h"
#include "airsim360/people/crowd/shown_state.h"
#include "airsim360/people/crowd/vehicle_dodging.h"

namespace airsim360 {

using internal::Agent;
using internal::CrowdTick;
using internal::Walker;

CrowdState::CrowdState() : internals(std::make_unique<CrowdInternals>()) {}
CrowdState::CrowdState(const CrowdState& other)
    : t_ns(other.t_ns), people(other.people), internals(std::make_unique<CrowdInternals>(*other.internals)) {}
CrowdState::CrowdState(CrowdState&&) noexcept = default;
CrowdState& CrowdState::operator=(const CrowdState& other) {
  if (this == &other) return *this;
  t_ns = other.t_ns;
  people = other.people;
  if (internals) {
    *internals = *other.internals;
  } else {
    internals = std::make_unique<CrowdInternals>(*other.internals);
  }
  return *this;
}
CrowdState& CrowdState::operator=(CrowdState&&) noexcept = default;
CrowdState::~CrowdState() = default;

namespace internal {

void AddEvent(CrowdTick& tick, CrowdEvent event) {
  if (tick.events) tick.events->push_back(std::move(event));
}

}  // namespace internal

namespace {

constexpr double kTickSeconds = static_cast<double>(kCrowdTickNs) * 1e-9;

/// Once within kNearPass, then not again before the drone was 2 m away.
void WatchDrones(CrowdTick& tick) {
  for (size_t d = 0; d < std::min<size_t>(tick.drones.size(), 64); ++d) {
    const CrowdDrone& drone = tick.drones[d];
    const uint64_t bit = uint64_t{1} << d;
    for (PersonIndex i = 0; i < tick.in.agents.size(); ++i) {
      Agent& agent = tick.in.agents[i];
      if (!tick.in.walkers[i].present) continue;
      const Vec3d& p = tick.in.walkers[i].at.p_W;
      const double dx = drone.p_W.x - p.x, dy = drone.p_W.y - p.y;
      const bool was = agent.near_drones & bit;
      if (!was && dx * dx + dy * dy > 25) continue;
      // From the sphere of the drone to an upright capsule.
      const double up = drone.p_W.z - std::clamp(drone.p_W.z, p.z, p.z + tick.model.people[i].stature);
      const double distance = std::max(0.0, std::sqrt(dx * dx + dy * dy + up * up) - internal::kBodyRadius - drone.radius);
      if (!was && distance < kNearPass) {
        agent.near_drones |= bit;
        internal::AddEvent(tick, {.kind = CrowdEvent::Kind::kNearPass,
                                  .t_ns = tick.t_ns,
                                  .person = i,
                                  .from = {},
                                  .to = {},
                                  .text = "drone " + std::to_string(d),
                                  .drone = d,
                                  .value = distance});
      } else if (was && distance > 2) {
        agent.near_drones &= ~bit;
      }
    }
  }
}

void RunTick(const CrowdModel& model, CrowdState& state, std::span<const CrowdDrone> drones, std::span<const CrowdVehicle> vehicles,
             std::vector<CrowdEvent>* events) {
  CrowdInternals& in = *state.internals;
  CrowdTick tick{model, *model.plan, state, in, drones, events, in.tick * kCrowdTickNs};
  const size_t first_event = events ? events->size() : 0;

  // Hear, think, find the way.
  internal::Deliver(tick);
  in.steering.Sort(in.walkers);
  internal::RunGroups(tick);
  for (PersonIndex i = static_cast<PersonIndex>(in.tick % internal::kThinkEvery); i < in.agents.size(); i += internal::kThinkEvery)
    if (in.walkers[i].present) internal::Think(tick, i);
  internal::FindWays(tick);

  // Walk.
  internal::WantVelocities(tick);
  for (size_t i = 0; i < in.walkers.size(); ++i) in.from[i] = internal::FeetOf(*model.plan, in, static_cast<PersonIndex>(i), tick.t_ns);
  in.from_yaw = in.to_yaw;
  std::vector<internal::SteeringObstacle> obstacles;
  for (const CrowdDrone& drone : drones)
    obstacles.push_back({{drone.p_W.x, drone.p_W.y}, {drone.v_W.x, drone.v_W.y}, drone.p_W.z, drone.radius});
  in.steering.Step(*model.navmesh, in.walkers, obstacles, kTickSeconds, internal::Vehicles(vehicles));

  // What is seen of it.
  WatchDrones(tick);
  for (PersonIndex i = 0; i < in.agents.size(); ++i) internal::Show(tick, i, kTickSeconds);
  ++in.tick;
  if (events)
    std::stable_sort(events->begin() + static_cast<int64_t>(first_event), events->end(),
                     [](const CrowdEvent& a, const CrowdEvent& b) { return a.person < b.person; });
}

/// People between the two ends of the current tick.
void Interpolate(const CrowdModel& model, CrowdState& state) {
  CrowdInternals& in = *state.internals;
  const int64_t end = in.tick * kCrowdTickNs;
  const double f = 1 - static_cast<double>(end - state.t_ns) / static_cast<double>(kCrowdTickNs);
  for (PersonIndex i = 0; i < state.people.size(); ++i) {
    PersonState& person = state.people[i];
    const Vec3d to = internal::FeetOf(*model.plan, in, i, end);
    person.p_WP = in.from[i] + (to - in.from[i]) * f;
    person.yaw = std::remainder(in.from_yaw[i] + std::remainder(in.to_yaw[i] - in.from_yaw[i], 2 * kPi) * f, 2 * kPi);
  }
}

/// Those who begin on a seat, and those who begin in a talk.
void BeginInRooms(const CrowdModel& model, CrowdState& state) {
  const CrowdPlan& plan = *model.plan;
  CrowdInternals& in = *state.internals;
  CrowdTick tick{model, plan, state, in, {}, nullptr, 0};
  for (PersonIndex i = 0; i < plan.start_seats.size(); ++i) {
    Agent& agent = in.agents[i];
    PersonState& person = state.people[i];
    if (const int32_t seat = plan.start_seats[i]; seat >= 0) {
      const internal::Place& place = plan.places[static_cast<size_t>(seat)];
      in.place_taken[static_cast<size_t>(seat)] = i;
      agent.place = seat;
      agent.at_place = agent.begins = agent.has_face = true;
      const bool sits = place.kind == internal::PlaceKind::kBench;
      agent.state = sits ? internal::kSitting : internal::kWaiting;
      agent.face_yaw = in.to_yaw[i] = in.from_yaw[i] = person.yaw = place.yaw;
      in.walkers[i].at = place.approach;
      in.from[i] = person.p_WP = place.p_W;
      person.lower = person.upper = sits ? Behaviour::kSit : Behaviour::kWait;
      person.seating = place.seating;
    } else if (const PersonIndex other = plan.start_partners[i]; other != kNoPerson) {
      agent.begins = true;
      agent.last_met = other;
      // The first of the two founds the group.
      if (i < other) {
        internal::FoundGroup(tick, i, other);
      } else {
        internal::JoinGroup(tick, i, in.agents[other].group);
      }
      const Vec3d d = in.walkers[other].at.p_W - in.walkers[i].at.p_W;
      in.to_yaw[i] = in.from_yaw[i] = person.yaw = std::atan2(d.y, d.x);
    }
  }
}

}  // namespace

CrowdState StartCrowd(const CrowdModel& model) {
  CrowdState state;
  CrowdInternals& in = *state.internals;
  const size_t n = model.people.size();
  state.people.resize(n);
  in.walkers.resize(n);
  in.agents.resize(n);
  in.from.resize(n);
  in.from_yaw.resize(n);
  in.to_yaw.resize(n);
  in.place_taken.assign(model.plan->places.size(), kNoPerson);
  for (PersonIndex i = 0; i < n; ++i) {
    Agent& agent = in.agents[i];
    Walker& walker = in.walkers[i];
    agent.rng = RngStream(model.seed, "crowd", i);
    agent.left_ns.assign(model.plan->states.size(), -1);
    agent.tree = model.plan->tree_of_person[i];
    agent.run.Start(model.plan->trees.trees[agent.tree]);
    agent.social_after_ns = static_cast<int64_t>(agent.rng.Uniform(1, 25) * 1e9);
    walker.at = model.plan->starts[i];
    walker.present = walker.at.valid();
    walker.free_speed = model.people[i].free_speed;
    in.to_yaw[i] = in.from_yaw[i] = agent.rng.Uniform(-kPi, kPi);
    in.from[i] = walker.at.p_W;
    state.people[i].p_WP = walker.at.p_W;
    state.people[i].yaw = in.to_yaw[i];
    state.people[i].visible = walker.present;
  }
  // Parties look one way.
  for (const internal::Party& party : model.plan->parties)
    for (const PersonIndex i : party.members) in.to_yaw[i] = in.from_yaw[i] = state.people[i].yaw = in.to_yaw[party.members[0]];
  in.next_group += static_cast<uint32_t>(model.plan->parties.size());  // talks of parties have the numbers of these
  BeginInRooms(model, state);
  return state;
}

void StepCrowd(const CrowdModel& model, CrowdState& state, int64_t dt_ns, std::span<const CrowdDrone> drones,
               std::vector<CrowdEvent>* events, std::span<const CrowdVehicle> vehicles) {
  if (dt_ns <= 0) throw InputError("a step of the crowd must be longer than nothing");
  state.t_ns += dt_ns;
  while (state.internals->tick * kCrowdTickNs < state.t_ns) RunTick(model, state, drones, vehicles, events);
  Interpolate(model, state);
}

uint64_t HashCrowd(const CrowdState& state) {
  StateHasher hasher;
  hasher.Add(state.t_ns);
  for (const PersonState& person : state.people) {
    hasher.Add(person.p_WP);
    hasher.Add(person.v_WP);
    hasher.Add(person.yaw);
    hasher.Add(static_cast<uint64_t>(person.lower) << 32 | static_cast<uint64_t>(person.upper) << 16 |
               static_cast<uint64_t>(person.speaking) << 2 | static_cast<uint64_t>(person.visible) << 1 |
               static_cast<uint64_t>(person.has_gaze));
    hasher.Add(person.lower_since_ns);
    hasher.Add(person.upper_since_ns);
    hasher.Add(person.group);
    hasher.Add(person.partner);
    hasher.Add(person.p_W_gaze);
    for (const double length : {person.seating.height, person.seating.reach, person.seating.desk}) hasher.Add(length);
  }
  const CrowdInternals& in = *state.internals;
  hasher.Add(in.tick);
  hasher.Add(in.next_group);
  hasher.Add(in.lost_messages);
  for (size_t i = 0; i < in.agents.size(); ++i) {
    const Agent& agent = in.agents[i];
    const Walker& walker = in.walkers[i];
    RngStream rng = agent.rng;
    hasher.Add(rng.Bits());
    hasher.Add(walker.at.polygon);
    hasher.Add(walker.at.p_W);
    hasher.Add(walker.v.x);
    hasher.Add(walker.v.y);
    hasher.Add(static_cast<uint64_t>(agent.state) << 32 | static_cast<uint64_t>(agent.walk) << 16 | agent.gate);
    hasher.Add(agent.state_until_ns);
    hasher.Add(static_cast<uint64_t>(static_cast<uint32_t>(agent.place)) << 2 | static_cast<uint64_t>(agent.at_place) << 1 |
               static_cast<uint64_t>(agent.begins));
    hasher.Add(agent.pace);
    for (const Vec2d& v : {agent.slot, agent.heading, agent.shift, agent.stand}) {
      hasher.Add(v.x);
      hasher.Add(v.y);
    }
    hasher.Add(agent.party_pace);
    hasher.Add(agent.sway);
    hasher.Add(agent.waits_since_ns);
    hasher.Add(agent.shifts_until_ns);
    hasher.Add(static_cast<uint64_t>(agent.accompanies) << 1 | static_cast<uint64_t>(agent.stands));
    hasher.Add(static_cast<uint64_t>(agent.gates.size()));
    for (const internal::Gate& gate : agent.gates) {
      hasher.Add(gate.p);
      hasher.Add(gate.side.x);
      hasher.Add(gate.side.y);
    }
    hasher.Add(agent.near_drones);
    hasher.Add(static_cast<uint64_t>(agent.inbox.size()));
    for (const internal::Message& message : agent.inbox) hasher.Add(static_cast<uint64_t>(message.type) << 32 | message.from);
    for (const internal::NodeMemory& memory : agent.run.nodes) {
      hasher.Add(static_cast<uint64_t>(memory.status) << 48 | static_cast<uint64_t>(memory.child) << 32 |
                 static_cast<uint32_t>(memory.count));
      hasher.Add(memory.t_ns);
    }
  }
  for (const PersonIndex taken_by : in.place_taken) hasher.Add(static_cast<uint64_t>(taken_by));
  return hasher.hash();
}

PersonIndex PersonByName(const CrowdModel& model, std::string_view name) {
  std::vector<std::string> names;
  for (PersonIndex i = 0; i < model.people.size(); ++i) {
    if (model.people[i].name == name) return i;
    names.push_back(model.people[i].name);
  }
  throw InputError("no person '" + std::string(name.substr(0, 100)) + "'" + DidYouMean(name, names));
}

std::string_view PersonStateName(const CrowdModel& model, const CrowdState& state, PersonIndex person) {
  return model.plan->states[state.internals->agents[person].state].name;
}

PersonTransition LastTransition(const CrowdModel& model, const CrowdState& state, PersonIndex person) {
  const Agent& agent = state.internals->agents[person];
  return {model.plan->states[agent.state_before].name, model.plan->states[agent.state].name, agent.cause, agent.state_since_ns};
}

}  // namespace airsim360

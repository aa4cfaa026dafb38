#include "airsim360/people/crowd/shown_state.h"

#include <algorithm>
#include <cmath>

#include "airsim360/people/crowd/parties.h"

namespace airsim360::internal {
namespace {

constexpr double kTurnRate = 2.4;        // rad/s
constexpr double kHeadsByMotion = 0.25;  // m/s: above that people face where they go

Behaviour ByMotion(const Agent& agent, double speed, Behaviour now) {
  // A little hysteresis, so that a label does not flicker.
  const double keep = 0.1;
  if (speed > 2.9 - (now == Behaviour::kRun ? keep : 0)) return Behaviour::kRun;
  if (speed > 2.1 - (now == Behaviour::kJog ? keep : 0)) return Behaviour::kJog;
  if (speed > 0.2 - (now == Behaviour::kWalk ? keep : 0)) return Behaviour::kWalk;
  return agent.hold ? Behaviour::kWait : Behaviour::kIdle;
}

}  // namespace

void Show(CrowdTick& tick, PersonIndex i, double dt) {
  Agent& agent = tick.in.agents[i];
  const Walker& walker = tick.in.walkers[i];
  PersonState& person = tick.state.people[i];
  const StateDef& state = tick.plan.states[agent.state];
  const double speed = std::hypot(walker.v.x, walker.v.y);
  person.visible = walker.present;
  person.v_WP = {walker.v.x, walker.v.y, 0};

  // Turn towards the way, or towards what holds them.
  double& yaw = tick.in.to_yaw[i];
  double towards = yaw;
  if (speed > kHeadsByMotion) {
    towards = std::atan2(walker.v.y, walker.v.x);
  } else if (agent.has_face) {
    towards = agent.face_yaw;
  } else if (walker.wanted.x != 0 || walker.wanted.y != 0) {
    towards = std::atan2(walker.wanted.y, walker.wanted.x);
  }
  const double most = kTurnRate * dt;
  yaw = std::remainder(yaw + std::clamp(std::remainder(towards - yaw, 2 * kPi), -most, most), 2 * kPi);

  // Talk has a partner and turns.
  person.group = agent.group || !IsInParty(tick, i) ? agent.group : tick.plan.party_of_person[i];
  person.partner = agent.group ? agent.last_met : kNoPerson;
  Behaviour lower = state.lower.value_or(ByMotion(agent, speed, person.lower));
  Behaviour upper = state.upper.value_or(lower);
  if (agent.state == kChatting) {
    upper = person.speaking ? Behaviour::kTalk : Behaviour::kListen;
    if (speed > 0.2 && !walker.still) upper = lower;  // still on the way to their place
  }
  const int64_t now = tick.t_ns;
  // Who gets up keeps it until they sit again, perhaps where nothing was measured.
  if (agent.at_place) person.seating = tick.plan.places[static_cast<size_t>(agent.place)].seating;
  if (lower != person.lower) {
    if (lower == Behaviour::kSit && !agent.at_place) person.seating = {};
    person.lower = lower;
    person.lower_since_ns = now;
  }
  if (upper != person.upper) {
    person.upper = upper;
    person.upper_since_ns = now;
  }

  // Eyes: on the drone, or on the one who speaks.
  person.has_gaze = false;
  if (agent.gaze_drone >= 0 && static_cast<size_t>(agent.gaze_drone) < tick.drones.size()) {
    person.has_gaze = true;
    person.p_W_gaze = tick.drones[static_cast<size_t>(agent.gaze_drone)].p_W;
  } else if (const Group* group = agent.group ? FindGroup(tick.in, agent.group) : nullptr) {
    for (const PersonIndex other : group->members) {
      if (other == i || (!tick.state.people[other].speaking && !person.speaking)) continue;
      person.has_gaze = true;
      person.partner = other;
      person.p_W_gaze = tick.in.walkers[other].at.p_W;
      person.p_W_gaze.z += 0.93 * tick.model.people[other].stature;
      break;
    }
  }
}

}  // namespace airsim360::internal

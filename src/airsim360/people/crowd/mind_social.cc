#include <algorithm>
#include <cmath>
#include <utility>

#include "airsim360/people/crowd/mind.h"
#include "airsim360/people/crowd/parties.h"

namespace airsim360::internal {

/// Whether someone may be spoken to: walks about alone or stands in a group with room.
bool Mind::Free(PersonIndex i) const {
  const Agent& other = tick_.in.agents[i];
  if (other.commanded || other.at_place || other.hold || IsInParty(tick_, i)) return false;
  if (other.group) {
    const Group* group = FindGroup(tick_.in, other.group);
    return group && group->members.size() >= 2 && group->members.size() < kMaxGroup;
  }
  return !tick_.plan.states[other.state].stop && other.social_after_ns <= tick_.t_ns &&
         std::hypot(tick_.in.walkers[i].v.x, tick_.in.walkers[i].v.y) < 2;
}

Status Mind::Meet(bool fresh, NodeMemory& memory, double distance, double chance, double cooldown) {
  if (fresh) {
    if (std::exchange(agent_.begins, false) && agent_.group) return Status::kSuccess;
    if (tick_.t_ns < agent_.social_after_ns || agent_.group || agent_.hold || IsInParty(tick_, self_)) return Status::kFailure;
    // In front, free, on ground where one may stand; and then only if one feels like it.
    const double yaw = tick_.in.to_yaw[self_];
    const PersonIndex other = Nearest(distance, [&](PersonIndex k) {
      const Vec3d d = tick_.in.walkers[k].at.p_W - walker_.at.p_W;
      return k != agent_.last_met && d.x * std::cos(yaw) + d.y * std::sin(yaw) > 0 && Free(k);
    });
    if (other == kNoPerson) return Status::kFailure;
    const GroundKind kind = tick_.model.navmesh->Kind(walker_.at);
    const bool may_stand = kind != GroundKind::kRoad && kind != GroundKind::kCrossing && kind != GroundKind::kStairs;
    if (!may_stand || !agent_.rng.Chance(chance)) {
      agent_.social_after_ns = tick_.t_ns + 8 * kSecond;
      return Status::kFailure;
    }
    agent_.greeted = other;
    agent_.social_after_ns = tick_.t_ns + Seconds(cooldown);
    memory.t_ns = tick_.t_ns;
    Post(tick_, self_, other, kGreet);
    return Status::kRunning;
  }
  Message message;
  if (TakeMessage(agent_, kAccept, &message)) {
    const PersonIndex other = message.from;
    if (other == agent_.greeted && JoinGroup(tick_, self_, message.value)) {
      agent_.last_met = other;
      agent_.greeted = kNoPerson;
      return Status::kSuccess;
    }
    if (other != kNoPerson) Post(tick_, self_, other, kBye);
  }
  if (TakeMessage(agent_, kDecline) || tick_.t_ns - memory.t_ns > kSecond) {
    agent_.greeted = kNoPerson;
    return Status::kFailure;
  }
  return Status::kRunning;
}

Status Mind::Answer(double chance) {
  Message message;
  if (!TakeMessage(agent_, kGreet, &message) || message.from == kNoPerson) return Status::kFailure;
  const bool free =
      !agent_.group && !IsInParty(tick_, self_) && !agent_.hold && agent_.greeted == kNoPerson && !tick_.plan.states[agent_.state].stop;
  if (!free || !agent_.rng.Chance(chance)) {
    Post(tick_, self_, message.from, kDecline);
    return Status::kFailure;
  }
  Post(tick_, self_, message.from, kAccept, FoundGroup(tick_, self_, message.from));
  agent_.last_met = message.from;
  return Status::kSuccess;
}

Status Mind::Chat(bool fresh, NodeMemory& memory, double min_s, double max_s, const std::string& cause) {
  if (fresh) {
    if (!agent_.group) return Status::kFailure;
    memory.count = agent_.state;
    DropGoal(tick_, self_);
    const std::string with = agent_.last_met == kNoPerson ? "" : " with " + tick_.model.people[agent_.last_met].name;
    if (!EnterState(tick_, self_, kChatting, 0, 0, cause + with)) {
      LeaveGroup(tick_, self_);
      return Status::kFailure;
    }
  }
  Group* group = FindGroup(tick_.in, agent_.group);
  if (!group || !agent_.group) {
    EnterState(tick_, self_, static_cast<uint8_t>(memory.count), -1, 0, "message: bye");
    return Status::kSuccess;
  }
  // Who founds a group decides how long; those who come later may answer greetings of others.
  if (group->members.size() >= 2 && group->ends_ns == 0)
    group->ends_ns = tick_.t_ns + Seconds(agent_.rng.Uniform(min_s, std::max(min_s, max_s)));
  Message message;
  if (TakeMessage(agent_, kGreet, &message) && message.from != kNoPerson) {
    const bool room = group->members.size() >= 2 && group->members.size() < kMaxGroup && agent_.rng.Chance(0.5);
    Post(tick_, self_, message.from, room ? kAccept : kDecline, group->id);
  }
  TakeMessage(agent_, kBye);
  return Status::kRunning;
}

// Who leads is followed from place to place; out of sight they are walked after.
Status Mind::Accompany(bool fresh) {
  constexpr double kTouches = 1.2, kBeside = 2.5, kInSight = 8, kArrives = 1, kGone = 3;  // metres
  const PersonIndex leader = LeaderOf(tick_, self_);
  const NavMesh& mesh = *tick_.model.navmesh;
  const bool follows = leader != kNoPerson && leader != self_ && mesh.Component(walker_.at) == mesh.Component(tick_.in.walkers[leader].at);
  if (!follows) {
    if (agent_.accompanies) DropGoal(tick_, self_);
    agent_.accompanies = false;
    return Status::kFailure;
  }
  if (fresh) {
    LeavePlace(tick_, self_);
    DropGoal(tick_, self_);
    agent_.has_errand = false;
  }
  agent_.accompanies = true;
  if (agent_.group) return Status::kRunning;
  if (agent_.state == kChatting) EnterState(tick_, self_, kWalking, -1, 0, "message: bye");
  TakeMessage(agent_, kBye);
  const Walker& other = tick_.in.walkers[leader];
  const double distance = FlatDistance(other.at.p_W, walker_.at.p_W);
  const Vec2d there = Flat(other.at.p_W);
  const bool beside = distance < kTouches || (distance < kBeside && mesh.Straight(walker_.at, there));
  if (beside || (distance < kInSight && ShortCut(mesh, walker_.at, there))) {
    if (agent_.walk != Walk::kNone) DropGoal(tick_, self_);
  } else if (agent_.walk == Walk::kNone || agent_.walk == Walk::kArrived || agent_.walk == Walk::kFailed ||
             FlatDistance(agent_.goal.p_W, other.at.p_W) > kGone) {
    SetGoal(tick_, self_, other.at, 1.4 * walker_.free_speed, kArrives);
  }
  return Status::kRunning;
}

// Who leads stops the others, if all are there.
Status Mind::Gather(bool fresh, NodeMemory& memory, double min_s, double max_s, const std::string& cause) {
  constexpr double kTogether = 3;  // metres
  if (fresh) {
    if (agent_.group || !IsInParty(tick_, self_)) return Status::kFailure;
    const GroundKind kind = tick_.model.navmesh->Kind(walker_.at);
    if (kind == GroundKind::kRoad || kind == GroundKind::kCrossing || kind == GroundKind::kStairs) return Status::kFailure;
    const uint32_t party = tick_.plan.party_of_person[self_];
    std::vector<PersonIndex> members;
    for (const PersonIndex k : tick_.plan.parties[party - 1].members) {
      const Agent& other = tick_.in.agents[k];
      if (k != self_ && (!other.accompanies || tick_.plan.states[other.state].stop)) continue;
      if (FlatDistance(tick_.in.walkers[k].at.p_W, walker_.at.p_W) > kTogether) return Status::kFailure;
      members.push_back(k);
    }
    if (members.size() < 2) return Status::kFailure;
    FoundPartyTalk(tick_, party, members);
    agent_.last_met = members[members[0] == self_ ? 1 : 0];
    for (const PersonIndex k : members) {
      if (k == self_) continue;
      tick_.in.agents[k].last_met = self_;
      EnterState(tick_, k, kChatting, 0, 0, cause + " with " + tick_.model.people[self_].name);
    }
  }
  return Chat(fresh, memory, min_s, max_s, cause);
}

Status Mind::Send(uint8_t type, const Value& to, PersonIndex person, double distance) {
  const std::string& word = to.kind == Value::Kind::kText ? tick_.plan.trees.texts[to.index] : std::string("person");
  if (word == "person") {
    if (person == kNoPerson) return Status::kFailure;
    Post(tick_, self_, person, type);
  } else if (word == "group") {
    const Group* group = FindGroup(tick_.in, agent_.group);
    if (!group) return Status::kFailure;
    for (const PersonIndex other : group->members)
      if (other != self_) Post(tick_, self_, other, type);
  } else {
    std::vector<PersonIndex> others;
    tick_.in.steering.Near(Flat(walker_.at.p_W), distance, [&](PersonIndex other, Vec2d p, double) {
      if (other != self_ && std::hypot(p.x - walker_.at.p_W.x, p.y - walker_.at.p_W.y) <= distance) others.push_back(other);
    });
    std::sort(others.begin(), others.end());
    for (const PersonIndex other : others) Post(tick_, self_, other, type);
  }
  return Status::kSuccess;
}

}  // namespace airsim360::internal

#include <algorithm>
#include <cmath>

#include "airsim360/people/crowd/agent.h"

namespace airsim360::internal {
namespace {

constexpr double kRightHere = 0.15;  // metres: reach of a place

Vec2d Flat(Vec3d p) { return {p.x, p.y}; }
double Distance(Vec3d a, Vec3d b) { return std::hypot(a.x - b.x, a.y - b.y); }

Value Person(PersonIndex i) {
  Value value;
  value.kind = Value::Kind::kPerson;
  value.index = i;
  return value;
}

/// The leaves of one person's tree.
class Mind : public Leaves {
 public:
  Mind(CrowdTick& tick, PersonIndex i) : tick_(tick), self_(i), agent_(tick.in.agents[i]), walker_(tick.in.walkers[i]) {}

  Status Tick(const Tree& tree, const TreeNode& node, NodeMemory& memory, TreeRun& run) override {
    const bool fresh = memory.status != Status::kRunning;
    const auto number = [&](size_t i) { return NumberOf(tree, node, run, i); };
    const auto index = [&](size_t i) { return static_cast<uint32_t>(PortOf(tree, node, run, i).number); };
    const auto person = [&](size_t i) {
      const Value& value = PortOf(tree, node, run, i);
      return value.kind == Value::Kind::kPerson && value.index < tick_.in.agents.size() ? value.index : kNoPerson;
    };
    switch (node.node) {
      case Node::kWanderTo: {
        const Value& area = PortOf(tree, node, run, 0);
        return WanderTo(fresh, area.kind == Value::Kind::kNone ? tick_.model.people[self_].area : index(0), number(1));
      }
      case Node::kGoTo: return GoTo(fresh, PortOf(tree, node, run, 0), number(1));
      case Node::kGoToPlace: return GoToPlace(fresh, static_cast<PlaceKind>(index(0)), number(1));
      case Node::kSetState: {
        const auto state = static_cast<uint8_t>(index(0));
        if (fresh) {
          if (!EnterState(tick_, self_, state, number(1), number(2), Cause(node))) return Status::kFailure;
          const Value& wait = PortOf(tree, node, run, 3);
          const bool waits = wait.kind == Value::Kind::kText && wait.index == 0;
          return waits && agent_.state_until_ns > 0 ? Status::kRunning : Status::kSuccess;
        }
        return agent_.state == state ? Status::kRunning : Status::kSuccess;
      }
      case Node::kEndState: {
        EnterState(tick_, self_, tick_.plan.states[agent_.state].next, -1, 0, Cause(node));
        return Status::kSuccess;
      }
      case Node::kMeet: {
        const Status status = Meet(fresh, memory, number(0), number(1), number(2));
        if (status == Status::kSuccess) SetPort(tree, node, run, 3, Person(agent_.last_met));
        return status;
      }
      case Node::kAnswerGreeting: {
        const Status status = Answer(number(0));
        if (status == Status::kSuccess) SetPort(tree, node, run, 1, Person(agent_.last_met));
        return status;
      }
      case Node::kChat: return Chat(fresh, memory, number(0), number(1), Cause(node));
      case Node::kSend: return Send(static_cast<uint8_t>(index(0)), tree, PortOf(tree, node, run, 1), person(2), number(3));
      case Node::kWaitMessage: {
        if (fresh) memory.t_ns = tick_.t_ns;
        Message message;
        if (TakeMessage(agent_, static_cast<uint8_t>(index(0)), &message)) {
          if (message.from != kNoPerson) SetPort(tree, node, run, 2, Person(message.from));
          return Status::kSuccess;
        }
        return tick_.t_ns - memory.t_ns >= Seconds(number(1)) ? Status::kFailure : Status::kRunning;
      }
      case Node::kFacePerson: {
        const PersonIndex other = person(0);
        if (other == kNoPerson) return Status::kFailure;
        Face(tick_.in.walkers[other].at.p_W);
        return Turned() ? Status::kSuccess : Status::kRunning;
      }
      case Node::kLookAtDrone: return LookAtDrone(fresh, number(0), number(1), number(2), Cause(node));
      case Node::kStepAway: return StepAway(fresh, number(0));
      case Node::kChance: return Yes(agent_.rng.Chance(number(0)));
      case Node::kStateIs: return Yes(agent_.state == index(0));
      case Node::kDroneWithin: {
        double distance = 0;
        return Yes(NearestDrone(tick_, self_, &distance) >= 0 && distance <= number(0));
      }
      case Node::kPersonWithin: {
        const PersonIndex other = Nearest(number(0), [](PersonIndex) { return true; });
        if (other != kNoPerson) SetPort(tree, node, run, 1, Person(other));
        return Yes(other != kNoPerson);
      }
      case Node::kMessageWaiting:
        return Yes(std::any_of(agent_.inbox.begin(), agent_.inbox.end(), [&](const Message& m) { return m.type == index(0); }));
      case Node::kEvery: {
        // The first time comes at a random part of the period, so that a crowd does not move as one.
        if (memory.flags == 0) {
          memory.flags = 1;
          const double first = number(1) < 0 ? number(0) : number(1);
          memory.t_ns = tick_.t_ns - Seconds(number(0) - agent_.rng.Uniform() * first);
        }
        if (tick_.t_ns - memory.t_ns < Seconds(number(0))) return Status::kFailure;
        memory.t_ns = tick_.t_ns;
        return Status::kSuccess;
      }
      default: return Status::kFailure;
    }
  }

  void Halt(const Tree& tree, const TreeNode& node, NodeMemory& memory, TreeRun& run) override {
    switch (node.node) {
      case Node::kWanderTo:
      case Node::kGoTo:
      case Node::kStepAway:
        DropGoal(tick_, self_);
        break;
      case Node::kGoToPlace:
        DropGoal(tick_, self_);
        LeavePlace(tick_, self_);
        break;
      case Node::kSetState:
        // What breaks it off may have entered another state already.
        if (agent_.state == static_cast<uint8_t>(PortOf(tree, node, run, 0).number) && agent_.state_until_ns > 0)
          EnterState(tick_, self_, tick_.plan.states[agent_.state].next, -1, 0, "tree: interrupted");
        break;
      case Node::kChat:
        LeaveGroup(tick_, self_);
        if (agent_.state == kChatting)
          EnterState(tick_, self_, static_cast<uint8_t>(memory.count), -1, 0, "tree: interrupted");
        break;
      case Node::kMeet: agent_.greeted = kNoPerson; break;
      case Node::kLookAtDrone: agent_.gaze_drone = -1; break;
      default: break;
    }
  }

 private:
  static Status Yes(bool yes) { return yes ? Status::kSuccess : Status::kFailure; }
  static int64_t Seconds(double s) { return static_cast<int64_t>(s * 1e9); }
  static std::string Cause(const TreeNode& node) { return "tree: " + node.label; }

  Status OnTheWay() {
    if (agent_.walk == Walk::kArrived) return agent_.walk = Walk::kNone, Status::kSuccess;
    if (agent_.walk == Walk::kFailed || agent_.walk == Walk::kNone) return agent_.walk = Walk::kNone, Status::kFailure;
    return Status::kRunning;
  }

  // A goal that was broken off (by a chat, by a drone) is taken up again.
  Status WanderTo(bool fresh, uint32_t area, double speed) {
    if (fresh) {
      LeavePlace(tick_, self_);
      if (!agent_.has_errand) {
        const NavArea& ground = tick_.plan.ground[std::min<size_t>(area, tick_.plan.ground.size() - 1)];
        for (int attempt = 0; attempt < 8; ++attempt) {
          agent_.errand = tick_.model.navmesh->Pick(ground, agent_.rng);
          if (agent_.errand.valid() && (attempt == 7 || Distance(agent_.errand.p_W, walker_.at.p_W) > 6)) break;
        }
        if (!agent_.errand.valid()) return Status::kFailure;
        agent_.has_errand = true;
      }
      SetGoal(tick_, self_, agent_.errand, speed, 0.6);
      return Status::kRunning;
    }
    const Status status = OnTheWay();
    if (status != Status::kRunning) agent_.has_errand = false;
    return status;
  }

  Status GoTo(bool fresh, const Value& point, double speed) {
    if (!fresh) return OnTheWay();
    LeavePlace(tick_, self_);
    Vec3d p = point.point;
    if (point.kind == Value::Kind::kPerson && point.index < tick_.in.walkers.size()) p = tick_.in.walkers[point.index].at.p_W;
    if (!point.has_height && point.kind != Value::Kind::kPerson) p.z = walker_.at.p_W.z;
    const NavPoint goal = tick_.model.navmesh->Nearest(p, 3);
    if (!goal.valid()) return Status::kFailure;
    SetGoal(tick_, self_, goal, speed, 0.5);
    return Status::kRunning;
  }

  Status GoToPlace(bool fresh, PlaceKind kind, double reach) {
    if (fresh) {
      LeavePlace(tick_, self_);
      // One of the three nearest free ones.
      std::vector<std::pair<double, int32_t>> found;
      const NavMesh& mesh = *tick_.model.navmesh;
      for (size_t k = 0; k < tick_.plan.places.size(); ++k) {
        const Place& place = tick_.plan.places[k];
        if (place.kind != kind || tick_.in.place_taken[k] != kNoPerson) continue;
        const double d = Distance(place.p_W, walker_.at.p_W);
        if (d < reach && d > 2 && mesh.Component(place.approach) == mesh.Component(walker_.at)) found.emplace_back(d, static_cast<int32_t>(k));
      }
      if (found.empty()) return Status::kFailure;
      const size_t n = std::min<size_t>(3, found.size());
      std::partial_sort(found.begin(), found.begin() + static_cast<int64_t>(n), found.end());
      agent_.place = found[agent_.rng.Index(static_cast<uint32_t>(n))].second;
      tick_.in.place_taken[static_cast<size_t>(agent_.place)] = self_;
      SetGoal(tick_, self_, tick_.plan.places[static_cast<size_t>(agent_.place)].approach, 0, kRightHere);
      return Status::kRunning;
    }
    if (!agent_.at_place) {
      const Status status = OnTheWay();
      if (status == Status::kFailure) LeavePlace(tick_, self_);
      if (status != Status::kSuccess) return status;
      const Place& place = tick_.plan.places[static_cast<size_t>(agent_.place)];
      MoveFeet(tick_, self_, true);
      agent_.has_face = true;
      agent_.face_yaw = place.yaw;
    }
    return Turned() ? Status::kSuccess : Status::kRunning;
  }

  void Face(Vec3d p) {
    agent_.has_face = true;
    agent_.face_yaw = std::atan2(p.y - walker_.at.p_W.y, p.x - walker_.at.p_W.x);
  }
  bool Turned() const {
    return std::cos(tick_.in.to_yaw[self_] - agent_.face_yaw) > 0.95;
  }

  template <class Filter>
  PersonIndex Nearest(double reach, const Filter& filter) const {
    PersonIndex best = kNoPerson;
    double best_d = reach;
    tick_.in.steering.Near(Flat(walker_.at.p_W), reach, [&](PersonIndex other, Vec2d p, double z) {
      if (other == self_ || std::abs(z - walker_.at.p_W.z) > 1.5) return;
      const double d = std::hypot(p.x - walker_.at.p_W.x, p.y - walker_.at.p_W.y);
      if ((d < best_d || (d == best_d && other < best)) && filter(other)) {
        best_d = d;
        best = other;
      }
    });
    return best;
  }

  /// Whether someone may be spoken to: walks about or stands in a group with room.
  bool Free(PersonIndex i) const {
    const Agent& other = tick_.in.agents[i];
    if (other.commanded || other.at_place || other.hold) return false;
    if (other.group) {
      const Group* group = FindGroup(tick_.in, other.group);
      return group && group->members.size() >= 2 && group->members.size() < kMaxGroup;
    }
    return !tick_.plan.states[other.state].stop && other.social_after_ns <= tick_.t_ns && Length(tick_.in.walkers[i].v) < 2;
  }
  static double Length(Vec2d a) { return std::hypot(a.x, a.y); }

  Status Meet(bool fresh, NodeMemory& memory, double distance, double chance, double cooldown) {
    if (fresh) {
      if (tick_.t_ns < agent_.social_after_ns || agent_.group || agent_.hold) return Status::kFailure;
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

  Status Answer(double chance) {
    Message message;
    if (!TakeMessage(agent_, kGreet, &message) || message.from == kNoPerson) return Status::kFailure;
    const bool free = !agent_.group && !agent_.hold && agent_.greeted == kNoPerson && !tick_.plan.states[agent_.state].stop;
    if (!free || !agent_.rng.Chance(chance)) {
      Post(tick_, self_, message.from, kDecline);
      return Status::kFailure;
    }
    Post(tick_, self_, message.from, kAccept, FoundGroup(tick_, self_, message.from));
    agent_.last_met = message.from;
    return Status::kSuccess;
  }

  Status Chat(bool fresh, NodeMemory& memory, double min_s, double max_s, const std::string& cause) {
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

  Status Send(uint8_t type, const Tree&, const Value& to, PersonIndex person, double distance) {
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

  Status LookAtDrone(bool fresh, double distance, double min_s, double max_s, const std::string& cause) {
    double d = 0;
    const int drone = NearestDrone(tick_, self_, &d);
    if (fresh) {
      if (drone < 0) return Status::kFailure;
      // Most look, some point at it or take a photo.
      const double u = agent_.rng.Uniform();
      const BuiltInState state = u < 0.55 ? kLookingUp : u < 0.75 ? kPointing : kTakingPhoto;
      if (!EnterState(tick_, self_, state, min_s, max_s, cause)) return Status::kFailure;
    }
    const bool looks = agent_.state == kLookingUp || agent_.state == kPointing || agent_.state == kTakingPhoto;
    if (drone < 0 || d > distance || !looks) {
      agent_.gaze_drone = -1;
      agent_.has_face = agent_.at_place;
      if (looks) EnterState(tick_, self_, tick_.plan.states[agent_.state].next, -1, 0, "the drone is gone");
      return Status::kSuccess;
    }
    agent_.gaze_drone = drone;
    if (!agent_.at_place) Face(tick_.drones[static_cast<size_t>(drone)].p_W);
    return Status::kRunning;
  }

  Status StepAway(bool fresh, double distance) {
    double d = 0;
    const int drone = NearestDrone(tick_, self_, &d);
    if (!fresh) {
      const Status status = OnTheWay();
      return drone < 0 || d >= distance ? (DropGoal(tick_, self_), Status::kSuccess) : status;
    }
    if (drone < 0) return Status::kFailure;
    LeavePlace(tick_, self_);
    if (tick_.plan.states[agent_.state].stop) EnterState(tick_, self_, kWalking, -1, 0, "tree: StepAway");
    const Vec3d away = walker_.at.p_W - tick_.drones[static_cast<size_t>(drone)].p_W;
    const double n = std::hypot(away.x, away.y), ux = n > 0.1 ? away.x / n : 1, uy = n > 0.1 ? away.y / n : 0;
    const NavPoint goal = tick_.model.navmesh->Move(walker_.at, {walker_.at.p_W.x + ux * distance, walker_.at.p_W.y + uy * distance});
    if (Distance(goal.p_W, walker_.at.p_W) < 0.5) return Status::kFailure;
    SetGoal(tick_, self_, goal, 0, 0.4);
    return Status::kRunning;
  }

  CrowdTick& tick_;
  PersonIndex self_;
  Agent& agent_;
  Walker& walker_;
};

}  // namespace

int NearestDrone(const CrowdTick& tick, PersonIndex i, double* distance) {
  int best = -1;
  *distance = 1e9;
  Vec3d head = tick.in.walkers[i].at.p_W;
  head.z += 0.93 * tick.model.people[i].stature;
  for (size_t k = 0; k < tick.drones.size(); ++k) {
    const double d = Norm(tick.drones[k].p_W - head);
    if (d >= *distance) continue;
    *distance = d;
    best = static_cast<int>(k);
  }
  return best;
}

void Think(CrowdTick& tick, PersonIndex i) {
  Agent& agent = tick.in.agents[i];
  ForgetOld(agent, tick.t_ns);
  RunStateMachine(tick, i);
  WatchWay(tick, i);
  WatchStuck(tick, i);
  if (agent.commanded) return;
  Mind mind(tick, i);
  TickTree(tick.plan.trees.trees[agent.tree], agent.run, tick.t_ns, mind);
}

void HaltPerson(CrowdTick& tick, PersonIndex i) {
  Mind mind(tick, i);
  Agent& agent = tick.in.agents[i];
  HaltTree(tick.plan.trees.trees[agent.tree], agent.run, mind);
  if (agent.group) LeaveGroup(tick, i);
  DropGoal(tick, i);
  LeavePlace(tick, i);
  agent.has_errand = false;
  agent.gaze_drone = -1;
  agent.has_face = false;
}

}  // namespace airsim360::internal

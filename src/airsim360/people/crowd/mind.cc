#include <algorithm>
#include <cmath>

#include "airsim360/people/behaviour/person_nodes.h"
#include "airsim360/people/crowd/mind.h"
#include "airsim360/people/crowd/parties.h"

namespace airsim360::internal {
namespace {

Value Person(PersonIndex i) {
  Value value;
  value.kind = Value::Kind::kPerson;
  value.index = i;
  return value;
}

}  // namespace

int Mind::Choice(const Tree& tree, const TreeNode& node, const TreeRun& run, size_t i) const {
  const Value& value = PortOf(tree, node, run, i);
  const char kind = node.info->ports[i].kind;
  const size_t count = kind == 's'   ? tick_.plan.states.size()
                       : kind == 'm' ? tick_.plan.messages.size()
                       : kind == 'k' ? static_cast<size_t>(PlaceKind::kCount)
                                     : tick_.plan.ground.size();
  if (value.kind == Value::Kind::kNumber)
    return value.number >= 0 && value.number < static_cast<double>(count) ? static_cast<int>(value.number) : -1;
  if (value.kind != Value::Kind::kText) return -1;
  // A name that came over the blackboard.
  const std::string& name = tick_.plan.trees.texts[value.index];
  for (size_t k = 0; k < count; ++k) {
    const std::string_view at = kind == 's'   ? std::string_view(tick_.plan.states[k].name)
                                : kind == 'm' ? std::string_view(tick_.plan.messages[k])
                                : kind == 'k' ? std::string_view(kPlaceKindNames[k])
                                              : std::string_view(tick_.model.areas[k].name);
    if (at == name) return static_cast<int>(k);
  }
  return -1;
}

Status Mind::SetState(bool fresh, const Tree& tree, const TreeNode& node, TreeRun& run) {
  const int chosen = Choice(tree, node, run, 0);
  if (chosen < 0) return Status::kFailure;
  const auto state = static_cast<uint8_t>(chosen);
  if (!fresh) return agent_.state == state ? Status::kRunning : Status::kSuccess;
  const double min_s = NumberOf(tree, node, run, 1), max_s = NumberOf(tree, node, run, 2);
  if (!EnterState(tick_, self_, state, min_s, max_s, Cause(node))) return Status::kFailure;
  const Value& wait = PortOf(tree, node, run, 3);
  const bool waits = wait.kind == Value::Kind::kText && wait.index == 0;
  return waits && agent_.state_until_ns > 0 ? Status::kRunning : Status::kSuccess;
}

Status Mind::WaitMessage(bool fresh, const Tree& tree, const TreeNode& node, NodeMemory& memory, TreeRun& run) {
  const int type = Choice(tree, node, run, 0);
  if (type < 0) return Status::kFailure;
  if (fresh) memory.t_ns = tick_.t_ns;
  Message message;
  if (TakeMessage(agent_, static_cast<uint8_t>(type), &message)) {
    if (message.from != kNoPerson) SetPort(tree, node, run, 2, Person(message.from));
    return Status::kSuccess;
  }
  return tick_.t_ns - memory.t_ns >= Seconds(NumberOf(tree, node, run, 1)) ? Status::kFailure : Status::kRunning;
}

Status Mind::FacePerson(PersonIndex other) {
  if (other == kNoPerson) return Status::kFailure;
  Face(tick_.in.walkers[other].at.p_W);
  return Turned() ? Status::kSuccess : Status::kRunning;
}

Status Mind::Every(NodeMemory& memory, double period, double first) {
  // The first time comes at a random part of the period, so that a crowd does not move as one.
  if (memory.flags == 0) {
    memory.flags = 1;
    memory.t_ns = tick_.t_ns - Seconds(period - agent_.rng.Uniform() * (first < 0 ? period : first));
  }
  if (tick_.t_ns - memory.t_ns < Seconds(period)) return Status::kFailure;
  memory.t_ns = tick_.t_ns;
  return Status::kSuccess;
}

Status Mind::Tick(const Tree& tree, const TreeNode& node, NodeMemory& memory, TreeRun& run) {
  const bool fresh = memory.status != Status::kRunning;
  const auto number = [&](size_t i) { return NumberOf(tree, node, run, i); };
  const auto choice = [&](size_t i) { return Choice(tree, node, run, i); };
  const auto person = [&](size_t i) {
    const Value& value = PortOf(tree, node, run, i);
    return value.kind == Value::Kind::kPerson && value.index < tick_.in.agents.size() ? value.index : kNoPerson;
  };
  switch (static_cast<PersonNode>(node.node)) {
    case PersonNode::kWanderTo:
      return WanderTo(fresh, choice(0) < 0 ? tick_.model.people[self_].area : static_cast<uint32_t>(choice(0)), number(1));
    case PersonNode::kGoTo:
      return GoTo(fresh, PortOf(tree, node, run, 0), number(1));
    case PersonNode::kGoToPlace:
      return choice(0) < 0 ? Status::kFailure : GoToPlace(fresh, static_cast<PlaceKind>(choice(0)), number(1));
    case PersonNode::kQueue:
      return Queue(fresh, memory, number(0), number(1), number(2), Cause(node));
    case PersonNode::kSetState:
      return SetState(fresh, tree, node, run);
    case PersonNode::kEndState:
      EnterState(tick_, self_, tick_.plan.states[agent_.state].next, -1, 0, Cause(node));
      return Status::kSuccess;
    case PersonNode::kMeet: {
      const Status status = Meet(fresh, memory, number(0), number(1), number(2));
      if (status == Status::kSuccess) SetPort(tree, node, run, 3, Person(agent_.last_met));
      return status;
    }
    case PersonNode::kAnswerGreeting: {
      const Status status = Answer(number(0));
      if (status == Status::kSuccess) SetPort(tree, node, run, 1, Person(agent_.last_met));
      return status;
    }
    case PersonNode::kChat:
      return Chat(fresh, memory, number(0), number(1), Cause(node));
    case PersonNode::kSend:
      return choice(0) < 0 ? Status::kFailure : Send(static_cast<uint8_t>(choice(0)), PortOf(tree, node, run, 1), person(2), number(3));
    case PersonNode::kWaitMessage:
      return WaitMessage(fresh, tree, node, memory, run);
    case PersonNode::kAccompany:
      return Accompany(fresh);
    case PersonNode::kGather:
      return Gather(fresh, memory, number(0), number(1), Cause(node));
    case PersonNode::kFacePerson:
      return FacePerson(person(0));
    case PersonNode::kLookAtDrone:
      return LookAtDrone(fresh, number(0), number(1), number(2), Cause(node));
    case PersonNode::kStepAway:
      return StepAway(fresh, number(0));
    default:
      return Condition(tree, node, memory, run);
  }
}

Status Mind::Condition(const Tree& tree, const TreeNode& node, NodeMemory& memory, TreeRun& run) {
  const auto number = [&](size_t i) { return NumberOf(tree, node, run, i); };
  const auto choice = [&] { return Choice(tree, node, run, 0); };
  switch (static_cast<PersonNode>(node.node)) {
    case PersonNode::kChance:
      return Yes(agent_.rng.Chance(number(0)));
    case PersonNode::kStateIs:
      return Yes(agent_.state == choice());
    case PersonNode::kDroneWithin: {
      double distance = 0;
      return Yes(NearestDrone(tick_, self_, &distance) >= 0 && distance <= number(0));
    }
    case PersonNode::kPersonWithin: {
      const PersonIndex other = Nearest(number(0), [](PersonIndex) { return true; });
      if (other != kNoPerson) SetPort(tree, node, run, 1, Person(other));
      return Yes(other != kNoPerson);
    }
    case PersonNode::kMessageWaiting:
      return Yes(std::any_of(agent_.inbox.begin(), agent_.inbox.end(), [&](const Message& m) { return m.type == choice(); }));
    case PersonNode::kEvery:
      return Every(memory, number(0), number(1));
    default:
      return Status::kFailure;
  }
}

void Mind::Halt(const Tree& tree, const TreeNode& node, NodeMemory& memory, TreeRun& run) {
  switch (static_cast<PersonNode>(node.node)) {
    case PersonNode::kWanderTo:
    case PersonNode::kGoTo:
    case PersonNode::kStepAway:
      DropGoal(tick_, self_);
      break;
    case PersonNode::kGoToPlace:
      DropGoal(tick_, self_);
      LeavePlace(tick_, self_);
      break;
    case PersonNode::kQueue:
      DropGoal(tick_, self_);
      LeavePlace(tick_, self_);
      if (agent_.state == kWaiting) EnterState(tick_, self_, kWalking, -1, 0, "tree: interrupted");
      break;
    case PersonNode::kSetState:
      // What breaks it off may have entered another state already.
      if (agent_.state == Choice(tree, node, run, 0) && agent_.state_until_ns > 0)
        EnterState(tick_, self_, tick_.plan.states[agent_.state].next, -1, 0, "tree: interrupted");
      break;
    case PersonNode::kAccompany:
      agent_.accompanies = false;
      if (agent_.group) LeaveGroup(tick_, self_);
      if (agent_.state == kChatting) EnterState(tick_, self_, kWalking, -1, 0, "tree: interrupted");
      DropGoal(tick_, self_);
      break;
    case PersonNode::kGather:
      if (Group* group = FindGroup(tick_.in, agent_.group)) group->ends_ns = tick_.t_ns;  // the others do not talk on without them
      [[fallthrough]];
    case PersonNode::kChat:
      LeaveGroup(tick_, self_);
      if (agent_.state == kChatting) EnterState(tick_, self_, static_cast<uint8_t>(memory.count), -1, 0, "tree: interrupted");
      break;
    case PersonNode::kMeet:
      agent_.greeted = kNoPerson;
      break;
    case PersonNode::kLookAtDrone:
      agent_.gaze_drone = -1;
      break;
    default:
      break;
  }
}

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
  ArrangeParty(tick, i);
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
  agent.has_errand = agent.accompanies = false;
  agent.gaze_drone = -1;
  agent.has_face = false;
}

}  // namespace airsim360::internal

#include <algorithm>
#include <cstdio>

#include "airsim360/base/error.h"
#include "airsim360/people/crowd/agent.h"

namespace airsim360 {
namespace {

using namespace internal;

std::string Text(Vec3d p) {
  char text[100];
  std::snprintf(text, sizeof(text), "(%.2f, %.2f, %.2f)", p.x, p.y, p.z);
  return text;
}

/// The place nearest to p over the ground, however far and high.
NavPoint NearestAtAll(const NavMesh& mesh, Vec3d p) {
  const Box3f box = mesh.bounds();
  const Vec3d q{std::clamp<double>(p.x, box.min.x, box.max.x), std::clamp<double>(p.y, box.min.y, box.max.y), p.z};
  NavPoint nearest;
  for (const double reach : {4.0, 40.0, 400.0}) {
    double best = 1e18;
    for (double z = box.min.z; z < box.max.z + 2; z += 2) {
      const NavPoint point = mesh.Nearest({q.x, q.y, z}, reach);
      if (!point.valid() || Norm(point.p_W - q) >= best) continue;
      best = Norm(point.p_W - q);
      nearest = point;
    }
    if (nearest.valid()) break;
  }
  return nearest;
}

/// All that can be wrong with a command, told without a change. Gives back the place on the mesh that the
/// command names, if it names one.
class PersonCheck {
 public:
  PersonCheck(const CrowdModel& model, const CrowdState& state, PersonIndex person)
      : model_(model), in_(*state.internals), i_(person), walker_(in_.walkers[person]) {}

  NavPoint operator()(const SpawnPerson& spawn) const {
    if (walker_.present) throw InputError(Name() + " is in the world already");
    return FreePlace(spawn.p_W);
  }
  NavPoint operator()(const MovePerson& move) const {
    MustBePresent();
    return FreePlace(move.p_W);
  }
  NavPoint operator()(const RemovePerson&) const { return Present(); }
  NavPoint operator()(const SendPerson& send) const {
    MustBePresent();
    const NavPoint goal = OnMesh(send.p_W);
    if (!(send.speed >= 0 && send.speed <= 6)) throw InputError("speed " + std::to_string(send.speed) + " is not in 0 … 6 m/s");
    if (!model_.navmesh->FindPath(walker_.at, goal).complete)
      throw InputError(Name() + " cannot reach " + Text(send.p_W) + ": there is no way from " + Text(walker_.at.p_W));
    return goal;
  }
  NavPoint operator()(const SetPersonState& set) const {
    MustBePresent();
    const auto& states = model_.plan->states;
    if (std::ranges::find(states, set.state, &StateDef::name) == states.end()) {
      std::vector<std::string> names;
      for (const StateDef& state : states) names.push_back(state.name);
      throw InputError(UnknownChoiceMessage("state", set.state, names));
    }
    if (!(set.seconds >= 0 && set.seconds <= 86400)) throw InputError("seconds " + std::to_string(set.seconds) + " is not in 0 … 86400");
    return {};
  }
  NavPoint operator()(const MessagePerson& message) const {
    MustBePresent();
    const std::vector<std::string>& messages = model_.plan->messages;
    if (std::ranges::find(messages, message.type) == messages.end())
      throw InputError(UnknownChoiceMessage("message", message.type, messages));
    return {};
  }
  NavPoint operator()(const ReleasePerson&) const { return Present(); }

 private:
  std::string Name() const { return model_.people[i_].name; }
  void MustBePresent() const {
    if (!walker_.present) throw InputError(Name() + " is not in the world (spawn them first)");
  }
  NavPoint Present() const {
    MustBePresent();
    return {};
  }
  NavPoint OnMesh(Vec3d p) const {
    const NavPoint point = model_.navmesh->Nearest(p, 1);
    if (point.valid()) return point;
    const NavPoint near = NearestAtAll(*model_.navmesh, p);
    throw InputError("nobody can stand at " + Text(p) + (near.valid() ? "; the nearest place is " + Text(near.p_W) : ""));
  }
  // On the mesh, and nobody else is there.
  NavPoint FreePlace(Vec3d p) const {
    const NavPoint point = OnMesh(p);
    for (PersonIndex k = 0; k < in_.walkers.size(); ++k) {
      const Walker& other = in_.walkers[k];
      if (k == i_ || !other.present || Norm(other.at.p_W - point.p_W) >= 2 * kBodyRadius) continue;
      throw InputError(Text(point.p_W) + " is taken by " + model_.people[k].name);
    }
    return point;
  }

  const CrowdModel& model_;
  const CrowdInternals& in_;
  PersonIndex i_;
  const Walker& walker_;
};

/// Does what PersonCheck has found right; `point` is what it gave back.
class Commander {
 public:
  Commander(CrowdTick& tick, PersonIndex person, const NavPoint& point)
      : tick_(tick), i_(person), point_(point), agent_(tick.in.agents[person]), walker_(tick.in.walkers[person]) {}

  void operator()(const SpawnPerson& spawn) {
    Place(spawn.yaw);
    walker_.present = true;
    tick_.state.people[i_].visible = true;
  }
  void operator()(const MovePerson& move) {
    HaltPerson(tick_, i_);
    tick_.state.people[i_].seating = {};
    Place(move.yaw);
  }
  void operator()(const RemovePerson&) {
    HaltPerson(tick_, i_);
    walker_.present = false;
    tick_.state.people[i_].visible = false;
  }
  void operator()(const SendPerson& send) {
    HaltPerson(tick_, i_);
    agent_.commanded = true;
    if (tick_.plan.states[agent_.state].stop) EnterState(tick_, i_, kWalking, -1, 0, "command");
    SetGoal(tick_, i_, point_, send.speed, 0.3);
  }
  void operator()(const SetPersonState& set) {
    const auto& states = tick_.plan.states;
    const auto found = std::ranges::find(states, set.state, &StateDef::name);
    const auto state = static_cast<uint8_t>(found - states.begin());
    agent_.left_ns[state] = -1;  // a command knows no cool-down
    EnterState(tick_, i_, state, set.seconds > 0 ? set.seconds : -1, set.seconds, "command");
  }
  void operator()(const MessagePerson& message) {
    const auto found = std::ranges::find(tick_.plan.messages, message.type);
    Post(tick_, kNoPerson, i_, static_cast<uint8_t>(found - tick_.plan.messages.begin()));
  }
  void operator()(const ReleasePerson&) {
    agent_.commanded = false;
    DropGoal(tick_, i_);
  }

 private:
  void Place(double yaw) {
    walker_.at = point_;
    walker_.v = {};
    agent_.offset = {};
    tick_.in.from[i_] = point_.p_W;
    tick_.in.from_yaw[i_] = tick_.in.to_yaw[i_] = yaw;
    tick_.state.people[i_].p_WP = point_.p_W;
    tick_.state.people[i_].yaw = yaw;
  }

  CrowdTick& tick_;
  PersonIndex i_;
  const NavPoint& point_;
  Agent& agent_;
  Walker& walker_;
};

NavPoint Checked(const CrowdModel& model, const CrowdState& state, PersonIndex person, const PersonAction& action) {
  if (person >= model.people.size())
    throw InputError("no person " + std::to_string(person) + ": there are " + std::to_string(model.people.size()));
  return std::visit(PersonCheck(model, state, person), action);
}

}  // namespace

void CheckPersonCommand(const CrowdModel& model, const CrowdState& state, PersonIndex person, const PersonAction& action) {
  Checked(model, state, person, action);
}

void CommandPerson(const CrowdModel& model, CrowdState& state, PersonIndex person, const PersonAction& action,
                   std::vector<CrowdEvent>* events) {
  const NavPoint point = Checked(model, state, person, action);
  CrowdTick tick{model, *model.plan, state, *state.internals, {}, events, state.t_ns};
  std::visit(Commander(tick, person, point), action);
}

}  // namespace airsim360

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

class Commander {
 public:
  Commander(CrowdTick& tick, PersonIndex person) : tick_(tick), i_(person), agent_(tick.in.agents[person]), walker_(tick.in.walkers[person]) {}

  void operator()(const SpawnPerson& spawn) {
    if (walker_.present) throw InputError(Name() + " is in the world already");
    Place(spawn.p_W, spawn.yaw);
    walker_.present = true;
    tick_.state.people[i_].visible = true;
  }
  void operator()(const MovePerson& move) {
    MustBePresent();
    HaltPerson(tick_, i_);
    Place(move.p_W, move.yaw);
  }
  void operator()(const RemovePerson&) {
    MustBePresent();
    HaltPerson(tick_, i_);
    walker_.present = false;
    tick_.state.people[i_].visible = false;
  }
  void operator()(const SendPerson& send) {
    MustBePresent();
    const NavPoint goal = OnMesh(send.p_W);
    if (!(send.speed >= 0 && send.speed <= 6)) throw InputError("speed " + std::to_string(send.speed) + " is not in 0 … 6 m/s");
    HaltPerson(tick_, i_);
    if (!tick_.model.navmesh->FindPath(walker_.at, goal).complete)
      throw InputError(Name() + " cannot reach " + Text(send.p_W) + ": there is no way from " + Text(walker_.at.p_W));
    agent_.commanded = true;
    if (tick_.plan.states[agent_.state].stop) EnterState(tick_, i_, kWalking, -1, 0, "command");
    SetGoal(tick_, i_, goal, send.speed, 0.3);
  }
  void operator()(const SetPersonState& set) {
    MustBePresent();
    std::vector<std::string> names;
    for (const StateDef& state : tick_.plan.states) names.push_back(state.name);
    const auto found = std::find(names.begin(), names.end(), set.state);
    if (found == names.end()) throw InputError(UnknownChoiceMessage("state", set.state, names));
    const auto state = static_cast<uint8_t>(found - names.begin());
    if (!(set.seconds >= 0 && set.seconds <= 86400)) throw InputError("seconds " + std::to_string(set.seconds) + " is not in 0 … 86400");
    agent_.left_ns[state] = -1;  // a command knows no cool-down
    EnterState(tick_, i_, state, set.seconds > 0 ? set.seconds : -1, set.seconds, "command");
  }
  void operator()(const MessagePerson& message) {
    MustBePresent();
    const auto found = std::find(tick_.plan.messages.begin(), tick_.plan.messages.end(), message.type);
    if (found == tick_.plan.messages.end()) throw InputError(UnknownChoiceMessage("message", message.type, tick_.plan.messages));
    Post(tick_, kNoPerson, i_, static_cast<uint8_t>(found - tick_.plan.messages.begin()));
  }
  void operator()(const ReleasePerson&) {
    MustBePresent();
    agent_.commanded = false;
    DropGoal(tick_, i_);
  }

 private:
  std::string Name() const { return tick_.model.people[i_].name; }
  void MustBePresent() const {
    if (!walker_.present) throw InputError(Name() + " is not in the world (spawn them first)");
  }
  NavPoint OnMesh(Vec3d p) const {
    const NavMesh& mesh = *tick_.model.navmesh;
    const NavPoint point = mesh.Nearest(p, 1);
    if (point.valid()) return point;
    const NavPoint near = NearestAtAll(mesh, p);
    throw InputError("nobody can stand at " + Text(p) + (near.valid() ? "; the nearest place is " + Text(near.p_W) : ""));
  }
  void Place(Vec3d p, double yaw) {
    const NavPoint point = OnMesh(p);
    for (PersonIndex k = 0; k < tick_.in.walkers.size(); ++k) {
      const Walker& other = tick_.in.walkers[k];
      if (k == i_ || !other.present || Norm(other.at.p_W - point.p_W) >= 2 * kBodyRadius) continue;
      throw InputError(Text(point.p_W) + " is taken by " + tick_.model.people[k].name);
    }
    walker_.at = point;
    walker_.v = {};
    agent_.offset = {};
    tick_.in.from[i_] = point.p_W;
    tick_.in.from_yaw[i_] = tick_.in.to_yaw[i_] = yaw;
    tick_.state.people[i_].p_WP = point.p_W;
    tick_.state.people[i_].yaw = yaw;
  }

  CrowdTick& tick_;
  PersonIndex i_;
  Agent& agent_;
  Walker& walker_;
};

}  // namespace

void CommandPerson(const CrowdModel& model, CrowdState& state, PersonIndex person, const PersonAction& action,
                   std::vector<CrowdEvent>* events) {
  if (person >= model.people.size())
    throw InputError("no person " + std::to_string(person) + ": there are " + std::to_string(model.people.size()));
  CrowdTick tick{model, *model.plan, state, *state.internals, {}, events, state.t_ns};
  std::visit(Commander(tick, person), action);
}

}  // namespace airsim360

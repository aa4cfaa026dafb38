#include <algorithm>
#include <cmath>
#include <utility>

#include "airsim360/math/angles.h"
#include "airsim360/math/plane.h"
#include "airsim360/people/crowd/agent.h"
#include "airsim360/people/crowd/mind.h"
#include "airsim360/people/crowd/parties.h"

namespace airsim360::internal {
namespace {

constexpr double kNearGate = 0.3, kSeesGate = 2;  // metres
constexpr double kAheadOfRoad = 2.2;              // metres to a crossing where people stop at a red light: ways cut its corners
constexpr int64_t kCycle = 44 * kSecond;          // of traffic lights
constexpr int64_t kShift = 800'000'000;           // of feet from the mesh to a seat beside it and back
constexpr int64_t kNoProgress = 4 * kSecond, kStuck = 30 * kSecond;

/// The crossing that the way enters within kAheadOfRoad; -1 = none.
int CrossingAhead(const NavMesh& mesh, const Agent& agent, Vec2d p) {
  double left = kAheadOfRoad;
  for (size_t k = agent.gate; k < agent.gates.size() && left > 0; ++k) {
    const Vec2d target = NearestInGate(agent.gates[k], p), to = target - p;
    const double distance = Norm(to), most = std::min(distance, left);
    for (double s = 0.35; s < most + 0.35 && distance > 1e-6; s += 0.35) {
      const int crossing = mesh.CrossingAt(p + to * (std::min(s, most) / distance));
      if (crossing >= 0) return crossing;
    }
    left -= distance;
    p = target;
  }
  return -1;
}

/// What stairs and slopes leave of the speed on the plain, over the ground. Stairs: 0.610 m/s up and 0.694 m/s
/// down of 1.34 (U. Weidmann, 1993). Slopes: exp(-3.5 |slope + 0.05|) (W. Tobler, 1993).
double PaceOn(const NavMesh& mesh, const NavPoint& at, Vec2d ahead) {
  const double n = Norm(ahead), look = 0.6;
  if (n < 1e-6) return 1;
  // Over the next two paces, so that a kerb is no slope.
  double z = mesh.GroundHeight(at.p_W.x, at.p_W.y, at.p_W.z), rise[2];
  for (int k = 0; k < 2; ++k) {
    const Vec2d p = Flat(at.p_W) + ahead * ((k + 1) * look / n);
    const double next = mesh.GroundHeight(p.x, p.y, z);
    rise[k] = (next - z) / look;
    z = next;
  }
  const double slope = rise[0] * rise[1] <= 0 ? 0 : std::abs(rise[0]) < std::abs(rise[1]) ? rise[0] : rise[1];
  if (std::abs(slope) < 0.04) return 1;
  if (mesh.Kind(at) == GroundKind::kStairs) return slope > 0 ? 0.610 / 1.34 : 0.694 / 1.34;
  return std::clamp(std::exp(-3.5 * (std::abs(slope + 0.05) - 0.05)), 0.3, 1.2);
}

/// Walkers have green for 15 s of each cycle, the two directions by turns.
bool Green(const NavMesh::Crossing& crossing, int64_t t_ns) {
  const int64_t t = (t_ns + (crossing.phase ? kCycle / 2 : 0)) % kCycle;
  return t < 15 * kSecond;
}

/// 0 … 1: those who want somewhere and have stood for a second begin to squeeze, after three they push.
double PressedBy(const Agent& agent, int64_t t_ns) {
  const bool wants = agent.walk == Walk::kOnTheWay || (agent.accompanies && agent.walk == Walk::kNone);
  if (!wants || agent.hold) return 0;
  return std::clamp(static_cast<double>(t_ns - agent.progress_ns - kSecond) / (2.0 * kSecond), 0.0, 1.0);
}

/// People who talk or stand let someone pass who cannot get on because of them.
bool SomebodyWantsThrough(const CrowdTick& tick, Vec2d p) {
  bool found = false;
  tick.in.steering.Near(
      p, 1, [&](PersonIndex other, Vec2d q, double) { found |= Norm(q - p) < 1 && PressedBy(tick.in.agents[other], tick.t_ns) >= 1; });
  return found;
}

/// Strollers do not walk like arrows: their heading wanders about the straight way (an Ornstein-Uhlenbeck process). At 5 Hz.
void SwayHeading(Agent& agent) {
  constexpr double kSpread = 0.14, kMemory = 2.5;  // tangent, seconds
  static const double keep = std::exp(-kThinkEvery * static_cast<double>(kCrowdTickNs) * 1e-9 / kMemory);
  agent.sway = agent.sway * keep + kSpread * std::sqrt(1 - keep * keep) * agent.rng.Normal();
}

/// Where somebody goes, smoothed over 0.6 s; who turns around has turned at once.
void FollowHeading(Agent& agent, Vec2d v) {
  constexpr double kShare = static_cast<double>(kCrowdTickNs) * 1e-9 / 0.6;
  const Vec2d ahead = v * (1 / Norm(v));
  const Vec2d mixed = Dot(agent.heading, ahead) < 0 ? ahead : agent.heading * (1 - kShare) + ahead * kShare;
  agent.heading = mixed * (1 / Norm(mixed));
}

/// The place for somebody who stands, and from time to time one a little step away from it. At 5 Hz.
void ShiftWeight(CrowdTick& tick, Agent& agent) {
  constexpr double kEvery = 7, kStep = 0.15;  // seconds, metres
  if (!agent.stands || !agent.rng.Chance(kThinkEvery * static_cast<double>(kCrowdTickNs) * 1e-9 / kEvery)) return;
  const double angle = agent.rng.Uniform(0, kTau), distance = kStep * std::sqrt(agent.rng.Uniform());
  agent.shift = {distance * std::cos(angle), distance * std::sin(angle)};
  agent.shifts_until_ns = tick.t_ns + kSecond + kSecond / 2;
}

/// Somebody stands at `place`, or makes the little step that they feel like.
void Stand(CrowdTick& tick, Agent& agent, Walker& walker, Vec2d place) {
  agent.stands = true;
  const Vec2d to = place + agent.shift - Flat(walker.at.p_W);
  const double d = Norm(to);
  const bool steps = tick.t_ns < agent.shifts_until_ns && d > 0.03;
  walker.still = !steps && !SomebodyWantsThrough(tick, Flat(walker.at.p_W));
  if (steps) walker.wanted = to * (std::min(0.25, 2 * d) / d);
}

}  // namespace

bool ShortCut(const NavMesh& mesh, const NavPoint& at, Vec2d target) {
  if (!mesh.Straight(at, target)) return false;
  const Vec2d p = Flat(at.p_W), to = target - p;
  const double distance = Norm(to), here = GroundCost(mesh.Kind(at));
  for (double s = 0.7; s < std::min(distance, 4.0); s += 0.8)
    if (GroundCost(mesh.Kind(mesh.Move(at, p + to * (s / distance)))) > 2 * here) return false;
  return true;
}

void LeavePlace(CrowdTick& tick, PersonIndex i) {
  Agent& agent = tick.in.agents[i];
  if (agent.place < 0) return;
  tick.in.place_taken[static_cast<size_t>(agent.place)] = kNoPerson;
  if (agent.at_place) MoveFeet(tick, i, false);
  agent.place = -1;
  agent.has_face = false;
}

void MoveFeet(CrowdTick& tick, PersonIndex i, bool to_place) {
  Agent& agent = tick.in.agents[i];
  const Vec3d before = FeetOf(tick.plan, tick.in, i, tick.t_ns);
  agent.at_place = to_place;
  agent.offset = {};
  agent.offset = before - FeetOf(tick.plan, tick.in, i, tick.t_ns);
  agent.offset_ns = tick.t_ns;
}

Vec3d FeetOf(const CrowdPlan& plan, const CrowdInternals& in, PersonIndex i, int64_t t_ns) {
  const Agent& agent = in.agents[i];
  const Vec3d base = agent.at_place ? plan.places[static_cast<size_t>(agent.place)].p_W : in.walkers[i].at.p_W;
  const int64_t since = t_ns - agent.offset_ns;
  if (since >= kShift) return base;
  return base + agent.offset * (1 - static_cast<double>(since) / static_cast<double>(kShift));
}

void SetGoal(CrowdTick& tick, PersonIndex i, const NavPoint& goal, double speed, double reach) {
  Agent& agent = tick.in.agents[i];
  agent.goal = goal;
  agent.goal_speed = speed;
  agent.goal_reach = reach;
  agent.progress_ns = tick.t_ns;
  agent.progress_p = tick.in.walkers[i].at.p_W;
  agent.gates.clear();
  agent.gate = 0;
  if (agent.walk != Walk::kWaitsForPath) tick.in.path_queue.push_back(i);
  agent.walk = Walk::kWaitsForPath;
}

void DropGoal(CrowdTick& tick, PersonIndex i) {
  Agent& agent = tick.in.agents[i];
  // An entry in the queue is passed over when its turn comes.
  agent.walk = Walk::kNone;
  agent.gates.clear();
  agent.hold = false;
  std::erase(tick.in.path_queue, i);
}

void FindWays(CrowdTick& tick) {
  std::vector<PersonIndex>& queue = tick.in.path_queue;
  const size_t n = std::min(queue.size(), kPathsPerTick);
  for (size_t k = 0; k < n; ++k) {
    Agent& agent = tick.in.agents[queue[k]];
    const Walker& walker = tick.in.walkers[queue[k]];
    if (agent.walk != Walk::kWaitsForPath || !walker.present) continue;
    const NavPath path = tick.model.navmesh->FindPath(walker.at, agent.goal);
    agent.gates = GatesOf(*tick.model.navmesh, path);
    agent.gate = 0;
    agent.walk = agent.gates.empty() || !path.complete ? Walk::kFailed : Walk::kOnTheWay;
  }
  queue.erase(queue.begin(), queue.begin() + static_cast<int64_t>(n));
}

void WatchWay(CrowdTick& tick, PersonIndex i) {
  Agent& agent = tick.in.agents[i];
  const Walker& walker = tick.in.walkers[i];
  agent.hold = false;
  SwayHeading(agent);
  ShiftWeight(tick, agent);
  // Who walks beside others gets on if they do, or are where they should be.
  const bool is_beside = agent.walk == Walk::kNone && tick.t_ns - agent.way_ns > kThinkEvery * kCrowdTickNs;
  if (is_beside || (agent.walk == Walk::kNone && Norm(walker.at.p_W - agent.progress_p) > 0.5)) {
    agent.progress_p = walker.at.p_W;
    agent.progress_ns = tick.t_ns;
  }
  if (agent.walk != Walk::kOnTheWay) return;
  const NavMesh& mesh = *tick.model.navmesh;
  const Vec2d p = Flat(walker.at.p_W), to = NearestInGate(agent.gates[agent.gate], p) - p;
  const double distance = Norm(to);
  agent.pace = PaceOn(mesh, walker.at, to);

  // At the kerb of a crossing whose light is red.
  if (!mesh.crossings().empty() && mesh.CrossingAt(p) < 0) {
    const int ahead = CrossingAhead(mesh, agent, p);
    if (ahead >= 0) {
      const NavMesh::Crossing& crossing = mesh.crossings()[static_cast<size_t>(ahead)];
      agent.hold = crossing.signal && !Green(crossing, tick.t_ns);
    }
  }

  // Pushed aside, one may stand before a wall: another way from here, once a second.
  if (walker.blocked > 0.3 && tick.t_ns % kSecond < kThinkEvery * kCrowdTickNs && distance > 1e-6 &&
      !mesh.Straight(walker.at, p + to * std::min(1.0, kSeesGate / distance))) {
    const int64_t since = agent.progress_ns;
    SetGoal(tick, i, agent.goal, agent.goal_speed, agent.goal_reach);
    agent.progress_ns = since;
    return;
  }

  // The next gate but one is seen already.
  if (agent.gate + 1 < agent.gates.size() && distance < 4 && ShortCut(mesh, walker.at, NearestInGate(agent.gates[agent.gate + 1], p)))
    ++agent.gate;

  // Progress: half a metre from the last place where there was some.
  if (Norm(walker.at.p_W - agent.progress_p) > 0.5 || agent.hold || walker.waits || agent.party_pace < 0.5 ||
      tick.plan.states[agent.state].stop || agent.group) {
    agent.progress_p = walker.at.p_W;
    agent.progress_ns = tick.t_ns;
    return;
  }
  const int64_t still = tick.t_ns - agent.progress_ns;
  if (still <= kNoProgress || still % kNoProgress >= kThinkEvery * kCrowdTickNs) return;
  if (still > 2 * kNoProgress && !agent.commanded) {
    // Somewhere else, then; a tree hears that it failed.
    agent.walk = Walk::kFailed;
    agent.has_errand = false;
    return;
  }
  // Another way from here.
  const int64_t since = agent.progress_ns;
  SetGoal(tick, i, agent.goal, agent.goal_speed, agent.goal_reach);
  agent.progress_ns = since;
}

void WatchStuck(CrowdTick& tick, PersonIndex i) {
  Agent& agent = tick.in.agents[i];
  const Vec3d& p = tick.in.walkers[i].at.p_W;
  // Whoever stands on purpose is not stuck; goals may have changed meanwhile.
  if (agent.walk == Walk::kOnTheWay || agent.walk == Walk::kWaitsForPath) agent.way_ns = tick.t_ns;
  const bool stands = tick.t_ns - agent.way_ns > kSecond || agent.hold || tick.in.walkers[i].waits || agent.group ||
                      agent.party_pace < 0.5 || tick.plan.states[agent.state].stop || agent.at_place ||
                      (agent.commanded && agent.walk != Walk::kOnTheWay);
  if (stands || Norm(p - agent.stuck_p) > 0.5) {
    agent.stuck_p = p;
    agent.stuck_ns = tick.t_ns;
  } else if (tick.t_ns - agent.stuck_ns > kStuck) {
    AddEvent(tick,
             {.kind = CrowdEvent::Kind::kStuck, .t_ns = tick.t_ns, .person = i, .from = {}, .to = {}, .text = "no progress for 30 s"});
    agent.stuck_ns = tick.t_ns;
  }
}

namespace {

/// To the place in a talk, then stand there.
void WantInTalk(CrowdTick& tick, const Group& group, PersonIndex i) {
  Agent& agent = tick.in.agents[i];
  Walker& walker = tick.in.walkers[i];
  const Vec2d p = Flat(walker.at.p_W), place = SlotOf(group, i), to = place - p;
  const double d = Norm(to);
  agent.has_face = true;
  agent.face_yaw = std::atan2(group.centre.y - p.y, group.centre.x - p.x);
  const bool there = agent.stands && agent.stand == place;
  if (!there && d > 0.12 && tick.t_ns - group.changed_ns < 6 * kSecond) {
    agent.stands = false;
    walker.wanted = to * (std::min(0.9, 2 * d) / d);
    return;
  }
  if (!agent.stands || d < 0.4) agent.stand = d < 0.4 ? place : p;
  Stand(tick, agent, walker, agent.stand);
}

/// Gate by gate; slower before the end.
void WantOnTheWay(CrowdTick& tick, PersonIndex i) {
  Agent& agent = tick.in.agents[i];
  Walker& walker = tick.in.walkers[i];
  const Vec2d p = Flat(walker.at.p_W);
  while (agent.gate + 1 < agent.gates.size() && HasPassed(agent.gates[agent.gate], p)) ++agent.gate;
  Vec2d to = NearestInGate(agent.gates[agent.gate], p) - p;
  if (agent.gate + 1 < agent.gates.size() && Norm(to) < kNearGate) {
    // Not before the next one is seen: the corner of a wall may be between.
    const Vec2d next = NearestInGate(agent.gates[agent.gate + 1], p);
    if (tick.model.navmesh->Straight(walker.at, next)) {
      ++agent.gate;
      to = next - p;
    }
  }
  const double d = Norm(to);
  const bool last = agent.gate + 1 == agent.gates.size();
  walker.rest = d + agent.gates[agent.gate].onward;
  if (last && d < agent.goal_reach) {
    agent.walk = Walk::kArrived;
    return;
  }
  double speed =
      (agent.goal_speed > 0 ? agent.goal_speed : walker.free_speed) * tick.plan.states[agent.state].speed * agent.pace * agent.party_pace;
  if (last) speed = std::min(speed, 0.4 + 1.2 * d);
  // Turning around comes before walking away.
  const double yaw = tick.in.to_yaw[i];
  if (Norm(walker.v) < 0.3 && to.x * std::cos(yaw) + to.y * std::sin(yaw) < 0.3 * d) speed *= 0.3;
  if (d > 1e-6) walker.wanted = to * (speed / d);
  // Who strolls sways, but not at a corner, in a press or on an errand that someone has set.
  const double share = agent.commanded || agent.goal_speed > 0 ? 0 : std::clamp(d / 3, 0.0, 1.0) * (1 - walker.pressed);
  walker.wanted = walker.wanted + Vec2d{-walker.wanted.y, walker.wanted.x} * (agent.sway * share);
  if (Norm(walker.v) > 0.3) FollowHeading(agent, walker.v);
}

}  // namespace

void WantVelocities(CrowdTick& tick) {
  for (PersonIndex i = 0; i < tick.in.agents.size(); ++i) {
    Agent& agent = tick.in.agents[i];
    Walker& walker = tick.in.walkers[i];
    walker.wanted = {};
    walker.still = false;
    walker.rest = 0;
    walker.pressed = PressedBy(agent, tick.t_ns);
    walker.aside = agent.at_place ? Flat(FeetOf(tick.plan, tick.in, i, tick.t_ns) - walker.at.p_W) : Vec2d{};
    if (!walker.present) continue;
    const StateDef& state = tick.plan.states[agent.state];
    const bool stood = std::exchange(agent.stands, false);
    const auto stand_here = [&] {
      if (!stood) agent.stand = Flat(walker.at.p_W);
      Stand(tick, agent, walker, agent.stand);
    };

    if (agent.group) {
      agent.stands = stood;
      if (const Group* group = FindGroup(tick.in, agent.group)) WantInTalk(tick, *group, i);
    } else if (agent.at_place) {
      walker.still = true;
    } else if (state.stop && agent.walk != Walk::kOnTheWay) {
      stand_here();
    } else if (agent.accompanies && agent.walk == Walk::kNone) {
      if (const PersonIndex leader = LeaderOf(tick, i); leader != kNoPerson && !WantBeside(tick, i, leader)) stand_here();
    } else if (!state.stop && agent.walk == Walk::kOnTheWay && !agent.hold) {
      WantOnTheWay(tick, i);
    }
  }
}

}  // namespace airsim360::internal

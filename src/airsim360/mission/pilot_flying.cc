// The leaves that fly.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "airsim360/base/error.h"
#include "airsim360/mission/pilot_leaves.h"
#include "airsim360/routes/roadmap.h"
#include "airsim360/sim/trajectory_reference.h"

namespace airsim360 {
namespace {

using behaviour::Status;
using Phase = DroneInHand::Phase;

constexpr double kStill = 0.2, kStopLimit = 6;    // m/s; seconds for coming to rest
constexpr double kThere = 0.5, kLateLimit = 10;   // metres from the goal; seconds after the way should have ended
constexpr double kFaces = 0.05, kTurnLimit = 15;  // rad, seconds
constexpr int64_t kSetpointNs = 100'000'000, kSetpointLifeNs = 500'000'000;  // of Follow

std::string Metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f m", value);
  return text;
}

}  // namespace

bool PilotLeaves::Flies() const {
  const FlightMode mode = drone_.autopilot.mode;
  return mode != FlightMode::kDisarmed && mode != FlightMode::kGround;
}

double PilotLeaves::Heading() const { return std::atan2(drone_.motion.X_WB.R.m[1][0], drone_.motion.X_WB.R.m[0][0]); }

double PilotLeaves::Bearing(Vec3d p_W) const {
  const Vec3d way = p_W - drone_.motion.X_WB.p;
  return std::atan2(way.y, way.x);
}

bool PilotLeaves::FacesWithin(Vec3d p_W, double error) const {
  return std::abs(std::remainder(Bearing(p_W) - Heading(), 2 * M_PI)) < error;
}

void PilotLeaves::Command(const airsim360::Command& command, int64_t timeout_ns) {
  commands_.push_back({mission_.vehicle, FlightCommand{command, timeout_ns}});
  hand_.command_id.reset();
  hand_.commanded = true;
  hand_.taken = false;
  memory_.refused.clear();
}

void PilotLeaves::Enter(Phase phase) {
  hand_.phase = phase;
  hand_.since_ns = state_.t_ns;
}

// Flies a way, if there is one to fly.
void PilotLeaves::Go(const MissionWay& way, std::optional<Vec3d> look_at) {
  if (!way.problem.empty()) throw InputError(way.problem);
  hand_.goal = way.goal;
  hand_.duration = way.path ? way.path->duration() : 0;
  if (!way.path) return;
  Command(TrajectoryCommand{look_at ? std::make_shared<const PlannedReference>(way.path, *look_at)
                                    : std::make_shared<const PlannedReference>(way.path, std::nullopt, Heading())});
}

void PilotLeaves::CheckHand(const Node& node) const {
  if (hand_.owner != &node) throw InputError("another node has taken the drone");
  if (hand_.taken) throw InputError("the drone was given another command from outside");
  if (hand_.commanded && !memory_.refused.empty()) throw InputError("refused: " + memory_.refused);
}

Status PilotLeaves::Fly(const Node& node, bool fresh) {
  const auto kind = static_cast<MissionNode>(node.node);
  if (fresh) {
    hand_ = {};
    hand_.owner = &node;
  } else {
    CheckHand(node);
  }
  switch (kind) {
    case MissionNode::kTakeoff:
      if (fresh && Flies()) return Status::kSuccess;
      return UntilDone(fresh, TakeoffCommand{Number(node, 0), Number(node, 1)});
    case MissionNode::kLand:
      if (fresh && !Flies()) return Status::kSuccess;
      return UntilDone(fresh, LandCommand{Number(node, 0)});
    case MissionNode::kReturn:
      if (fresh && !Flies()) return Status::kSuccess;
      return UntilDone(fresh, ReturnCommand{.height = Number(node, 0)});
    default:
      break;
  }
  if (!Flies()) throw InputError(fresh ? "the drone stands; Takeoff comes first" : "the drone does not fly any more");
  if (kind == MissionNode::kGoto) return Goto(node, fresh);
  if (kind == MissionNode::kOrbit) return Orbit(node, fresh);
  if (kind == MissionNode::kFollow) return Follow(node, fresh);
  return Look(node, fresh);
}

Status PilotLeaves::UntilDone(bool fresh, const airsim360::Command& command) {
  if (fresh) {
    Command(command);
    return Status::kRunning;
  }
  return drone_.autopilot.flags & kCommandDone ? Status::kSuccess : Status::kRunning;
}

// Ways begin at rest.
Status PilotLeaves::Stopped(bool fresh) {
  if (fresh) {
    Enter(Phase::kStopping);
    if (Norm(drone_.motion.v_WB) < kStill) return Status::kSuccess;
    Command(HoverCommand{});
  }
  return Norm(drone_.motion.v_WB) < kStill || Seconds(hand_.since_ns) > kStopLimit ? Status::kSuccess : Status::kRunning;
}

Status PilotLeaves::Arrived() const {
  const double late = Seconds(hand_.since_ns) - hand_.duration, away = Norm(drone_.motion.X_WB.p - hand_.goal);
  if (late >= 0 && away < kThere) return Status::kSuccess;
  if (late > kLateLimit) throw InputError("it came only within " + Metres(away) + " of its goal");
  return Status::kRunning;
}

Status PilotLeaves::Goto(const Node& node, bool fresh) {
  if (fresh || hand_.phase == Phase::kStopping) {
    if (Stopped(fresh) == Status::kRunning) return Status::kRunning;
    TrajectoryLimits limits;
    limits.speed = Number(node, 3);
    limits.acceleration = Number(node, 4);
    Go(planner_.Goto(drone_.motion.X_WB.p, Thing(node, 0), {Number(node, 1), Number(node, 2), limits, Number(node, 5)}));
    Enter(Phase::kGoing);
  }
  return Arrived();
}

Status PilotLeaves::Orbit(const Node& node, bool fresh) {
  TrajectoryLimits limits;
  limits.speed = Number(node, 4);
  limits.acceleration = std::max(2.0, 2 * limits.speed * limits.speed / std::max(Number(node, 1), 0.1));
  const MissionPlanner::OrbitRequest request{Number(node, 1), Number(node, 2), Number(node, 3), limits, Number(node, 5)};
  if (fresh || hand_.phase == Phase::kStopping) {
    if (Stopped(fresh) == Status::kRunning) return Status::kRunning;
    hand_.thing = Thing(node, 0);
    Go(planner_.ToOrbit(drone_.motion.X_WB.p, hand_.thing, request));
    Enter(Phase::kGoing);
  }
  if (hand_.phase == Phase::kGoing) {
    if (Arrived() == Status::kRunning) return Status::kRunning;
    Command(HoverCommand{{YawTarget::Mode::kAngle, Bearing(hand_.thing.p_W)}});
    Enter(Phase::kTurning);
    return Status::kRunning;
  }
  return Circle(request);
}

// The turn towards the middle, then the circle.
Status PilotLeaves::Circle(const MissionPlanner::OrbitRequest& request) {
  if (hand_.phase == Phase::kCircling) return Arrived();
  if (!FacesWithin(hand_.thing.p_W, kFaces) && Seconds(hand_.since_ns) < kTurnLimit) return Status::kRunning;
  Go(planner_.Orbit(hand_.goal, hand_.thing, request), hand_.thing.p_W);
  Enter(Phase::kCircling);
  return Status::kRunning;
}

// The wanted velocity where the next second of it is free; else up, where that is; else none.
Vec3d PilotLeaves::FreeVelocity(Vec3d wanted, double clearance) const {
  const Vec3d p = drone_.motion.X_WB.p, up{0, 0, 1.5};
  for (const Vec3d v : {wanted, up})
    if (IsFree(*model_.tracer, p, p + v, clearance)) return v;
  return {};
}

Status PilotLeaves::Follow(const Node& node, bool fresh) {
  const ThingNow thing = Thing(node, 0);
  const double seconds = Number(node, 3);
  if (fresh) {
    Enter(Phase::kGoing);
    hand_.duration = -1;
  }
  if (seconds > 0 && Seconds(hand_.since_ns) >= seconds) {
    Command(HoverCommand{});
    return Status::kSuccess;
  }
  if ((state_.t_ns - hand_.since_ns) % kSetpointNs >= kMissionTickNs) return Status::kRunning;
  const Vec3d p = drone_.motion.X_WB.p, away{p.x - thing.p_W.x, p.y - thing.p_W.y, 0};
  const Vec3d side = Norm(away) > 0.1 ? away * (1 / Norm(away)) : Vec3d{1, 0, 0};
  const Vec3d wanted = thing.p_W + side * Number(node, 1) + Vec3d{0, 0, Number(node, 2)};
  constexpr double kPull = 0.8;  // 1/s
  Vec3d v = thing.v_W + (wanted - p) * kPull;
  if (const double fastest = Number(node, 4); Norm(v) > fastest) v = v * (fastest / Norm(v));
  VelocityCommand command{.v = FreeVelocity(v, Number(node, 5))};
  command.yaw = {YawTarget::Mode::kAngle, Bearing(thing.p_W)};
  Command(command, kSetpointLifeNs);
  return Status::kRunning;
}

Status PilotLeaves::Look(const Node& node, bool fresh) {
  const Vec3d at = Thing(node, 0).p_W;
  if (fresh) {
    Enter(Phase::kTurning);
    Command(HoverCommand{{YawTarget::Mode::kAngle, Bearing(at)}});
    const auto& gimbals = model_.drones[mission_.vehicle]->setup().sensors.gimbals;
    const Vec3d way = at - drone_.motion.X_WB.p;
    if (!gimbals.empty())
      commands_.push_back({mission_.vehicle, GimbalCommand{0,
                                                           {.yaw = gimbals[0].spec.stabilise_yaw ? Bearing(at) : 0,
                                                            .pitch = std::atan2(way.z, std::hypot(way.x, way.y))}}});
    return Status::kRunning;
  }
  if (Seconds(hand_.since_ns) > kTurnLimit) throw InputError("the drone does not turn towards it");
  return FacesWithin(at, kFaces) ? Status::kSuccess : Status::kRunning;
}

}  // namespace airsim360

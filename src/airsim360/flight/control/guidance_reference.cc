// The smooth reference of guidance and the geofence.
#include <algorithm>
#include <cmath>

#include "airsim360/flight/control/attitude.h"
#include "airsim360/flight/control/guidance.h"

namespace airsim360::internal {
namespace {

// The reference waits for the drone beyond this distance, plus this time at its speed, and this heading.
constexpr double kLeash = 1, kLeashTime = 0.5, kYawLeash = 0.5;
// Share of the largest acceleration that braking counts on.
constexpr double kBrakeShare = 0.6;

/// Largest speed at distance d from which `a` still stops in time, linear near the end (Ardupilot's and PX4's
/// square-root controller).
double SpeedToStop(double d, double k, double a) {
  const double linear = a / (k * k);
  return d < linear ? k * d : std::sqrt(2 * a * (d - linear / 2));
}

Vec3d Level(Vec3d v) { return {v.x, v.y, 0}; }

Vec3d Limit(Vec3d v, double norm) {
  const double n = Norm(v);
  return n > norm ? v * (norm / n) : v;
}

/// Poles of the reference: acceleration follows at 3 lambda, velocity at lambda, position at lambda / 3;
/// three equal poles at -lambda.
struct ReferenceLoop {
  double acceleration, velocity, position;
};

ReferenceLoop LoopOf(const ControlGains& gains) {
  const double fast = std::min({gains.attitude.x, gains.attitude.y, 15.0});
  return {fast, fast / 3, fast / 9};
}

double ClimbTo(double z, double at, double climb, const ControlGains& gains, double k) {
  const double d = z - at;
  const double most =
      std::min(SpeedToStop(std::abs(d), k, kBrakeShare * gains.max_climb_acceleration), d > 0 ? climb : std::min(climb, gains.max_descent));
  return std::copysign(most, d);
}

/// The velocity that the goal asks of a reference at `at`.
Vec3d WantedVelocity(const ControlGains& gains, const ReferenceLoop& loop, Vec3d at, const Goal& goal) {
  if (goal.level == GoalLevel::kPosition) {
    const Vec3d d = Level(goal.p_W - at);
    const double distance = Norm(d);
    const double speed = std::min(SpeedToStop(distance, loop.position, kBrakeShare * gains.max_acceleration), goal.speed);
    Vec3d v = distance > 1e-12 ? d * (speed / distance) : Vec3d{};
    v.z = ClimbTo(goal.p_W.z, at.z, goal.climb, gains, loop.position);
    return v;
  }
  // No drone keeps more than its level speed at full tilt.
  const double most = gains.max_speed / 0.7;
  Vec3d v = Limit(Level(goal.v_W), most);
  v.z = goal.hold_z ? ClimbTo(goal.p_W.z, at.z, gains.max_climb, gains, loop.position) : std::clamp(goal.v_W.z, -most, most);
  return v;
}

void MoveYaw(const ControlGains& gains, const StateEstimate& estimate, double dt, const Goal& goal, AutopilotState& state) {
  const double most = gains.max_rate.z, k = gains.attitude.z / 2;
  const double wanted = goal.yaw_by_rate ? goal.yaw_rate : k * WrapAngle(goal.yaw - state.reference_yaw);
  const double rate = std::clamp(wanted, -most, most);
  state.reference_yaw_rate += (rate - state.reference_yaw_rate) * std::min(1.0, 4 * k * dt);
  const double heading = HeadingOf(ToMatrix(estimate.q_WB));
  const double ahead = WrapAngle(state.reference_yaw + state.reference_yaw_rate * dt - heading);
  state.reference_yaw = WrapAngle(heading + std::clamp(ahead, -kYawLeash, kYawLeash));
}

}  // namespace

void ResetReference(const StateEstimate& estimate, AutopilotState& state) {
  state.reference_p = estimate.p_WB;
  state.reference_v = estimate.v_WB;
  state.reference_a = {};
  state.reference_yaw = HeadingOf(ToMatrix(estimate.q_WB));
  state.reference_yaw_rate = 0;
  state.has_reference = 1;
}

void MoveReference(const ControlGains& gains, const StateEstimate& estimate, double dt, Goal& goal, AutopilotState& state) {
  if (goal.level == GoalLevel::kTrajectory) {
    const ReferencePoint& r = goal.reference;
    state.reference_p = r.p;
    state.reference_v = r.v;
    state.reference_a = r.a;
    state.reference_yaw = r.yaw;
    state.reference_yaw_rate = r.yaw_rate;
    state.has_reference = 1;
    return;
  }
  const bool by_hand = goal.level < GoalLevel::kRates;
  const bool no_place = goal.level == GoalLevel::kRates || goal.level == GoalLevel::kAttitude;
  if (by_hand || !state.has_reference) ResetReference(estimate, state);
  if (by_hand) return;
  if (no_place) {
    // Only the height, if it is asked for, and the heading are held.
    const Vec3d held = state.reference_p, v = state.reference_v, a = state.reference_a;
    state.reference_p = Level(estimate.p_WB);
    state.reference_v = Level(estimate.v_WB);
    state.reference_p.z = goal.throttle_given ? estimate.p_WB.z : held.z;
    state.reference_v.z = goal.throttle_given ? estimate.v_WB.z : v.z;
    state.reference_a = goal.throttle_given ? Vec3d{} : Vec3d{0, 0, a.z};
  }

  // Acceleration, velocity, position: each follows the one before.
  const ReferenceLoop loop = LoopOf(gains);
  Goal towards = goal;
  towards.hold_z |= no_place && !goal.throttle_given;
  const Vec3d velocity = WantedVelocity(gains, loop, state.reference_p, towards);
  const Vec3d change = (velocity - state.reference_v) * loop.velocity;
  Vec3d wanted = no_place ? Vec3d{} : Limit(Level(change), gains.max_acceleration);
  const double climb = gains.max_climb_acceleration;
  wanted.z = goal.throttle_given ? 0 : std::clamp(change.z, -climb, climb);
  const Vec3d jerk = (wanted - state.reference_a) * loop.acceleration;
  state.reference_a += jerk * dt;
  state.reference_v += state.reference_a * dt;
  state.reference_p += state.reference_v * dt;

  // A drone that cannot follow is waited for.
  const double leash = kLeash + kLeashTime * Norm(state.reference_v);
  const Vec3d ahead = state.reference_p - estimate.p_WB;
  const Vec3d level = Limit(Level(ahead), leash);
  state.reference_p = estimate.p_WB + Vec3d{level.x, level.y, std::clamp(ahead.z, -leash, leash)};

  if (goal.level == GoalLevel::kRates) {
    state.reference_yaw = HeadingOf(ToMatrix(estimate.q_WB));
    state.reference_yaw_rate = 0;
  } else {
    MoveYaw(gains, estimate, dt, goal, state);
  }
  goal.reference = {state.reference_p, state.reference_v, state.reference_a, jerk, {}, state.reference_yaw, state.reference_yaw_rate};
}

namespace {

Vec3d Inside(const Geofence& fence, Vec3d home, Vec3d p) {
  const Vec3d out = Limit(Level(p - home), fence.radius);
  p = {home.x + out.x, home.y + out.y, p.z};
  return Min(Max(p, fence.low), fence.high);
}

/// v without what would carry p through the fence: its outward parts end at the speed that still stops.
Vec3d SlowDown(const Geofence& fence, const ControlGains& gains, Vec3d home, Vec3d p, Vec3d v) {
  const ReferenceLoop loop = LoopOf(gains);
  const auto limit = [&](double room, double acceleration) {
    return room > 0 ? SpeedToStop(room, loop.position, kBrakeShare * acceleration)
                    : -SpeedToStop(-room, loop.position, kBrakeShare * acceleration);
  };
  for (int i = 0; i < 3; ++i) {
    const double a = i == 2 ? gains.max_climb_acceleration : gains.max_acceleration;
    const double up = limit(fence.high[i] - p[i], a), down = -limit(p[i] - fence.low[i], a);
    v[i] = up < down ? (up + down) / 2 : std::clamp(v[i], down, up);
  }
  const Vec3d out = Normalized(Level(p - home));
  const double outward = Dot(v, out);
  const double most = limit(fence.radius - Norm(Level(p - home)), gains.max_acceleration);
  return outward > most ? v - out * (outward - most) : v;
}

}  // namespace

bool KeepInside(const Geofence& fence, const ControlGains& gains, const StateEstimate& estimate, Goal& goal, AutopilotState& state) {
  const Vec3d home = state.home_W;
  // Stops, inside; until the next command.
  const auto stop = [&] {
    goal = {};
    goal.level = GoalLevel::kVelocity;
    goal.yaw_by_rate = true;
    goal.v_W = SlowDown(fence, gains, home, state.reference_p, {});
    return true;
  };
  // Where braking from a speed ends, the turn of the drone into it included.
  const auto end_of = [&](Vec3d p, Vec3d v) {
    const double lag = 2 / LoopOf(gains).acceleration;
    return p + v * (lag + Norm(v) / (2 * kBrakeShare * gains.max_acceleration));
  };
  switch (goal.level) {
    case GoalLevel::kOff:
    case GoalLevel::kIdle:
      return false;
    case GoalLevel::kPosition: {
      const Vec3d p = Inside(fence, home, goal.p_W);
      if (p == goal.p_W) return false;
      goal.p_W = p;
      return true;
    }
    case GoalLevel::kVelocity: {
      const Vec3d at = state.has_reference ? state.reference_p : estimate.p_WB;
      const Vec3d v = SlowDown(fence, gains, home, at, goal.v_W);
      const double z = std::clamp(goal.p_W.z, fence.low.z, fence.high.z);
      const bool held = goal.hold_z ? z != goal.p_W.z || v.x != goal.v_W.x || v.y != goal.v_W.y : v != goal.v_W;
      goal.v_W = v;
      goal.p_W.z = z;
      return held;
    }
    case GoalLevel::kTrajectory: {
      const Vec3d end = end_of(goal.reference.p, goal.reference.v);
      return Inside(fence, home, end) == end && !(state.flags & kFenceHeld) ? false : stop();
    }
    default: {
      const Vec3d end = end_of(estimate.p_WB, estimate.v_WB);
      return Inside(fence, home, end) == end && !(state.flags & kFenceHeld) ? false : stop();
    }
  }
}

}  // namespace airsim360::internal

#include "airsim360/flight/control/guidance.h"

#include <algorithm>
#include <cmath>

#include "airsim360/flight/control/attitude.h"
#include "airsim360/flight/control/return_phase.h"

namespace airsim360::internal {
namespace {

// A place is reached within this distance and at less than this speed.
constexpr double kReachedDistance = 0.2, kReachedSpeed = 0.3;
// The ground carries the drone when its rotors give less than this share of its weight and it does not move.
constexpr double kCarriedShare = 0.8, kStillSpeed = 0.15, kSettleTime = 0.3;
// A landing drone has touched something when it has sunk at less than half of the speed asked for, for so long, or at once when
// it loses this share of the speed to a push of more than its weight. Its thrust then fades out within this time, from this share
// of its weight.
constexpr double kTouchTime = 0.1, kStruckShare = 0.3, kFadeTime = 0.4, kFadeFrom = 0.7;
// Carrot chasing as AirSim: at least this far ahead, and this many seconds of flight.
constexpr double kLeastLookahead = 0.75, kLookaheadTime = 0.6;
constexpr double kForwardSpeed = 0.3;  // slower than this, "forward" is no direction

/// One step of guidance; visits the command.
class Guider {
 public:
  Guider(const Autopilot& autopilot, const StateEstimate& estimate, const ActiveCommand& active, AutopilotState& state)
      : pilot_(autopilot), gains_(autopilot.gains()), now_(estimate), active_(active), state_(state) {}

  Goal Run() {
    if (active_.id != state_.command_id) TakeUp();
    const int64_t age_ns = now_.t_ns - state_.command_start_ns;
    if (active_.timeout_ns > 0 && age_ns >= active_.timeout_ns) state_.flags |= kCommandLost;
    if (state_.mode == FlightMode::kDisarmed) return {};

    if (state_.flags & kBatteryEmpty && state_.mode != FlightMode::kGround) return Land(0.7);
    if (state_.flags & (kCommandRefused | kCommandLost)) return Stay({});
    return std::visit(*this, active_.command);
  }

  Goal operator()(const HoverCommand& c) { return Stay(c.yaw); }
  Goal operator()(const ArmCommand&) { return Stay({}); }
  Goal operator()(const DisarmCommand&) { return {}; }

  Goal operator()(const RotorSpeedCommand& c) {
    Goal goal = Fly(GoalLevel::kSpeeds);
    goal.speeds = c.speeds;
    return goal;
  }
  Goal operator()(const RotorSignalCommand& c) {
    Goal goal = Fly(GoalLevel::kSpeeds);
    const auto& rotors = pilot_.model().rotors;
    for (size_t i = 0; i < rotors.size(); ++i) {
      goal.speeds[i] = std::sqrt(c.signals[i]) * rotors[i].max_speed;
    }
    return goal;
  }
  Goal operator()(const RateCommand& c) {
    Goal goal = Fly(GoalLevel::kRates);
    goal.w_B = c.w_B;
    SetVertical(c.vertical, goal);
    return goal;
  }
  Goal operator()(const AttitudeCommand& c) {
    Goal goal = Fly(GoalLevel::kAttitude);
    goal.roll = c.roll;
    goal.pitch = c.pitch;
    SetVertical(c.vertical, goal);
    SetYaw(c.yaw, {}, goal);
    return goal;
  }
  Goal operator()(const VelocityCommand& c) {
    Goal goal = Fly(GoalLevel::kVelocity);
    goal.v_W = c.body_heading ? RotationZ(state_.reference_yaw) * c.v : c.v;
    goal.hold_z = c.hold_altitude;
    goal.p_W.z = c.altitude;
    SetYaw(c.yaw, goal.v_W, goal);
    return goal;
  }
  Goal operator()(const PositionCommand& c) {
    Fly(GoalLevel::kPosition);
    Goal goal = GoTo(c.p_W, c.speed);
    SetYaw(c.yaw, state_.reference_v, goal);
    if (Reached(c.p_W)) state_.flags |= kCommandDone;
    return goal;
  }
  Goal operator()(const PathCommand& c) {
    Fly(GoalLevel::kVelocity);
    Goal goal = Chase(c);
    SetYaw(c.yaw, state_.reference_v, goal);
    return goal;
  }
  Goal operator()(const TrajectoryCommand& c) {
    Goal goal = Fly(GoalLevel::kTrajectory);
    const double t = static_cast<double>(now_.t_ns - state_.command_start_ns) * 1e-9;
    const double duration = c.trajectory->duration();
    goal.reference = c.trajectory->At(std::min(t, duration));
    if (t > duration) {
      // Its end is a place to stay at.
      goal.reference = {goal.reference.p, {}, {}, {}, {}, goal.reference.yaw, 0};
      if (Reached(goal.reference.p)) state_.flags |= kCommandDone;
    }
    return goal;
  }
  Goal operator()(const TakeoffCommand& c) {
    Vec3d above = state_.start_p_W;
    above.z += c.height;
    if (Reached(above)) {
      state_.flags |= kCommandDone;
      state_.mode = FlightMode::kHold;
    }
    Goal goal = GoTo(above, 0);
    goal.climb = c.speed;
    return goal;
  }
  Goal operator()(const LandCommand& c) { return Land(c.speed); }
  Goal operator()(const ReturnCommand& c) {
    if (state_.mode == FlightMode::kGround) return Stay({});
    state_.mode = FlightMode::kReturn;
    Vec3d above = state_.home_W;
    above.z = std::max(above.z + c.height, state_.start_p_W.z);
    // Up, over, down.
    const Vec3d corner{state_.start_p_W.x, state_.start_p_W.y, above.z};
    if (state_.phase == 0 && Reached(corner)) state_.phase = 1;
    if (state_.phase == 1 && Reached(above)) state_.phase = kReturnDown;
    if (state_.phase < kReturnDown) return GoTo(state_.phase == 0 ? corner : above, c.speed);
    if (c.land) return Land(0.7);
    state_.flags |= kCommandDone;
    return GoTo(above, c.speed);
  }

 private:
  /// A new command: remembers where it began and refuses what cannot be flown.
  void TakeUp() {
    state_.command_id = active_.id;
    state_.command_start_ns = now_.t_ns;
    state_.start_p_W = now_.p_WB;
    state_.start_yaw = HeadingOf(ToMatrix(now_.q_WB));
    state_.phase = 0;
    state_.settled = state_.touched = 0;
    state_.flags &= ~uint64_t{kCommandRefused | kCommandLost | kCommandDone | kFenceHeld};
    if (!pilot_.Problem(active_.command, state_).empty()) {
      state_.flags |= kCommandRefused;
    } else if (std::holds_alternative<DisarmCommand>(active_.command)) {
      state_.mode = FlightMode::kDisarmed;
      state_.flags |= kCommandDone;
    } else if (std::holds_alternative<ArmCommand>(active_.command)) {
      if (state_.mode == FlightMode::kDisarmed) Arm();
      state_.flags |= kCommandDone;
    } else if (std::holds_alternative<TakeoffCommand>(active_.command)) {
      if (state_.mode == FlightMode::kDisarmed) Arm();
      state_.mode = FlightMode::kTakeoff;
    } else if (std::holds_alternative<LandCommand>(active_.command) &&
               (state_.mode == FlightMode::kGround || state_.mode == FlightMode::kDisarmed)) {
      state_.mode = FlightMode::kDisarmed;
      state_.flags |= kCommandDone;
    }
  }

  void Arm() {
    state_.mode = FlightMode::kGround;
    state_.home_W = now_.p_WB;
    state_.failed_rotors = 0;
    state_.flags &= ~uint64_t{kRotorFailed};
    state_.fault_time = {};
    state_.has_reference = 0;
  }

  /// A goal of a command that flies the drone, from the ground too.
  Goal Fly(GoalLevel level) {
    state_.mode = FlightMode::kCommanded;
    Goal goal;
    goal.level = level;
    goal.yaw_by_rate = true;
    return goal;
  }

  /// Stands on the ground, or stops and stays in the air.
  Goal Stay(const YawTarget& yaw) {
    Goal goal;
    if (state_.mode == FlightMode::kGround) {
      goal.level = GoalLevel::kIdle;
      return goal;
    }
    state_.mode = FlightMode::kHold;
    goal.level = GoalLevel::kVelocity;
    goal.yaw_by_rate = true;
    SetYaw(yaw, {}, goal);
    return goal;
  }

  Goal GoTo(Vec3d p_W, double speed) {
    Goal goal;
    goal.level = GoalLevel::kPosition;
    goal.p_W = p_W;
    goal.speed = speed > 0 ? speed : gains_.max_speed;
    goal.climb = speed > 0 ? speed : gains_.max_climb;
    goal.yaw_by_rate = true;
    return goal;
  }

  Goal Land(double speed) {
    if (state_.mode != FlightMode::kReturn) state_.mode = FlightMode::kLand;
    Goal goal;
    goal.level = GoalLevel::kVelocity;
    goal.v_W = {0, 0, -speed};
    goal.yaw_by_rate = true;
    // Down when something else carries it, for a while.
    double thrust = 0;
    const auto& rotors = pilot_.model().rotors;
    for (size_t i = 0; i < rotors.size(); ++i) thrust += ThrustAtSpeed(rotors[i], now_.rotor_speeds[i]);
    const bool carried = thrust < kCarriedShare * pilot_.model().mass * kGravity;
    const bool still = Norm(now_.v_WB) < kStillSpeed;
    state_.settled = carried && still ? state_.settled + pilot_.options().control_dt : 0;
    if (state_.settled >= kSettleTime) {
      state_.mode = FlightMode::kDisarmed;
      state_.flags |= kCommandDone;
      return {};
    }
    if (HasTouched(speed)) SetDown(goal);
    return goal;
  }

  /// Notices that something is below a drone that sinks at `speed`. What then falls faster is in the air after all.
  bool HasTouched(double speed) {
    const double wanted = state_.reference_v.z, sinking = -now_.v_WB.z;
    const bool touched = state_.touched > kTouchTime;
    const bool sinks = wanted < -0.5 * speed;
    const bool kept = touched ? sinking < 1.5 * speed : sinks && sinking < -0.5 * wanted;
    const bool struck = sinks && state_.disturbance_a.z > kGravity && sinking < -(1 - kStruckShare) * wanted;
    state_.touched = kept && state_.has_reference ? state_.touched + pilot_.options().control_dt : 0;
    if (struck) state_.touched = std::max(state_.touched, kTouchTime + pilot_.options().control_dt);
    return state_.touched > kTouchTime;
  }

  /// Level, with less and less thrust, and without flying against what the ground does: who goes on leaning into the wind turns
  /// over its edge, and who fights the torque of a leg that touches first jumps off again.
  void SetDown(Goal& goal) {
    state_.disturbance_a = state_.disturbance_alpha = {};
    state_.has_history = 0;
    const double left = kFadeFrom * std::max(1 - (state_.touched - kTouchTime) / kFadeTime, 0.0);
    goal.level = GoalLevel::kAttitude;
    goal.throttle_given = true;
    goal.throttle = left * pilot_.model().mass * kGravity / gains_.max_thrust;
  }

  /// Flies at a point of the path ahead of the reference.
  Goal Chase(const PathCommand& c) {
    const std::vector<Vec3d>& points = *c.waypoints;
    const double speed = c.speed > 0 ? c.speed : gains_.max_speed;
    const double lookahead = c.lookahead > 0 ? c.lookahead : std::max(kLeastLookahead, kLookaheadTime * speed);
    const auto end = static_cast<int64_t>(points.size());
    const Vec3d at = state_.has_reference ? state_.reference_p : now_.p_WB;
    const auto from = [&](int64_t segment) { return segment == 0 ? state_.start_p_W : points[segment - 1]; };

    // Nearest point of the present segment, and of the next ones where the present one is passed.
    double share = 1;
    while (state_.phase < end) {
      const Vec3d along = points[state_.phase] - from(state_.phase);
      const double length2 = Dot(along, along);
      share = length2 > 0 ? std::clamp(Dot(at - from(state_.phase), along) / length2, 0.0, 1.0) : 1;
      if (share < 1 || state_.phase == end - 1) break;
      ++state_.phase;
    }
    // From there `lookahead` along the path.
    Vec3d carrot = from(state_.phase) + (points[state_.phase] - from(state_.phase)) * share;
    double left = lookahead;
    int64_t segment = state_.phase;
    while (true) {
      const double rest = Norm(points[segment] - carrot);
      if (rest >= left || segment == end - 1) {
        if (rest > 0) carrot += (points[segment] - carrot) * std::min(1.0, left / rest);
        left -= rest;
        break;
      }
      left -= rest;
      carrot = points[segment++];
    }
    if (left >= 0) {
      if (Reached(points.back())) state_.flags |= kCommandDone;
      return GoTo(points.back(), speed);
    }
    Goal goal;
    goal.level = GoalLevel::kVelocity;
    goal.yaw_by_rate = true;
    // Never so fast that the end could not be braked for.
    const double brake = std::sqrt(1.2 * gains_.max_acceleration * std::max(Norm(points.back() - at), 0.1));
    goal.v_W = Normalized(carrot - at) * std::min(speed, std::max(brake, 1.0));
    return goal;
  }

  void SetVertical(const VerticalTarget& vertical, Goal& goal) const {
    goal.throttle_given = vertical.mode == VerticalTarget::Mode::kThrottle;
    (goal.throttle_given ? goal.throttle : goal.p_W.z) = vertical.value;
  }

  void SetYaw(const YawTarget& yaw, Vec3d moving, Goal& goal) const {
    goal.yaw_by_rate = true;
    if (yaw.mode == YawTarget::Mode::kRate) goal.yaw_rate = yaw.value;
    const bool moves = std::hypot(moving.x, moving.y) > kForwardSpeed;
    if (yaw.mode == YawTarget::Mode::kAngle || (yaw.mode == YawTarget::Mode::kForward && moves)) {
      goal.yaw_by_rate = false;
      goal.yaw = yaw.mode == YawTarget::Mode::kAngle ? yaw.value : std::atan2(moving.y, moving.x);
    }
  }

  bool Reached(Vec3d p_W) const { return Norm(now_.p_WB - p_W) < kReachedDistance && Norm(now_.v_WB) < kReachedSpeed; }

  const Autopilot& pilot_;
  const ControlGains& gains_;
  const StateEstimate& now_;
  const ActiveCommand& active_;
  AutopilotState& state_;
};

}  // namespace

Goal Guide(const Autopilot& autopilot, const StateEstimate& estimate, const ActiveCommand& command, AutopilotState& state) {
  Goal goal = Guider(autopilot, estimate, command, state).Run();
  const auto& fence = autopilot.options().fence;
  if (fence && KeepInside(*fence, autopilot.gains(), estimate, goal, state)) state.flags |= kFenceHeld;
  MoveReference(autopilot.gains(), estimate, autopilot.options().control_dt, goal, state);
  return goal;
}

}  // namespace airsim360::internal

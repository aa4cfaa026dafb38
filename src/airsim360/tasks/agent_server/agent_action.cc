#include "airsim360/tasks/agent_server/agent_action.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace airsim360 {
namespace {

constexpr double kSettle = 4;                // seconds beyond the way itself to come to rest
constexpr double kTurnRate = 0.5;            // rad/s at least, for the longest time of a turn
constexpr int64_t kGraceNs = 1'000'000'000;  // after its end a velocity is flown so long without another

double WrapAngle(double a) { return std::remainder(a, 2 * std::numbers::pi); }

YawTarget Towards(double yaw) { return {YawTarget::Mode::kAngle, WrapAngle(yaw)}; }

// To one place, at rest at its end.
ActionPlan GoTo(const AgentPose& from, const AgentPose& to, double speed) {
  const double way = Norm(to.p_W - from.p_W), turn = std::abs(WrapAngle(to.yaw - from.yaw));
  ActionPlan plan;
  plan.command = PositionCommand{.p_W = to.p_W, .speed = speed, .yaw = Towards(to.yaw)};
  plan.target = {to.p_W, WrapAngle(to.yaw)};
  plan.seconds = std::min(kLongestAction, 1.5 * way / speed + turn / kTurnRate + kSettle);
  return plan;
}

// Visits the kinds of actions.
struct Planner {
  const AgentPose& from;
  const PresetSizes& sizes;
  double speed;

  // A step in the level heading frame: forward, left, up.
  ActionPlan Move(double forward, double left, double up) const {
    return GoTo(from, {from.p_W + RotationZ(from.yaw) * Vec3d{forward, left, up}, from.yaw}, speed);
  }

  ActionPlan operator()(const PresetAction& action) const {
    switch (action.preset) {
      case Preset::kStop: {
        ActionPlan plan;
        plan.stops = true;
        return plan;
      }
      case Preset::kHover:
        return {.command = HoverCommand{}, .seconds = sizes.hover};
      case Preset::kForward:
        return Move(sizes.forward, 0, 0);
      case Preset::kBackward:
        return Move(-sizes.forward, 0, 0);
      case Preset::kLeft:
        return Move(0, sizes.lateral, 0);
      case Preset::kRight:
        return Move(0, -sizes.lateral, 0);
      case Preset::kUp:
        return Move(0, 0, sizes.vertical);
      case Preset::kDown:
        return Move(0, 0, -sizes.vertical);
      case Preset::kTurnLeft:
        return GoTo(from, {from.p_W, from.yaw + sizes.turn}, speed);
      case Preset::kTurnRight:
        return GoTo(from, {from.p_W, from.yaw - sizes.turn}, speed);
    }
    return {};
  }

  ActionPlan operator()(const RelativeGoalAction& action) const {
    // Azimuth grows to the right, yaw to the left.
    const double yaw = from.yaw - action.azimuth;
    const Vec3d way{std::cos(action.elevation) * std::cos(yaw), std::cos(action.elevation) * std::sin(yaw), std::sin(action.elevation)};
    return GoTo(from, {from.p_W + action.distance * way, action.face ? yaw : from.yaw}, SpeedOf(action.speed));
  }

  ActionPlan operator()(const WaypointsAction& action) const {
    std::vector<Vec3d> points = action.points;
    double length = 0;
    Vec3d last = from.p_W;
    for (Vec3d& p : points) {
      if (action.body_frame) p = from.p_W + RotationZ(from.yaw) * p;
      length += Norm(p - last);
      last = p;
    }
    const double chosen = SpeedOf(action.speed);
    ActionPlan plan;
    plan.target = {last, from.yaw};
    plan.seconds = std::min(kLongestAction, 1.5 * length / chosen + kSettle);
    if (points.size() == 1) {
      const Vec3d way = last - from.p_W;
      const bool level = std::hypot(way.x, way.y) > 0.1;
      return GoTo(from, {last, action.face && level ? std::atan2(way.y, way.x) : from.yaw}, chosen);
    }
    plan.command = PathCommand{.waypoints = std::make_shared<const std::vector<Vec3d>>(std::move(points)),
                               .speed = chosen,
                               .yaw = {action.face ? YawTarget::Mode::kForward : YawTarget::Mode::kKeep}};
    // Where it looks at the end follows from the way.
    plan.target->yaw = std::numeric_limits<double>::quiet_NaN();
    return plan;
  }

  ActionPlan operator()(const VelocityAction& action) const {
    return {
        .command = VelocityCommand{.v = action.v, .body_heading = !action.world_frame, .yaw = {YawTarget::Mode::kRate, action.yaw_rate}},
        .seconds = action.duration,
        .timeout_ns = std::llround(1e9 * action.duration) + kGraceNs};
  }

  ActionPlan operator()(const RatesAction& action) const {
    return {.command = RateCommand{.w_B = action.w_B, .vertical = {VerticalTarget::Mode::kThrottle, action.throttle}},
            .seconds = action.duration,
            .timeout_ns = std::llround(1e9 * action.duration) + kGraceNs};
  }

  double SpeedOf(double wanted) const { return wanted > 0 ? wanted : speed; }
};

}  // namespace

ActionPlan PlanAction(const AgentAction& action, const AgentPose& from, const PresetSizes& sizes, double speed) {
  return std::visit(Planner{from, sizes, speed}, action);
}

double HeadingOfBody(const RigidTransform& X_WB) {
  const Vec3d ahead = X_WB.R.column(0);
  return ahead.x == 0 && ahead.y == 0 ? 0 : std::atan2(ahead.y, ahead.x);
}

}  // namespace airsim360

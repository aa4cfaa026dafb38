#include "airsim360/flight/control/tracking.h"

#include <algorithm>
#include <cmath>

#include "airsim360/flight/control/attitude.h"

namespace airsim360::internal {
namespace {

// The thrust axis of a tracking controller is never asked to lean further than this (rad) from +Z of W.
constexpr double kSteepest = 1.4;
// Of the full thrust, this share may go into the specific force: the rest is left for turning.
constexpr double kThrustShare = 0.95;
constexpr double kLeastForce = 1;  // m/s^2 upwards: the thrust axis keeps a direction in free fall

Vec3d LimitForce(const TrackingStep& step, Vec3d f) {
  const double most = kThrustShare * step.gains.max_thrust / step.model.mass;
  f.z = std::clamp(f.z, kLeastForce, std::max(most, kLeastForce));
  const double level = std::hypot(f.x, f.y);
  const double room = std::min(std::sqrt(std::max(most * most - f.z * f.z, 0.01)), f.z * std::tan(kSteepest));
  const double scale = level > room ? room / level : 1;
  return {f.x * scale, f.y * scale, f.z};
}

}  // namespace

bool IsByHand(const Goal& goal) { return goal.level == GoalLevel::kRates || goal.level == GoalLevel::kAttitude; }

Vec3d WantedAcceleration(const TrackingStep& step) {
  const ControlGains& gains = step.gains;
  const ReferencePoint& r = step.goal.reference;
  Vec3d catch_up = (r.p - step.estimate.p_WB) * gains.position;
  const double speed = Norm(catch_up);
  if (speed > gains.max_speed) catch_up *= gains.max_speed / speed;
  Vec3d a = (catch_up + r.v - step.estimate.v_WB) * gains.velocity;
  // Feedback alone asks for no more than a turn of the drone gives.
  const double most = std::max(gains.max_acceleration, 0.5 * kGravity);
  const double norm = Norm(a);
  if (norm > most) a *= most / norm;
  return a + r.a;
}

AttitudeDemand DemandForForce(const TrackingStep& step, Vec3d f_W, bool feed_forward) {
  const ReferencePoint& r = step.goal.reference;
  const Vec3d f = LimitForce(step, f_W);
  AttitudeDemand demand;
  demand.R_WD = AttitudeFor(f, r.yaw);
  demand.thrust = step.model.mass * std::max(Dot(f, step.R_WB.column(2)), 0.0);
  // The reference's own specific force: drag d v adds to what the rotors must give, and moves with it.
  const double d = step.gains.drag_rate + 2 * step.gains.quadratic_drag * Norm(r.v);
  const Vec3d f1 = feed_forward ? r.jerk + r.a * d : Vec3d{};
  const Vec3d f2 = feed_forward ? r.snap + r.jerk * d : Vec3d{};
  const FlatRates rates = RatesOf(demand.R_WD, Norm(f), f1, f2, r.yaw, r.yaw_rate);
  const Mat3d to_body = step.R_WB.transpose() * demand.R_WD;
  demand.w_B = to_body * rates.w;
  demand.alpha_B = to_body * rates.alpha;
  return demand;
}

AttitudeDemand DemandByHand(const TrackingStep& step, double a_z) {
  const Goal& goal = step.goal;
  AttitudeDemand demand;
  if (goal.throttle_given) {
    demand.thrust = goal.throttle * step.gains.max_thrust;
  } else {
    // As much thrust as keeps the height at this lean, up to a lean of about 70 degrees.
    const double upright = std::max(step.R_WB.m[2][2], 0.35);
    demand.thrust = step.model.mass * std::max(kGravity + a_z, 0.0) / upright;
  }
  demand.thrust = std::min(demand.thrust, step.gains.max_thrust);
  demand.rates_only = goal.level == GoalLevel::kRates;
  if (demand.rates_only) {
    demand.w_B = goal.w_B;
    return demand;
  }
  const ReferencePoint& r = goal.reference;
  demand.R_WD = BodyPose({}, r.yaw, goal.pitch, goal.roll).R;
  demand.w_B = step.R_WB.transpose() * Vec3d{0, 0, r.yaw_rate};
  return demand;
}

Vec3d WantedRates(const TrackingStep& step, const AttitudeDemand& demand) {
  const Vec3d most = step.gains.max_rate;
  if (demand.rates_only) return demand.w_B;
  const Vec3d turn = step.gains.attitude * AttitudeError(step.R_WB, demand.R_WD);
  return Min(Max(turn, -most), most) + demand.w_B;
}

Vec3d TorqueFor(const DroneModel& model, Vec3d alpha_B, Vec3d w_B) { return model.inertia_B * alpha_B + Cross(w_B, model.inertia_B * w_B); }

Vec3d SolveInertia(const Mat3d& J, Vec3d torque) {
  // Cramer's rule; J is symmetric and positive definite.
  const Vec3d a = J.column(0), b = J.column(1), c = J.column(2);
  const double det = J.determinant();
  return {Dot(torque, Cross(b, c)) / det, Dot(a, Cross(torque, c)) / det, Dot(a, Cross(b, torque)) / det};
}

}  // namespace airsim360::internal

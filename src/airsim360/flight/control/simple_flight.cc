#include "airsim360/flight/control/simple_flight.h"

#include <algorithm>
#include <cmath>

#include "airsim360/flight/control/attitude.h"

namespace airsim360 {
namespace {

double Unit(double x) { return std::clamp(x, -1.0, 1.0); }

/// Angles, rates and velocities as AirSim counts them: forward, right, down.
struct Frd {
  double roll, pitch;  ///< rad: right side down, nose up
  Vec3d w;             ///< rad/s about forward, right, down
};

Frd ToFrd(const StateEstimate& estimate, const Mat3d& R) {
  const auto [roll, pitch] = internal::RollPitchOf(R);
  const Vec3d w = estimate.w_WB_B;
  return {roll, pitch, {w.x, -w.y, -w.z}};
}

/// Rotates a vector of W into the level frame of the heading, as forward, right, down.
Vec3d ToLevelFrd(Vec3d v, double yaw) {
  const double c = std::cos(yaw), s = std::sin(yaw);
  return {c * v.x + s * v.y, s * v.x - c * v.y, -v.z};
}

/// Outputs of the cascade, -1 to 1 (throttle 0 to 1).
struct Outputs {
  double roll = 0, pitch = 0, yaw = 0, throttle = 0;
};

/// The position loop, in W: saturates at 4 m of error.
Vec3d PositionLoop(const SimpleFlightGains& gains, Vec3d error) {
  Vec3d out;
  for (int i = 0; i < 3; ++i) out[i] = Unit(gains.position_p[i] * error[i]) * gains.max_velocity;
  return out;
}

Vec3d GoalVelocity(const SimpleFlightGains& gains, const Goal& goal, Vec3d p_W) {
  Vec3d v = goal.v_W;
  if (goal.level == GoalLevel::kPosition) {
    // moveToPosition chases its goal at the commanded speed; near it the position loop brakes.
    v = PositionLoop(gains, goal.p_W - p_W);
    const double level = std::hypot(v.x, v.y);
    if (level > goal.speed) v = {v.x * goal.speed / level, v.y * goal.speed / level, v.z};
    v.z = std::clamp(v.z, -goal.climb, goal.climb);
  }
  if (goal.level == GoalLevel::kTrajectory) {
    v = goal.reference.v + PositionLoop(gains, goal.reference.p - p_W);
  }
  const bool by_hand = goal.level == GoalLevel::kRates || goal.level == GoalLevel::kAttitude;
  if (goal.hold_z || (by_hand && !goal.throttle_given)) v.z = PositionLoop(gains, goal.p_W - p_W).z;
  return v;
}

/// AirSim's motor mix: throttle + pitch, roll and yaw with the signs of the arms.
RotorValues Mix(const DroneModel& model, const SimpleFlightGains& gains, const Outputs& out) {
  const size_t n = model.rotors.size();
  RotorValues signals{};
  if (out.throttle < gains.min_angling_throttle) {
    std::fill_n(signals.begin(), n, out.throttle);
    return signals;
  }
  // Quad X arms all have the largest reach: coefficients are +-1.
  double x_most = 1e-9, y_most = 1e-9;
  for (const RotorModel& rotor : model.rotors) {
    x_most = std::max(x_most, std::abs(rotor.p_B.x));
    y_most = std::max(y_most, std::abs(rotor.p_B.y));
  }
  double least = 1e9, most = 0;
  for (size_t i = 0; i < n; ++i) {
    const RotorModel& rotor = model.rotors[i];
    // A rotor on the left side lifts it: rolls right; in front: nose up; reaction along -Z of B: yaws right.
    signals[i] = out.throttle + out.roll * rotor.p_B.y / y_most + out.pitch * rotor.p_B.x / x_most - out.yaw * rotor.direction;
    least = std::min(least, signals[i]);
  }
  for (size_t i = 0; i < n; ++i) {
    if (least < 0) signals[i] -= least;
    most = std::max(most, signals[i]);
  }
  for (size_t i = 0; i < n; ++i) signals[i] = std::clamp(most > 1 ? signals[i] / most : signals[i], 0.0, 1.0);
  return signals;
}

}  // namespace

RotorValues SimpleFlightSignals(const DroneModel& model, const SimpleFlightGains& gains, const Goal& goal, const StateEstimate& estimate,
                                double dt, AutopilotState& state) {
  const Mat3d R = ToMatrix(estimate.q_WB);
  const double yaw = internal::HeadingOf(R);
  const Frd now = ToFrd(estimate, R);
  const bool by_hand = goal.level == GoalLevel::kRates || goal.level == GoalLevel::kAttitude;

  const Vec3d v = GoalVelocity(gains, goal, estimate.p_WB);

  // Velocity to lean and throttle.
  Outputs out;
  double roll = goal.roll, pitch = goal.pitch;
  const Vec3d error = ToLevelFrd(v - estimate.v_WB, yaw);
  if (!by_hand) {
    pitch = -Unit(gains.velocity_p.x * error.x) * gains.max_level;
    roll = Unit(gains.velocity_p.y * error.y) * gains.max_level;
  }
  if (by_hand && goal.throttle_given) {
    out.throttle = goal.throttle;
    state.throttle_integral = 0;
  } else {
    // Down is positive: a drone that sinks too slowly gets less throttle.
    const double integral = state.throttle_integral * gains.integral_discount + gains.velocity_i_z * error.z * dt;
    state.throttle_integral = Unit(integral);
    const double pid = Unit(gains.velocity_p.z * error.z + state.throttle_integral);
    out.throttle = std::clamp((1 - pid) / 2, gains.min_throttle, 1.0);
  }

  // Lean to rates, rates to signals.
  Vec3d w{goal.w_B.x, -goal.w_B.y, -goal.w_B.z};
  if (goal.level != GoalLevel::kRates) {
    w.x = Unit(gains.level_p.x * internal::WrapAngle(roll - now.roll)) * gains.max_rate;
    w.y = Unit(gains.level_p.y * internal::WrapAngle(pitch - now.pitch)) * gains.max_rate;
    // A heading angle goes through the level loop, a rate does not.
    const double turn = goal.yaw_by_rate && goal.yaw_rate != 0
                            ? goal.yaw_rate
                            : Unit(gains.level_p.z * internal::WrapAngle(goal.reference.yaw - yaw)) * gains.max_rate;
    w.z = -turn;
  }
  out.roll = Unit(gains.rate_p.x * (w.x - now.w.x));
  out.pitch = Unit(gains.rate_p.y * (w.y - now.w.y));
  out.yaw = Unit(gains.rate_p.z * (w.z - now.w.z));
  return Mix(model, gains, out);
}

}  // namespace airsim360

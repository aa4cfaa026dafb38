#include "airsim360/flight/control/gains.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/flight/control/mixer.h"

namespace airsim360 {
namespace {

// Rotor lag is sped up at most this much by the lead: more would ask for power that no motor has.
constexpr double kMostLead = 4;
// Each loop is this much slower than the one inside it.
constexpr double kAttitudeRatio = 3, kVelocityRatio = 2.5, kPositionRatio = 2.5;
// Error of attitude whose correction may use all the torque there is.
constexpr double kFullTorqueAngle = 0.5;

[[noreturn]] void Refuse(const DroneModel& model, const std::string& why) {
  throw InputError("drone '" + model.name + "' cannot fly: " + why);
}

void CheckFlyable(const DroneModel& model) {
  if (model.rotors.size() < 3 || model.rotors.size() > kMaxRotors) {
    Refuse(model, std::to_string(model.rotors.size()) + " rotors; 3 to 8 are possible");
  }
  if (!(model.mass > 0) || !std::isfinite(model.mass)) Refuse(model, "its mass is not positive");
  for (int i = 0; i < 3; ++i) {
    if (!(model.inertia_B.m[i][i] > 0)) Refuse(model, "its inertia is not positive");
  }
  for (const RotorModel& rotor : model.rotors) {
    if (!(rotor.thrust_factor > 0) || !(rotor.max_speed > 0) || !(rotor.tau_up > 0)) {
      Refuse(model, "a rotor without thrust factor, top speed or lag");
    }
  }
  if (!Mixer(model).usable()) Refuse(model, "its rotors cannot give roll, pitch and thrust");
  if (MaxThrust(model) < 1.05 * model.mass * kGravity) Refuse(model, "its full thrust does not carry it");
}

/// Angular acceleration about each axis that the rotors can give while hovering.
Vec3d Authority(const DroneModel& model) {
  Vec3d torque;
  const double hover_share = model.mass * kGravity / MaxThrust(model);
  for (const RotorModel& rotor : model.rotors) {
    const double most = ThrustAtSpeed(rotor, rotor.max_speed);
    const double room = most * std::min(hover_share, 1 - hover_share);
    const Vec3d effect = Cross(rotor.p_B, rotor.axis_B) + rotor.axis_B * (rotor.direction * rotor.torque_ratio);
    torque += Vec3d{std::abs(effect.x), std::abs(effect.y), std::abs(effect.z)} * room;
  }
  const auto& J = model.inertia_B.m;
  return {torque.x / J[0][0], torque.y / J[1][1], torque.z / J[2][2]};
}

double MeanLag(const DroneModel& model) {
  double sum = 0;
  for (const RotorModel& rotor : model.rotors) sum += std::max(rotor.tau_up, rotor.tau_down);
  return sum / static_cast<double>(model.rotors.size());
}

/// Zero of the yaw torque k_m w^2 + I dw/dt, linear about hover: I / (2 k_m w).
double SpinTime(const DroneModel& model) {
  const double hover = std::sqrt(model.mass * kGravity / MaxThrust(model));
  double sum = 0;
  for (const RotorModel& rotor : model.rotors) {
    const double torque_slope = 2 * rotor.torque_ratio * rotor.thrust_factor * rotor.max_speed * hover;
    if (torque_slope > 0) sum += rotor.inertia / torque_slope;
  }
  return sum / static_cast<double>(model.rotors.size());
}

}  // namespace

double LinearDrag(const DroneModel& model) {
  const double hover = model.mass * kGravity / MaxThrust(model);
  double sum = (model.linear_drag_B.x + model.linear_drag_B.y) / 2;
  for (const RotorModel& rotor : model.rotors) {
    sum += rotor.in_plane_drag * rotor.max_speed * std::sqrt(hover);
  }
  return sum;
}

double LevelSpeedAtTilt(const DroneModel& model, double tilt) {
  // Positive root of quadratic * v^2 + linear * v = m g tan(tilt).
  const double force = model.mass * kGravity * std::tan(tilt);
  const double linear = LinearDrag(model);
  const double quadratic = (model.quadratic_drag_B.x + model.quadratic_drag_B.y) / 2;
  return 2 * force / (linear + std::sqrt(linear * linear + 4 * quadratic * force) + 1e-12);
}

ControlGains SynthesizeGains(const DroneModel& model, double control_dt) {
  CheckFlyable(model);
  ControlGains gains;
  gains.max_thrust = MaxThrust(model);

  // Rotor lag and what the lead makes of it; half a control period of delay counts as lag.
  const double tau = MeanLag(model);
  gains.lead = std::clamp(tau / (3 * control_dt), 1.0, kMostLead);
  gains.lag = tau / gains.lead + control_dt;

  gains.spin_time = SpinTime(model);

  // Rates: damping 0.7 over the lag, as far as the torque reaches.
  const Vec3d authority = gains.authority = Authority(model);
  for (int i = 0; i < 3; ++i) {
    const double fast = 1 / (2 * gains.lag);
    const double strong = std::sqrt(kAttitudeRatio * authority[i] / kFullTorqueAngle);
    gains.rate[i] = std::min(fast, strong);
    gains.attitude[i] = gains.rate[i] / kAttitudeRatio;
    gains.max_rate[i] = std::clamp(gains.attitude[i] * (i == 2 ? 1.0 : 2.0), 0.5, i == 2 ? 4.0 : 20.0);
  }
  gains.velocity = std::min(gains.attitude.x, gains.attitude.y) / kVelocityRatio;
  gains.position = gains.velocity / kPositionRatio;

  gains.drag_rate = LinearDrag(model) / model.mass;
  gains.quadratic_drag = (model.quadratic_drag_B.x + model.quadratic_drag_B.y) / (2 * model.mass);

  // Limits of guidance.
  const double ratio = gains.max_thrust / (model.mass * kGravity);
  gains.max_tilt = std::clamp(std::acos(std::min(1.0, 1 / (0.9 * ratio))), 0.1, 0.8);
  gains.max_acceleration = 0.7 * kGravity * std::tan(gains.max_tilt);
  gains.max_climb_acceleration = std::clamp(0.5 * (ratio - 1) * kGravity, 0.5, 0.5 * kGravity);
  gains.max_speed = std::clamp(0.7 * LevelSpeedAtTilt(model, gains.max_tilt), 1.0, 30.0);
  gains.max_climb = std::clamp(0.4 * gains.max_speed, 0.5, 6.0);
  gains.max_descent = std::clamp(0.25 * gains.max_speed, 0.5, 4.0);
  return gains;
}

}  // namespace airsim360

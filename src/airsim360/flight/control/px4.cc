// The cascade of PX4's multicopter: position P, velocity PID, attitude P, body rate PID. The structure and
// the ratios of its default gains are PX4's; their size comes from the drone (ControlGains).
#include <algorithm>
#include <cmath>

#include "airsim360/flight/control/tracking.h"

namespace airsim360::internal {
namespace {

// PX4's defaults as ratios: MPC_XY_VEL_I_ACC / _P_ACC, _D_ACC / _P_ACC; MC_ROLLRATE_I / _P, _D / _P.
constexpr double kVelocityI = 0.4 / 1.8, kVelocityD = 0.2 / 1.8;
constexpr double kRateI = 0.2 / 0.15, kRateD = 0.003 / 0.15;
// Its position loop runs at 100 Hz or less.
constexpr double kOuterPeriod = 0.01;
constexpr double kMostIntegral = 0.5 * kGravity;  // m/s^2

/// The velocity PID, every kOuterPeriod.
void RunOuter(const TrackingStep& step, AutopilotState& state) {
  const auto every = std::max<int64_t>(1, std::llround(kOuterPeriod / step.dt));
  if (state.outer_count++ % every != 0) return;
  const ControlGains& gains = step.gains;
  const ReferencePoint& r = step.goal.reference;
  const Vec3d error = (r.p - step.estimate.p_WB) * gains.position + r.v - step.estimate.v_WB;
  const double period = static_cast<double>(every) * step.dt;
  for (int i = 0; i < 3; ++i) {
    const double integral = state.velocity_integral[i] + kVelocityI * gains.velocity * error[i] * period;
    state.velocity_integral[i] = std::clamp(integral, -kMostIntegral, kMostIntegral);
  }
  const double most = std::max(gains.max_acceleration, 0.5 * kGravity);
  Vec3d a = error * gains.velocity;
  if (const double norm = Norm(a); norm > most) a *= most / norm;
  state.outer_force = a + state.velocity_integral + r.a + Vec3d{0, 0, kGravity};
}

}  // namespace

RotorWrench Px4Wrench(const TrackingStep& step, AutopilotState& state) {
  const bool by_hand = IsByHand(step.goal);
  const Vec3d w = step.estimate.w_WB_B, v = step.estimate.v_WB;
  const Vec3d a_now = state.has_history ? (v - state.previous_v) / step.dt : Vec3d{};
  const Vec3d alpha_now = state.has_history ? (w - state.previous_w) / step.dt : Vec3d{};
  // Derivative terms see filtered rates of change.
  state.disturbance_a += (a_now - state.disturbance_a) * step.filter;
  state.disturbance_alpha += (alpha_now - state.disturbance_alpha) * step.filter;
  state.previous_v = v;
  state.previous_w = w;
  state.has_history = 1;

  RunOuter(step, state);
  const Vec3d damping = (state.disturbance_a - step.goal.reference.a) * (kVelocityD * step.gains.velocity);
  const Vec3d force = state.outer_force - damping;
  const AttitudeDemand demand = by_hand ? DemandByHand(step, force.z - kGravity) : DemandForForce(step, force, false);

  // Rate PID; the integral is bounded by half of what the rotors can do.
  const Vec3d error = WantedRates(step, demand) - w;
  const Vec3d k = step.gains.rate;
  for (int i = 0; i < 3; ++i) {
    const double most = 0.5 * step.gains.authority[i];
    const double integral = state.rate_integral[i] + kRateI * k[i] * error[i] * step.dt;
    state.rate_integral[i] = std::clamp(integral, -most, most);
  }
  const double damping_time = std::min(kRateD, 0.5 * step.gains.lag);
  const Vec3d alpha = k * error + state.rate_integral - k * state.disturbance_alpha * damping_time;
  return {TorqueFor(step.model, alpha, w), demand.thrust};
}

}  // namespace airsim360::internal

// Flat feed-forward with incremental nonlinear dynamic inversion: E. Tal, S. Karaman, CDC 2018
// (arXiv 1809.04048); drag in the feed-forward after Faessler, Franchi and Scaramuzza, RA-L 2018. Written as
// a disturbance observer, which is the same increment: what the measured accelerations hold beyond the thrust
// and torque of the measured rotor speeds is taken off the next demand.
#include <algorithm>
#include <cmath>

#include "airsim360/flight/control/tracking.h"

namespace airsim360::internal {
namespace {

// Bounds of the observed disturbances: collisions are not flown against.
constexpr double kMostForce = 2 * kGravity;
constexpr double kMostTorque = 1.5;  // of the authority
// The ground carries a drone that does not move and whose rotors give less than this share of its weight.
constexpr double kCarriedWeight = 0.7, kRestSpeed = 0.05;

Vec3d Clamp(Vec3d v, Vec3d most) { return Min(Max(v, -most), most); }

/// Filters the disturbances of the interval that has just ended.
void Observe(const TrackingStep& step, AutopilotState& state) {
  RotorValues thrust{};
  Vec3d spin;
  for (int i = 0; i < step.mixer.rotors(); ++i) {
    const RotorModel& rotor = step.model.rotors[i];
    const double speed = step.estimate.rotor_speeds[i];
    thrust[i] = ThrustAtSpeed(rotor, speed);
    spin -= rotor.axis_B * (rotor.direction * rotor.inertia * speed);
  }
  const RotorWrench wrench = step.mixer.WrenchOf(thrust);
  const Vec3d force = step.R_WB.column(2) * (wrench.thrust / step.model.mass);
  const Vec3d v = step.estimate.v_WB, w = step.estimate.w_WB_B;
  const bool carried = wrench.thrust < kCarriedWeight * step.model.mass * kGravity && Norm(v) < kRestSpeed;
  if (carried) {
    state.disturbance_a = state.disturbance_alpha = {};
  } else if (state.has_history) {
    // Means over the interval on both sides, so that they belong to the same time.
    const Vec3d mean_force = (force + state.previous_force_W) * 0.5;
    const Vec3d spun_up = (spin - state.previous_spin_B) / step.dt;
    const Vec3d mean_torque = (wrench.torque_B + state.previous_wrench.torque_B) * 0.5 - spun_up;
    const Vec3d mean_w = (w + state.previous_w) * 0.5;
    const Mat3d& J = step.model.inertia_B;
    const Vec3d a = (v - state.previous_v) / step.dt + Vec3d{0, 0, kGravity} - mean_force;
    const Vec3d alpha = (w - state.previous_w) / step.dt - SolveInertia(J, mean_torque - Cross(mean_w, J * mean_w));
    state.disturbance_a += (a - state.disturbance_a) * step.filter;
    state.disturbance_alpha += (alpha - state.disturbance_alpha) * step.filter;
    state.disturbance_a = Clamp(state.disturbance_a, {kMostForce, kMostForce, kMostForce});
    state.disturbance_alpha = Clamp(state.disturbance_alpha, step.gains.authority * kMostTorque);
  }
  state.previous_v = v;
  state.previous_w = w;
  state.previous_wrench = wrench;
  state.previous_spin_B = spin;
  state.previous_force_W = force;
  state.has_history = 1;
}

}  // namespace

RotorWrench IndiWrench(const TrackingStep& step, AutopilotState& state) {
  Observe(step, state);
  const Vec3d a = WantedAcceleration(step) - state.disturbance_a;
  const AttitudeDemand demand = IsByHand(step.goal) ? DemandByHand(step, a.z) : DemandForForce(step, a + Vec3d{0, 0, kGravity}, true);
  const Vec3d w = step.estimate.w_WB_B;
  const Vec3d alpha = step.gains.rate * (WantedRates(step, demand) - w) + demand.alpha_B;
  return {TorqueFor(step.model, alpha - state.disturbance_alpha, w), demand.thrust};
}

}  // namespace airsim360::internal

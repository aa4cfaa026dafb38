// What the tracking controllers share: the loops of position and velocity, wanted attitudes, limits.
#pragma once

#include "airsim360/flight/control/autopilot.h"
#include "airsim360/flight/control/goal.h"

namespace airsim360::internal {

/// One control step seen by a controller.
struct TrackingStep {
  const DroneModel& model;
  const ControlGains& gains;
  const Mixer& mixer;
  const StateEstimate& estimate;
  Mat3d R_WB;
  const Goal& goal;
  double dt;
  double filter;  ///< share of a new sample in filtered accelerations
};

/// What the outer loops ask of the inner ones.
struct AttitudeDemand {
  bool rates_only = false;  ///< w_B alone counts
  Vec3d w_B;                ///< rad/s: rates, or the feed-forward of the attitude, in the present body frame
  Vec3d alpha_B;            ///< rad/s^2: feed-forward, in the present body frame
  Mat3d R_WD;               ///< wanted attitude
  double thrust = 0;        ///< N along +Z of B
};

/// a_ref + K_v (K_p (p_ref - p) + v_ref - v): the speed that makes up for a lost position is limited.
Vec3d WantedAcceleration(const TrackingStep& step);

/// The attitude and thrust for a specific force (m/s^2, gravity excluded: f = a + g). What the rotors cannot
/// give is taken from its level part first, so that the height is kept. With feed-forward, rates follow the
/// reference's derivatives including its drag; without, only its heading.
AttitudeDemand DemandForForce(const TrackingStep& step, Vec3d f_W, bool feed_forward);

/// The demand of goals that give rates or an attitude; `a_z` is the upward acceleration wanted where the
/// throttle is not given.
AttitudeDemand DemandByHand(const TrackingStep& step, double a_z);

bool IsByHand(const Goal& goal);

/// The attitude loop: body rates wanted, within the drone's limits.
Vec3d WantedRates(const TrackingStep& step, const AttitudeDemand& demand);

/// J alpha + w x J w.
Vec3d TorqueFor(const DroneModel& model, Vec3d alpha_B, Vec3d w_B);
Vec3d SolveInertia(const Mat3d& J, Vec3d torque);

// The controllers. Each is told what it holds in AutopilotState.
RotorWrench Px4Wrench(const TrackingStep& step, AutopilotState& state);
RotorWrench Se3Wrench(const TrackingStep& step, AutopilotState& state);
RotorWrench IndiWrench(const TrackingStep& step, AutopilotState& state);

}  // namespace airsim360::internal

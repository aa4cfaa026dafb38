// Geometric tracking control on SE(3): T. Lee, M. Leok, N. H. McClamroch, CDC 2010, equations 15 to 20. Gains
// are those of the drone's inertia (k_R = J K_a K_w, k_w = J K_w). It remembers nothing.
#include "airsim360/flight/control/tracking.h"

namespace airsim360::internal {

RotorWrench Se3Wrench(const TrackingStep& step, AutopilotState&) {
  const Vec3d a = WantedAcceleration(step);
  const AttitudeDemand demand = IsByHand(step.goal) ? DemandByHand(step, a.z) : DemandForForce(step, a + Vec3d{0, 0, kGravity}, true);
  const Vec3d w = step.estimate.w_WB_B;

  // e_R = 1/2 (R_d' R - R' R_d)^vee, e_w = w - R' R_d w_d.
  Vec3d e_R;
  if (!demand.rates_only) {
    const Mat3d M = demand.R_WD.transpose() * step.R_WB;
    e_R = Vec3d{M.m[2][1] - M.m[1][2], M.m[0][2] - M.m[2][0], M.m[1][0] - M.m[0][1]} * 0.5;
  }
  const Vec3d e_w = w - demand.w_B;
  // M = -k_R e_R - k_w e_w + w x J w - J (w x R' R_d w_d - R' R_d alpha_d)
  const Vec3d k_w = step.gains.rate, k_R = step.gains.rate * step.gains.attitude;
  const Vec3d alpha = demand.alpha_B - k_R * e_R - k_w * e_w - Cross(w, demand.w_B);
  return {TorqueFor(step.model, alpha, w), demand.thrust};
}

}  // namespace airsim360::internal

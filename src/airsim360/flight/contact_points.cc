#include "airsim360/flight/contact_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace airsim360::internal {
namespace {

/// Metres along +n_B that frees the box from a point q_B inside it; n_B is unit.
double WayOut(Vec3d half, Vec3d q_B, Vec3d n_B) {
  double way = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (std::abs(n_B[i]) < 1e-9) continue;
    // The point goes along -n_B in the box's frame.
    const double wall = n_B[i] > 0 ? -half[i] : half[i];
    way = std::min(way, (q_B[i] - wall) / n_B[i]);
  }
  return way;
}

void AddNearest(const DroneModel& model, const DroneState& state, const Mat3d& R, const SurfacePoint& nearest,
                std::vector<Contact>& contacts) {
  const Vec3d arm = nearest.p_W - state.p_WB, half = model.half_size_B;
  const double distance = Norm(arm);
  const Vec3d q_B = R.transpose() * arm;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(q_B[i]) >= half[i]) return;
  }
  if (distance < 1e-9) return;
  SurfacePoint surface = nearest;
  surface.normal_W = arm / -distance;
  contacts.push_back({arm, WayOut(half, q_B, R.transpose() * surface.normal_W), surface});
}

}  // namespace

double BoxReach(const DroneModel& model, const Mat3d& R_WB, Vec3d n_W) {
  double reach = 0;
  for (int i = 0; i < 3; ++i) reach += model.half_size_B[i] * std::abs(Dot(R_WB.column(i), n_W));
  return reach;
}

void FindContacts(const DroneModel& model, const ContactQuery& query, const DroneState& state,
                  const SurfacePoint& nearest, std::vector<Contact>& contacts) {
  const Mat3d R = ToMatrix(state.q_WB);
  for (int i = 0; i < 27; ++i) {
    if (i == 13) continue;  // the centre
    const Vec3d place{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
    const Vec3d arm = R * (place * model.half_size_B);
    const auto hit = query.FirstHit(state.p_WB, state.p_WB + arm);
    if (!hit) continue;
    const double depth = Dot(hit->p_W - (state.p_WB + arm), hit->normal_W);
    if (depth > 0) contacts.push_back({arm, depth, *hit});
  }
  AddNearest(model, state, R, nearest, contacts);
}

}  // namespace airsim360::internal

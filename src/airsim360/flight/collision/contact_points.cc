#include "airsim360/flight/collision/contact_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

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

/// The nearest point with the normal that leads from it to the centre.
SurfacePoint TowardsCentre(const SurfacePoint& nearest, const DroneState& state) {
  SurfacePoint out = nearest;
  out.normal_W = Normalized(state.p_WB - nearest.p_W);
  return out;
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
  const SurfacePoint surface = TowardsCentre(nearest, state);
  contacts.push_back({arm, WayOut(half, q_B, R.transpose() * surface.normal_W), surface});
}

/// Whether a corner found before touches the same plane: it then speaks for the places between corners too.
bool IsCovered(const SurfacePoint& hit, std::span<const Contact> found) {
  constexpr double kSamePlane = 1e-3;  // metres, and of unit normals
  for (const Contact& c : found) {
    if (Dot(hit.normal_W, c.surface.normal_W) < 1 - kSamePlane) continue;
    if (std::abs(Dot(hit.p_W - c.surface.p_W, c.surface.normal_W)) < kSamePlane) return true;
  }
  return false;
}

void AddRay(const ContactQuery& query, const DroneState& state, Vec3d arm, bool corner, std::vector<Contact>& contacts) {
  const auto hit = query.FirstHit(state.p_WB, state.p_WB + arm);
  if (!hit || (!corner && IsCovered(*hit, contacts))) return;
  const double depth = Dot(hit->p_W - (state.p_WB + arm), hit->normal_W);
  if (depth > 0) contacts.push_back({arm, depth, *hit});
}

}  // namespace

double BoxReach(const DroneModel& model, const Mat3d& R_WB, Vec3d n_W) {
  double reach = 0;
  for (int i = 0; i < 3; ++i) reach += model.half_size_B[i] * std::abs(Dot(R_WB.column(i), n_W));
  return reach;
}

void FindContacts(const DroneModel& model, const ContactQuery& query, const DroneState& state, const SurfacePoint& nearest,
                  std::vector<Contact>& contacts) {
  const Mat3d R = ToMatrix(state.q_WB);
  const size_t first = contacts.size();
  for (const bool corners : {true, false}) {
    for (int i = 0; i < 27; ++i) {
      const Vec3d place{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
      const double sides = Dot(place, place);
      if (sides == 0 || (sides == 3) != corners) continue;
      AddRay(query, state, R * (place * model.half_size_B), corners, contacts);
    }
  }
  // Where rays have found something, the nearest point adds only what is not on the same planes.
  if (contacts.size() == first || !IsCovered(TowardsCentre(nearest, state), contacts)) {
    AddNearest(model, state, R, nearest, contacts);
  }
}

}  // namespace airsim360::internal

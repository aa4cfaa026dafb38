#include "airsim360/flight/collision/contact.h"

#include <algorithm>
#include <vector>

#include "airsim360/flight/collision/contact_points.h"
#include "airsim360/flight/collision/contact_solver.h"

namespace airsim360 {
namespace {

using internal::Contact;

/// How far beyond the box surfaces are looked for: at 30 m/s, once in 30 steps of 1 ms.
constexpr double kLookAhead = 1;
/// Impacts slower than this, or than two steps of free fall, do not bounce: a drone at rest stays at rest.
constexpr double kRestSpeed = 0.1;

/// If the centre has passed a surface, takes it back along its way to where the box touches, at most to its
/// start, and notes the contact.
void StopAtSurface(const DroneModel& model, const ContactQuery& query, Vec3d from, DroneState& after, std::vector<Contact>& contacts) {
  const auto hit = query.FirstHit(from, after.p_WB);
  if (!hit) return;
  const Vec3d n = hit->normal_W;
  const double start = Dot(from - hit->p_W, n), end = Dot(after.p_WB - hit->p_W, n);
  const double reach = internal::BoxReach(model, ToMatrix(after.q_WB), n);
  const double share = start - end > 1e-12 ? std::clamp((start - reach) / (start - end), 0.0, 1.0) : 0;
  const Vec3d stopped = from + (after.p_WB - from) * share;
  const double back = Dot(stopped - after.p_WB, n);
  after.p_WB = stopped;
  contacts.push_back({n * -reach, std::max(0.0, back), *hit});
}

/// Moves the drone out of what it reaches into, but its centre through nothing.
void MoveOut(const ContactQuery& query, std::span<const Contact> contacts, DroneState& after) {
  const Vec3d shift = internal::ShiftOut(contacts);
  const auto hit = query.FirstHit(after.p_WB, after.p_WB + shift);
  after.p_WB = hit ? (after.p_WB + hit->p_W) * 0.5 : after.p_WB + shift;
}

}  // namespace

ContactReport ResolveContacts(const DroneModel& model, const ContactProperties& properties, const ContactQuery& query,
                              const DroneState& before, double dt, double surface_speed, DroneState& after, ContactState& contact) {
  contact.free_distance -= Norm(after.p_WB - before.p_WB) + surface_speed * dt;
  if (contact.free_distance > 0) return {};

  // A step from where surfaces may be near: the way of the centre, then the box at its end.
  const DroneState free = after;
  std::vector<Contact> contacts;
  StopAtSurface(model, query, before.p_WB, after, contacts);
  const size_t stopped = contacts.size();
  const double reach = Norm(model.half_size_B);
  const auto nearest = query.Nearest(after.p_WB, reach + kLookAhead);
  const double distance = nearest ? Norm(nearest->p_W - after.p_WB) : reach + kLookAhead;
  contact.free_distance = distance - reach;
  if (distance < reach) internal::FindContacts(model, query, after, *nearest, contacts);
  if (contacts.empty()) return {};

  contact.free_distance = 0;
  const Vec3d acceleration = (free.v_WB - before.v_WB) / dt;
  const double rest_speed = std::max(kRestSpeed, 2 * kGravity * dt);
  const internal::Impact impact = internal::ApplyImpulses(model, properties, contacts, acceleration, rest_speed, after);
  MoveOut(query, std::span(contacts).subspan(stopped), after);
  internal::LimitEnergy(model, internal::MechanicalEnergy(model, free), after);

  const bool crashed = impact.speed > properties.crash_speed;
  contact.crashed = contact.crashed || crashed;
  return {true, crashed, impact.speed, contacts[impact.contact].depth, contacts[impact.contact].surface};
}

}  // namespace airsim360

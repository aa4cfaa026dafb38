#include "airsim360/flight/collision/contact_solver.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace airsim360::internal {
namespace {

constexpr int kRounds = 40;
// Rounds end when no impulse changes the speed by more than this share of the fastest contact's.
constexpr double kPrecision = 1e-7;

Mat3d Inverse(const Mat3d& m) {
  const Vec3d a = m.column(0), b = m.column(1), c = m.column(2);
  const double det = m.determinant();
  return Mat3d::FromColumns(Cross(b, c) / det, Cross(c, a) / det, Cross(a, b) / det).transpose();
}

/// The body as impulses see it, all in W.
struct Body {
  double inverse_mass;
  Mat3d inverse_inertia;
  Vec3d v, w;

  Vec3d VelocityAt(Vec3d arm) const { return v + Cross(w, arm); }
  /// Change of speed along n at `arm` by a unit impulse along n.
  double Ease(Vec3d arm, Vec3d n) const {
    const Vec3d turn = Cross(arm, n);
    return inverse_mass + Dot(turn, inverse_inertia * turn);
  }
  void Push(Vec3d arm, Vec3d impulse) {
    v += impulse * inverse_mass;
    w += inverse_inertia * Cross(arm, impulse);
  }
};

struct ContactImpulse {
  double bounce;   ///< speed out of the surface that is to be reached
  double ease;     ///< of the contact along its normal
  double normal;   ///< impulse so far
  Vec3d friction;  ///< likewise, along the surface
};

double BounceSpeed(const ContactProperties& properties, const Contact& c, double into, Vec3d acceleration, double rest_speed) {
  if (into <= rest_speed) return 0;
  const double gained = 2 * std::max(0.0, -Dot(acceleration, c.surface.normal_W)) * c.depth;
  return properties.restitution * std::sqrt(std::max(0.0, into * into - gained));
}

/// Both return by how much they have changed the speed.
double PushOut(const Contact& c, Body& body, ContactImpulse& impulse) {
  const Vec3d n = c.surface.normal_W;
  const double lacking = impulse.bounce - Dot(body.VelocityAt(c.arm_W), n);
  const double total = std::max(0.0, impulse.normal + lacking / impulse.ease), change = total - impulse.normal;
  body.Push(c.arm_W, n * change);
  impulse.normal = total;
  return std::abs(change) * impulse.ease;
}

double Rub(const Contact& c, double friction, Body& body, ContactImpulse& impulse) {
  const Vec3d n = c.surface.normal_W, u = body.VelocityAt(c.arm_W);
  const Vec3d along = u - n * Dot(u, n);
  const double speed = Norm(along);
  if (speed < 1e-12) return 0;
  Vec3d total = impulse.friction - along / body.Ease(c.arm_W, along / speed);
  const double size = Norm(total), most = friction * impulse.normal;
  if (size > most) total *= most / size;
  const Vec3d change = total - impulse.friction;
  body.Push(c.arm_W, change);
  impulse.friction = total;
  return Norm(change) * impulse.ease;
}

}  // namespace

Impact ApplyImpulses(const DroneModel& model, const ContactProperties& properties, std::span<const Contact> contacts, Vec3d acceleration_W,
                     double rest_speed, DroneState& state) {
  const Mat3d R = ToMatrix(state.q_WB);
  Body body{1 / model.mass, R * Inverse(model.inertia_B) * R.transpose(), state.v_WB, R * state.w_WB_B};
  Impact impact;
  std::vector<ContactImpulse> impulses;
  impulses.reserve(contacts.size());
  for (size_t i = 0; i < contacts.size(); ++i) {
    const double into = -Dot(body.VelocityAt(contacts[i].arm_W), contacts[i].surface.normal_W);
    impulses.push_back({BounceSpeed(properties, contacts[i], into, acceleration_W, rest_speed),
                        body.Ease(contacts[i].arm_W, contacts[i].surface.normal_W),
                        0,
                        {}});
    if (i == 0 || into > impact.speed) impact = {std::max(0.0, into), i};
  }
  for (int round = 0; round < kRounds; ++round) {
    double change = 0;
    for (size_t i = 0; i < contacts.size(); ++i) {
      change = std::max(change, PushOut(contacts[i], body, impulses[i]));
      change = std::max(change, Rub(contacts[i], properties.friction, body, impulses[i]));
    }
    if (change <= kPrecision * impact.speed) break;
  }
  state.v_WB = body.v;
  state.w_WB_B = R.transpose() * body.w;
  return impact;
}

Vec3d ShiftOut(std::span<const Contact> contacts) {
  Vec3d shift;
  for (int round = 0; round < 8; ++round) {
    for (const Contact& c : contacts) {
      const double left = c.depth - Dot(shift, c.surface.normal_W);
      if (left > 0) shift += c.surface.normal_W * left;
    }
  }
  return shift;
}

namespace {
double KineticEnergy(const DroneModel& model, const DroneState& s) {
  return 0.5 * (model.mass * Dot(s.v_WB, s.v_WB) + Dot(s.w_WB_B, model.inertia_B * s.w_WB_B));
}
}  // namespace

double MechanicalEnergy(const DroneModel& model, const DroneState& s) { return KineticEnergy(model, s) + model.mass * kGravity * s.p_WB.z; }

void LimitEnergy(const DroneModel& model, double most, DroneState& s) {
  const double excess = MechanicalEnergy(model, s) - most;
  if (excess <= 0) return;
  const double kinetic = KineticEnergy(model, s);
  const double scale = kinetic > excess ? std::sqrt(1 - excess / kinetic) : 0;
  s.v_WB *= scale;
  s.w_WB_B *= scale;
  // At rest and still too high, by nanometres: back down into the surface.
  if (excess > kinetic) s.p_WB.z -= (excess - kinetic) / (model.mass * kGravity);
}

}  // namespace airsim360::internal

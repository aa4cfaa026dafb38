#include "airsim360/people/motion/blend.h"

#include <algorithm>
#include <cmath>

#include "airsim360/people/body/anatomy.h"

namespace airsim360::internal {
namespace {

constexpr double kDelta = 1.0 / 120;  // seconds, for rates by differences

// x(t) and x'(t) of a critically damped spring: (x0 + (v0 + w x0) t) e^(-w t).
struct Decay {
  double a, b;    // x = a x0 + b v0
  double da, db;  // x' = da x0 + db v0
};

Decay DecayAt(const MotionState& m) {
  const double w = m.blend_rate, t = static_cast<double>(m.t_ns - m.blend_since_ns) * 1e-9;
  if (w <= 0 || w * t > 14) return {};
  const double e = std::exp(-w * t);
  return {e * (1 + w * t), e * t, -e * w * w * t, e * (1 - w * t)};
}

Vec3d Mixed(double a, Vec3f x, double b, Vec3f v) { return VecCast<double>(x) * a + VecCast<double>(v) * b; }

Vec3d Limited(Vec3d v, double limit) {
  const double n = Norm(v);
  return n > limit ? v * (limit / n) : v;
}

// Where the pelvis is in P, height included.
Vec3d PelvisOf(const Body& body, const MotionState& motion, const PersonState& state, const Posture& posture, Vec3d shift) {
  const LegInput in = LegInputOf(body, motion, state, posture, shift);
  return in.X_WP.inverse() * SolveLegs(in).p_W_pelvis;
}

bool LowPosture(Behaviour b) { return b == Behaviour::kSit || b == Behaviour::kCrouch || b == Behaviour::kStretch; }

}  // namespace

Vec3d AddOffsets(const MotionState& m, Posture& posture) {
  const Decay d = DecayAt(m);
  if (d.a == 0) return {};
  for (size_t k = 0; k < posture.turn.size(); ++k)
    posture.turn[k] = FromRotationVector(Mixed(d.a, m.turn[k], d.b, m.turn_rate[k])) * posture.turn[k];
  for (size_t side = 0; side < 2; ++side) posture.curl[side] += d.a * static_cast<double>(m.curl[side]);
  return Mixed(d.a, m.shift, d.b, m.shift_rate);
}

bool NeedsSwitch(const MotionState& m, const PersonState& state) {
  return m.lower != state.lower || m.upper != state.upper || m.speaking != uint32_t{state.speaking} ||
         m.has_gaze != uint32_t{state.has_gaze} || m.upper_since_ns != state.upper_since_ns || m.lower_since_ns != state.lower_since_ns;
}

void SwitchMotion(const Body& body, const PersonState& state, MotionState& motion) {
  // The old motion goes on under the old speech and gaze.
  PersonState before = state;
  before.speaking = motion.speaking != 0;
  before.has_gaze = motion.has_gaze != 0;
  before.p_W_gaze = motion.gaze;
  const PostureInput old_in = InputOf(body, motion, before);
  PostureInput old_past = old_in;
  for (double* t : {&old_past.t, &old_past.t_lower, &old_past.t_upper}) *t -= kDelta;
  const Posture old_now = PostureOf(old_in), old_then = PostureOf(old_past);
  const Decay d = DecayAt(motion);
  Posture shown = old_now;
  const Vec3d shift = AddOffsets(motion, shown);
  const Vec3d pelvis = PelvisOf(body, motion, before, shown, shift);
  std::array<Vec3d, kBlendedJoints> rate;
  for (size_t k = 0; k < rate.size(); ++k) {
    rate[k] =
        ToRotationVector(old_now.turn[k] * old_then.turn[k].transpose()) / kDelta + Mixed(d.da, motion.turn[k], d.db, motion.turn_rate[k]);
  }
  const Vec3d shift_rate = Mixed(d.da, motion.shift, d.db, motion.shift_rate);

  // The new one from here.
  const bool slow = LowPosture(motion.lower) != LowPosture(state.lower) || (LowPosture(state.lower) && motion.lower != state.lower);
  motion.lower = state.lower;
  motion.upper = state.upper;
  motion.lower_since_ns = state.lower_since_ns;
  motion.upper_since_ns = state.upper_since_ns;
  motion.speaking = state.speaking;
  motion.has_gaze = state.has_gaze;
  const PostureInput new_in = InputOf(body, motion, state);
  PostureInput new_next = new_in;
  for (double* t : {&new_next.t, &new_next.t_lower, &new_next.t_upper}) *t += kDelta;
  const Posture now = PostureOf(new_in), next = PostureOf(new_next);
  for (size_t k = 0; k < rate.size(); ++k) {
    const Vec3d turn = ToRotationVector(shown.turn[k] * now.turn[k].transpose());
    const Vec3d own = ToRotationVector(next.turn[k] * now.turn[k].transpose()) / kDelta;
    motion.turn[k] = VecCast<float>(turn);
    motion.turn_rate[k] = VecCast<float>(Limited(rate[k] - own, 6));
  }
  for (size_t side = 0; side < 2; ++side) motion.curl[side] = static_cast<float>(shown.curl[side] - now.curl[side]);
  motion.shift = VecCast<float>(pelvis - PelvisOf(body, motion, state, now, {}));
  motion.shift_rate = VecCast<float>(Limited(shift_rate, 1));
  motion.blend_since_ns = motion.t_ns;
  motion.blend_rate = slow ? 4.2f : 8.5f;
}

}  // namespace airsim360::internal

// What has memory: phase, planted feet, switches.
#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/people/body/anatomy.h"
#include "airsim360/people/motion/blend.h"

namespace airsim360 {

double WalkStepLength(double speed, double leg) {
  // Adult leg of 0.93 m at the same Froude number; below 1.03 m/s steps shrink less than the ratio says.
  const double adult = speed / std::sqrt(leg / 0.93), ratio = 0.0064;
  const double length = std::sqrt(60 * std::max(adult, 0.02) * ratio);
  return std::max(0.12, length) * leg / 0.93;
}

double RunStepLength(double speed, double leg) {
  const double adult = speed / std::sqrt(leg / 0.93);
  const double cadence = 2.5 + 0.11 * std::clamp(adult - 2.0, 0.0, 4.0);  // steps per second
  return adult / cadence * leg / 0.93;
}

double WalkRunSpeed(double leg) { return std::sqrt(0.5 * 9.81 * leg); }

namespace internal {
namespace {

using Mode = FootMotion::Mode;

double WrapTurn(double a) { return a - kTau * std::round(a / kTau); }

GroundPoint GroundAt(const Ground* ground, Vec3d p) { return ground == nullptr ? GroundPoint{p.z, {0, 0, 1}} : ground->At(p); }

class Stepper {
 public:
  Stepper(const Body& body, const PersonState& state, const Ground* ground, MotionState& m, double dt)
      : body_(body), state_(state), ground_(ground), m_(m), dt_(dt), R_(RotationZ(state.yaw)) {}

  void Advance() {
    Follow();
    const double moving = std::hypot(m_.speed, m_.side_speed);
    if (walks_ && started_) ChooseFirstFoot();
    if (walks_) {
      const double length = WalkStepLength(moving, leg_) * (1 - m_.run) + RunStepLength(moving, leg_) * m_.run;
      rate_ = moving / (2 * length);
      // People differ by 3 %.
      rate_ *= 1 + 0.03 * (2 * Draw(m_.seed, 70, 0) - 1);
      m_.phase += dt_ * rate_;
      m_.phase -= std::floor(m_.phase);
    }
    gait_ = GaitOf(body_, m_);
    for (size_t k = 0; k < 2; ++k) {
      if (walks_)
        Walk(k);
      else
        Stand(k);
    }
  }

 private:
  // Speeds, turning, weights of the gait.
  void Follow() {
    const Vec3d v = R_.transpose() * state_.v_WP;
    const double keep = std::exp(-dt_ / 0.10);
    m_.speed = v.x + (m_.speed - v.x) * keep;
    m_.side_speed = v.y + (m_.side_speed - v.y) * keep;
    const double turn = WrapTurn(state_.yaw - m_.last_yaw) / dt_;
    m_.yaw_rate = turn + (m_.yaw_rate - turn) * std::exp(-dt_ / 0.2);
    m_.last_yaw = state_.yaw;
    const double moving = std::hypot(m_.speed, m_.side_speed), now = std::hypot(v.x, v.y);
    const bool still = state_.lower == Behaviour::kSit || state_.lower == Behaviour::kCrouch || state_.lower == Behaviour::kStretch;
    // Between the two limits walkers go on and standing people stay.
    const bool walked = m_.gait > 0;
    walks_ = !still && (now > 0.12 || (walked && now > 0.04));
    started_ = walks_ && !walked;
    const double wanted = walks_ ? SmoothStep(-0.1, 0.55, moving) : 0;
    m_.gait += std::clamp(wanted - m_.gait, -dt_ / 0.35, dt_ / 0.30);
    leg_ = LegLength(body_);
    const bool runs = moving > 1.1 * WalkRunSpeed(leg_) ||
                      ((state_.lower == Behaviour::kRun || state_.lower == Behaviour::kJog) && moving > 0.6 * WalkRunSpeed(leg_));
    m_.run += std::clamp((runs ? 1.0 : 0.0) - m_.run, -dt_ / 0.5, dt_ / 0.5);
  }

  // The foot farther behind goes first.
  void ChooseFirstFoot() {
    const auto along = [&](size_t k) { return Dot(R_.column(0), m_.feet[k].p_W); };
    const double gap = along(0) - along(1);
    const bool left = std::abs(gap) < 0.02 ? Draw(m_.seed, 71, m_.t_ns / 1'000'000'000) < 0.5 : gap < 0;
    m_.phase = left ? 0.62 : 0.12;
  }

  // Ankle and pitch of a foot in the pose as it is now.
  SolvedLegs Solved() const {
    Posture posture = PostureOf(InputOf(body_, m_, state_));
    const Vec3d shift = AddOffsets(m_, posture);
    return SolveLegs(LegInputOf(body_, m_, state_, posture, shift));
  }

  void Walk(size_t k) {
    FootMotion& foot = m_.feet[k];
    const double phase = PhaseOf(m_, k), cadence = std::max(rate_, 0.2);
    if (foot.mode == Mode::kStep) return Step(k);
    // A foot comes off when its stance is over, or when the leg is too short to hold it.
    if (foot.mode == Mode::kPlanted && phase < 0.97 && (phase >= gait_.duty || (phase > 0.25 && Away(k) > 0.58 * leg_))) LiftOff(k, phase);
    if (foot.mode == Mode::kSwing && phase < foot.phase) return Land(k, phase / cadence);
    if (foot.mode == Mode::kSwing) {
      // Where it is going to land, and the ground there.
      Aim(k, -(1 - phase) / cadence);
    } else if (Away(k) > 0.85 * leg_ && m_.feet[1 - k].mode == Mode::kPlanted) {
      BeginStep(k);
    }
  }

  // The place of landing `late` seconds after contact was due (before: negative).
  void Aim(size_t k, double late) {
    FootMotion& foot = m_.feet[k];
    Vec3d place = LandingPlace(body_, gait_, k);
    place.y += m_.side_speed * 0.3 * gait_.duty / std::max(rate_, 0.5);
    const double yaw = state_.yaw - m_.yaw_rate * late;
    Vec3d p = state_.p_WP - state_.v_WP * late + RotationZ(yaw) * place;
    p.z = state_.p_WP.z;
    const GroundPoint g = GroundAt(ground_, p);
    p.z = g.z;
    foot.p_W_to = p;
    foot.normal = g.normal;
    foot.yaw_to = yaw + ToeOut(k);
  }

  void Land(size_t k, double late) {
    FootMotion& foot = m_.feet[k];
    Aim(k, late);
    Plant(foot, false);
  }

  static void Plant(FootMotion& foot, bool flat) {
    foot.mode = Mode::kPlanted;
    foot.p_W = foot.p_W_to;
    foot.yaw = foot.yaw_to;
    foot.u = flat ? 1 : 0;
  }

  void LiftOff(size_t k, double phase) {
    FootMotion& foot = m_.feet[k];
    const SolvedLeg leg = Solved().leg[k];
    foot.pitch = leg.pitch;
    foot.phase = phase;
    foot.p_W_to = foot.p_W;
    foot.yaw_to = foot.yaw;
    foot.offset = {};
    // What the curve gives here, and by how much the foot is elsewhere.
    foot.mode = Mode::kSwing;
    const SolvedLeg swing = Solved().leg[k];
    foot.offset = R_.transpose() * (leg.ankle - swing.ankle);
  }

  // How far a planted foot is from under the person.
  double Away(size_t k) const {
    const Vec3d d = m_.feet[k].p_W - state_.p_WP;
    return std::hypot(d.x, d.y);
  }

  void BeginStep(size_t k) {
    FootMotion& foot = m_.feet[k];
    // From where it is, as it is turned.
    const SolvedLeg leg = Solved().leg[k];
    const Vec3d toe = leg.A_foot.column(0);
    foot.yaw = std::atan2(toe.y, toe.x);
    foot.pitch = leg.pitch;
    foot.toes = leg.toes;
    foot.p_W = leg.ankle - RotationZ(foot.yaw) * AnkleOverBall(body_, k, leg.pitch);
    foot.mode = Mode::kStep;
    foot.u = 0;
    AimHome(k);
  }

  void AimHome(size_t k) {
    FootMotion& foot = m_.feet[k];
    // Where the person will stand when the foot comes down.
    Vec3d p = state_.p_WP + state_.v_WP * (0.38 * (1 - foot.u)) + R_ * HomePlace(body_, k);
    p.z = state_.p_WP.z;
    const GroundPoint g = GroundAt(ground_, p);
    p.z = g.z;
    foot.p_W_to = p;
    foot.normal = g.normal;
    foot.yaw_to = state_.yaw + ToeOut(k);
  }

  void Step(size_t k) {
    FootMotion& foot = m_.feet[k];
    foot.u += dt_ / 0.38;
    AimHome(k);
    if (foot.u >= 1) Plant(foot, true);
  }

  void Stand(size_t k) {
    FootMotion& foot = m_.feet[k];
    if (foot.mode == Mode::kStep) return Step(k);
    if (foot.mode == Mode::kSwing) return BeginStep(k);
    if (m_.feet[1 - k].mode != Mode::kPlanted) return;
    // One foot at a time goes home, the worse one first.
    const auto error = [&](size_t i) {
      const FootMotion& f = m_.feet[i];
      const Vec3d d = f.p_W - state_.p_WP - R_ * HomePlace(body_, i);
      return std::hypot(d.x, d.y) / 0.13 + std::abs(WrapTurn(f.yaw - state_.yaw - ToeOut(i))) / 0.45;
    };
    if (error(k) > 1 && error(k) >= error(1 - k)) BeginStep(k);
  }

  const Body& body_;
  const PersonState& state_;
  const Ground* ground_;
  MotionState& m_;
  double dt_, leg_ = 0.9, rate_ = 0;
  Mat3d R_;
  Gait gait_;
  bool walks_ = false, started_ = false;
};

void PlantAtHome(const Body& body, const PersonState& state, const Ground* ground, MotionState& motion) {
  for (size_t k = 0; k < 2; ++k) {
    FootMotion& foot = motion.feet[k];
    foot = {};
    Vec3d p = state.p_WP + RotationZ(state.yaw) * HomePlace(body, k);
    const GroundPoint g = GroundAt(ground, p);
    foot.p_W = foot.p_W_to = {p.x, p.y, g.z};
    foot.normal = g.normal;
    foot.yaw = foot.yaw_to = state.yaw + ToeOut(k);
    foot.u = 1;
  }
}

}  // namespace
}  // namespace internal

MotionState StartMotion(const Body& body, const PersonState& state, uint64_t seed, int64_t t_ns, const Ground* ground) {
  MotionState motion;
  motion.t_ns = t_ns;
  motion.seed = MixBits(seed ^ 0x70656f706c65);
  motion.last_yaw = state.yaw;
  motion.last_p_WP = state.p_WP;
  motion.gaze = state.p_W_gaze;
  motion.speaking = state.speaking;
  motion.has_gaze = state.has_gaze;
  motion.lower = state.lower;
  motion.upper = state.upper;
  motion.lower_since_ns = state.lower_since_ns;
  motion.upper_since_ns = state.upper_since_ns;
  internal::PlantAtHome(body, state, ground, motion);
  return motion;
}

void StepMotion(const Body& body, const PersonState& state, int64_t t_ns, const Ground* ground, MotionState& motion) {
  const double dt = std::min(0.2, static_cast<double>(t_ns - motion.t_ns) * 1e-9);
  if (dt <= 0) return;
  // Put elsewhere: as if just come.
  const Vec3d moved = state.p_WP - motion.last_p_WP;
  if (std::hypot(moved.x, moved.y) > 1 || std::abs(moved.z) > 1) {
    internal::PlantAtHome(body, state, ground, motion);
    motion.gait = 0;
    motion.last_yaw = state.yaw;
  }
  motion.t_ns = t_ns;
  if (internal::NeedsSwitch(motion, state)) internal::SwitchMotion(body, state, motion);
  internal::Stepper(body, state, ground, motion, dt).Advance();
  motion.last_p_WP = state.p_WP;
  motion.gaze = state.p_W_gaze;
}

void HashMotion(const MotionState& m, StateHasher& hasher) {
  hasher.Add(m.t_ns);
  hasher.Add(m.seed);
  for (double x : {m.phase, m.speed, m.side_speed, m.gait, m.run, m.yaw_rate, m.last_yaw}) hasher.Add(x);
  hasher.Add(m.last_p_WP);
  hasher.Add(m.gaze);
  hasher.Add(uint64_t{m.speaking} << 32 | m.has_gaze);
  hasher.Add(static_cast<uint64_t>(m.lower) << 8 | static_cast<uint64_t>(m.upper));
  hasher.Add(m.lower_since_ns);
  hasher.Add(m.upper_since_ns);
  for (const FootMotion& f : m.feet) {
    hasher.Add(static_cast<uint64_t>(f.mode));
    for (double x : {f.u, f.yaw, f.yaw_to, f.pitch, f.toes, f.phase}) hasher.Add(x);
    for (const Vec3d& v : {f.p_W, f.p_W_to, f.offset, f.normal}) hasher.Add(v);
  }
  hasher.Add(m.blend_since_ns);
  hasher.Add(static_cast<double>(m.blend_rate));
  for (size_t k = 0; k < m.turn.size(); ++k) {
    hasher.Add(m.turn[k]);
    hasher.Add(m.turn_rate[k]);
  }
  hasher.Add(m.shift);
  hasher.Add(m.shift_rate);
  for (const float c : m.curl) hasher.Add(static_cast<double>(c));
}

}  // namespace airsim360

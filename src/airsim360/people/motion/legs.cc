#include "airsim360/people/motion/legs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/math/angles.h"
#include "airsim360/people/body/anatomy.h"

namespace airsim360::internal {
namespace {

struct LegJoints {
  Joint hip, ankle, toes;
};
constexpr LegJoints kLegs[2] = {{Joint::kLeftHip, Joint::kLeftAnkle, Joint::kLeftToes},
                                {Joint::kRightHip, Joint::kRightAnkle, Joint::kRightToes}};

// The foot as a rigid piece: from the ball to the ankle, standing flat.
struct FootShape {
  Vec3d ball;  // from ankle to ball joint, rest
  double ankle_height, ball_height, heel;

  FootShape(const Body& body, size_t side) {
    ball = body.p_PJ[At(kLegs[side].toes)] - body.p_PJ[At(kLegs[side].ankle)];
    ankle_height = body.size.ankle_height;
    ball_height = std::max(0.0, ankle_height + ball.z);
    heel = body.size.heel_length;
  }
  // Ankle against the point of the ground under the ball of the flat foot, in the foot's frame: heel-up feet
  // pivot on the ball, toe-up feet on the heel.
  Vec3d AnkleAt(double pitch) const {
    const double c = std::cos(pitch), s = std::sin(pitch);
    if (pitch >= 0) {
      const double x = -ball.x, z = -ball.z;
      return {c * x + s * z, -ball.y, ball_height - s * x + c * z};
    }
    return {-(ball.x + heel) + c * heel + s * ankle_height, -ball.y, -s * heel + c * ankle_height};
  }
};

// Ankle against the hip in the plane of the gait, x forward, z up.
Vec3d Forward(const BodyDimensions& size, const LegAngles& a) {
  return {size.thigh * std::sin(a.hip) + size.shank * std::sin(a.hip - a.knee), 0,
          -size.thigh * std::cos(a.hip) - size.shank * std::cos(a.hip - a.knee)};
}

double Reach(const BodyDimensions& size, double knee) {
  return std::sqrt(size.thigh * size.thigh + size.shank * size.shank + 2 * size.thigh * size.shank * std::cos(knee));
}

// Sideways place of the ankle: walkers set their feet closer than their hips, runners more so.
double AnkleSide(const Body& body, const Gait& gait, size_t side) {
  return (side == 0 ? 1 : -1) * body.size.hip_half_width * (1 - gait.weight * (0.30 + 0.35 * gait.run));
}

Mat3d GroundFrame(Vec3d normal, double yaw) {
  const Mat3d turn = RotationZ(yaw);
  return normal.z > 0.99999 ? turn : RotationBetween({0, 0, 1}, normal) * turn;
}

// One foot on its way through PoseOf.
struct Foot {
  const FootMotion* motion = nullptr;
  double phase = 0;
  LegAngles curve;
  Mat3d frame;  // of the ground under it
  Vec3d ankle;  // in W
  double pitch = 0;
  double toes = 0;  // 1: toes stay on the ground
  bool planted = false;
  double carries = 0;  // 1: the pelvis is over it as it must be; 0: in the air
};

class Solver {
 public:
  explicit Solver(const LegInput& in) : in_(in), gait_(GaitOf(in.body, in.motion)), shapes_{FootShape(in.body, 0), FootShape(in.body, 1)} {
    for (size_t k = 0; k < 2; ++k) {
      Foot& foot = feet_[k];
      foot.motion = &in.motion.feet[k];
      foot.planted = foot.motion->mode == FootMotion::Mode::kPlanted;
      foot.phase = PhaseOf(in.motion, k);
      // A foot that is still down when its stance is over (the person stops) stands.
      foot.curve = LegCurves(gait_, foot.planted && foot.phase > gait_.duty + 0.1 ? 0.3 : foot.phase);
      hip_[k] = in.A_WPelvis * (in.body.p_PJ[At(kLegs[k].hip)] - in.body.p_PJ[At(Joint::kPelvis)]);
    }
  }

  SolvedLegs Solve() {
    for (size_t k = 0; k < 2; ++k) {
      SetPlanted(k);
      if (feet_[k].motion->mode == FootMotion::Mode::kStep) Step(k);
    }
    pelvis_ = in_.p_W_pelvis;
    if (in_.sink <= 0) pelvis_.z = Height();
    pelvis_ += in_.X_WP.R * in_.shift;
    Lower();
    SolvedLegs out;
    for (size_t k = 0; k < 2; ++k) {
      if (feet_[k].planted)
        RaiseHeel(k);
      else if (feet_[k].motion->mode == FootMotion::Mode::kSwing)
        Swing(k);
      out.leg[k] = Bend(k);
    }
    out.p_W_pelvis = pelvis_;
    return out;
  }

 private:
  // A planted foot at first contact tips over its heel; else it is flat until RaiseHeel.
  void SetPlanted(size_t k) {
    Foot& foot = feet_[k];
    if (!foot.planted) return;
    foot.frame = GroundFrame(foot.motion->normal, foot.motion->yaw);
    foot.pitch = foot.phase < 0.3 && foot.motion->u == 0 ? std::min(0.0, foot.curve.pitch) : 0;
    foot.ankle = foot.motion->p_W + foot.frame * shapes_[k].AnkleAt(foot.pitch);
    foot.toes = 1;
    foot.carries = 1;
  }

  // Height of the pelvis at which this leg has the knee of its curve; of a foot in the air, from the curve.
  double HeightOver(size_t k, double knee) const {
    const Foot& foot = feet_[k];
    const Vec3d hip = in_.p_W_pelvis + hip_[k];
    const double dx = foot.ankle.x - hip.x, dy = foot.ankle.y - hip.y, reach = Reach(in_.body.size, knee);
    const double rise2 = reach * reach - dx * dx - dy * dy;
    return foot.ankle.z + (rise2 > 0.01 * reach * reach ? std::sqrt(rise2) : 0.1 * reach) - hip_[k].z;
  }
  double CurveHeight(size_t k, double phase, double ground) const {
    const LegAngles a = LegCurves(gait_, phase);
    return ground + shapes_[k].AnkleAt(std::min(0.0, a.pitch)).z - Forward(in_.body.size, a).z - hip_[k].z;
  }

  double Height() const {
    // Standing: the lower of what both legs ask for; a foot that steps lets go and takes over by degrees.
    const bool none = !feet_[0].planted && !feet_[1].planted;
    double stand = none ? CurveHeight(0, feet_[0].phase, in_.state.p_WP.z) : 1e9;
    for (size_t k = 0; k < 2; ++k) {
      if (feet_[k].planted) stand = std::min(stand, HeightOver(k, feet_[k].curve.knee));
    }
    for (size_t k = 0; k < 2; ++k) {
      if (!feet_[k].planted && feet_[k].carries > 0) stand += std::min(0.0, HeightOver(k, feet_[k].curve.knee) - stand) * feet_[k].carries;
    }
    const double g = gait_.weight;
    if (g <= 0) return stand;

    // In a gait the leg of the first half of its stride carries; towards its end the height goes over to that
    // of the other leg's contact. Between lift-off and contact of a run: a throw.
    const size_t a = feet_[0].phase < 0.5 ? 0 : 1, b = 1 - a;
    const double phase = feet_[a].phase;
    double carried = CurveHeight(a, phase, in_.state.p_WP.z);
    if (feet_[a].planted) {
      // A foot left behind, as of people who start or stop at once, does not drag the pelvis down: its heel rises.
      constexpr double kDrag = 0.02;  // metres
      carried = std::max(HeightOver(a, feet_[a].curve.knee), CurveHeight(a, phase, feet_[a].motion->p_W.z) - kDrag);
    }
    const double from = gait_.run * 0.7 * gait_.duty + (1 - gait_.run) * 0.475;
    const double mix = SmoothStep(from, 0.5, phase);
    double height = carried;
    if (mix > 0) {
      const double ground = feet_[b].motion->mode == FootMotion::Mode::kPlanted ? feet_[b].motion->p_W.z : feet_[b].motion->p_W_to.z;
      height += (CurveHeight(b, 0, ground) - carried) * mix;
    }
    if (gait_.run > 0 && phase > gait_.duty) {
      const double u = (phase - gait_.duty) / (0.5 - gait_.duty);
      height += gait_.run * 0.03 * in_.body.spec.stature * 4 * u * (1 - u);
    }
    return stand + (height - stand) * g;
  }

  // How much heels may rise: not of people who stand, by degrees of those who stop.
  double HeelsRise() const { return SmoothStep(0, 0.4, gait_.weight); }

  // No leg is longer than it is: the pelvis comes down where a planted foot would be pulled off.
  void Lower() {
    const BodyDimensions& size = in_.body.size;
    const double straight = 0.998 * (size.thigh + size.shank);
    for (size_t k = 0; k < 2; ++k) {
      const Foot& foot = feet_[k];
      if (foot.carries <= 0) continue;
      const FootShape& shape = shapes_[k];
      // The highest that the pelvis can be with the leg stretched to a point; 1e9: out of reach at any height.
      const auto highest = [&](Vec3d pivot, double reach) {
        const Vec3d hip = pelvis_ + hip_[k], d = hip - pivot;
        const double rise2 = reach * reach - d.x * d.x - d.y * d.y;
        return rise2 > 0 ? pivot.z + std::sqrt(rise2) - hip_[k].z : 1e9;
      };
      double top = highest(foot.ankle, straight);
      // Late in its stance a foot may stand on its ball with the heel up.
      const double rise = foot.planted && foot.pitch >= 0 ? HeelsRise() * SmoothStep(0.15, 0.25, foot.phase) : 0;
      if (rise > 0) {
        const double up = highest(foot.motion->p_W + foot.frame * Vec3d{0, 0, shape.ball_height}, straight + 0.9 * Norm(shape.ball));
        top = top < 1e8 && up < 1e8 ? top + (up - top) * rise : std::min(top, up);
      }
      pelvis_.z += std::min(0.0, top - pelvis_.z) * foot.carries;
    }
  }

  // Heel-off: the pitch about the ball at which the leg has the knee of its curve.
  void RaiseHeel(size_t k) {
    Foot& foot = feet_[k];
    if (foot.pitch < 0) return;
    const FootShape& shape = shapes_[k];
    const Vec3d pivot = foot.motion->p_W + foot.frame * Vec3d{0, 0, shape.ball_height};
    const Vec3d h = foot.frame.transpose() * (pelvis_ + hip_[k] - pivot), v = -shape.ball;
    constexpr double kStraight = 0.03;
    const double knee = kStraight + (foot.curve.knee - kStraight) * HeelsRise();
    // h . R_y(pitch) v = (h^2 + v^2 - reach^2) / 2; 0 where the foot may stay flat.
    const double along = h.x * v.x + h.z * v.z, across = h.x * v.z - h.z * v.x;
    const double size = std::hypot(along, across), delta = std::atan2(across, along);
    const auto pitch_for = [&](double reach) {
      const double wanted = (Dot(h, h) + Dot(v, v) - reach * reach) / 2 - h.y * v.y;
      return wanted <= along ? 0 : std::max(0.0, delta - (wanted >= size ? 0 : std::acos(wanted / size)));
    };
    // Not faster than heels rise, unless the leg would be too short.
    const double usual = std::min(pitch_for(Reach(in_.body.size, knee)), std::max(0.0, foot.curve.pitch) + 0.2);
    foot.pitch = std::min(1.25, std::max(usual, pitch_for(0.998 * (in_.body.size.thigh + in_.body.size.shank))));
    foot.ankle = foot.motion->p_W + foot.frame * shape.AnkleAt(foot.pitch);
  }

  // The curve, corrected by what it was off at lift-off; near landing the ground decides the height.
  void Swing(size_t k) {
    Foot& foot = feet_[k];
    const FootMotion& m = *foot.motion;
    const double u = std::clamp((foot.phase < m.phase - 0.3 ? 1.0 : foot.phase - m.phase) / std::max(0.05, 1 - m.phase), 0.0, 1.0);
    const double keep = 1 - SmoothStep(0, 0.38 + 0.2 * gait_.run, u), early = 1 - SmoothStep(0, 0.45, u);
    const LegAngles lift = LegCurves(gait_, m.phase);
    foot.pitch = foot.curve.pitch + (m.pitch - lift.pitch) * early;
    foot.toes = 1 - SmoothStep(0, 0.25, u);
    double turn = m.yaw_to - m.yaw;
    turn -= 2 * std::numbers::pi * std::round(turn / (2 * std::numbers::pi));
    foot.frame = RotationZ(m.yaw + turn * SmoothStep(0, 1, u));

    const Vec3d fk = Forward(in_.body.size, foot.curve);
    const Vec3d hip = pelvis_ + hip_[k];
    // Against the person, not the hip, so that it ends where LandingPlace says.
    const double rest = in_.body.p_PJ[At(kLegs[k].hip)].x;
    Vec3d p = in_.X_WP * Vec3d{rest + fk.x, AnkleSide(in_.body, gait_, k), 0};
    p.z = hip.z + fk.z;
    foot.ankle = p + in_.X_WP.R * (m.offset * keep);
    // Landing: onto the ground that is there; before, clear of it.
    const double sole = shapes_[k].AnkleAt(foot.pitch).z, ground = m.p_W_to.z;
    const double landing = SmoothStep(0.95 - 0.07 * gait_.run, 1, u);
    foot.ankle.z += (ground + sole - foot.ankle.z) * landing;
    const double clear = 0.018 * SmoothStep(0, 0.25, u) * (1 - landing);
    const double floor = std::max(ground, in_.state.p_WP.z + (m.p_W.z - in_.state.p_WP.z) * (1 - u));
    foot.ankle.z = std::max(foot.ankle.z, floor + LowestPoint(k, foot.pitch) + clear);
  }

  // Ankle height at which the sole just touches, foot in the air: heel or tip of the toes, whichever is lower.
  double LowestPoint(size_t k, double pitch) const {
    const FootShape& shape = shapes_[k];
    const double c = std::cos(pitch), s = std::sin(pitch);
    return std::max(c * shape.ankle_height - s * shape.heel, c * shape.ankle_height + s * shape.ball.x);
  }

  // A step of a standing person, by time.
  void Step(size_t k) {
    Foot& foot = feet_[k];
    const FootMotion& m = *foot.motion;
    const double s = SmoothStep(0, 1, m.u), arc = 4 * m.u * (1 - m.u);
    double turn = m.yaw_to - m.yaw;
    turn -= 2 * std::numbers::pi * std::round(turn / (2 * std::numbers::pi));
    foot.frame = RotationZ(m.yaw + turn * s);
    foot.pitch = m.pitch * (1 - SmoothStep(0, 0.6, m.u)) + 0.25 * arc * (1 - m.u);
    foot.toes = m.toes * (1 - SmoothStep(0, 0.3, m.u));
    Vec3d ball = m.p_W + (m.p_W_to - m.p_W) * s;
    ball.z += 0.035 * arc;
    foot.carries = m.toes + (1 - m.toes) * s;
    foot.ankle = ball + foot.frame * shapes_[k].AnkleAt(foot.pitch);
  }

  // Hip, knee and ankle in one plane, the knee to the front.
  SolvedLeg Bend(size_t k) const {
    const BodyDimensions& size = in_.body.size;
    const Foot& foot = feet_[k];
    SolvedLeg out;
    out.pitch = foot.pitch;
    out.toes = foot.toes;
    out.hip = pelvis_ + hip_[k];
    const Vec3d to = foot.ankle - out.hip;
    const double a = size.thigh, b = size.shank;
    const double reach = std::clamp(Norm(to), std::abs(a - b) + 0.02, 0.9995 * (a + b));
    const Vec3d along = Normalized(to);
    // Knees point where body and foot do on average; a lifted thigh where the body does.
    Vec3d front = in_.X_WP.R.column(0) * 1.2 + foot.frame.column(0);
    if (along.z > -0.3) front += Vec3d{0, 0, 1.5};
    const Vec3d x = Normalized(front - along * Dot(front, along));
    const double cos_thigh = (a * a + reach * reach - b * b) / (2 * a * reach);
    const double sin_thigh = std::sqrt(std::max(0.0, 1 - cos_thigh * cos_thigh));
    const Vec3d thigh = along * cos_thigh + x * sin_thigh;
    out.knee = out.hip + thigh * a;
    out.ankle = out.hip + along * reach;
    const Vec3d shank = Normalized(out.ankle - out.knee), y = Cross(-along, x);
    out.A_thigh = Mat3d::FromColumns(Cross(y, -thigh), y, -thigh);
    out.A_shank = Mat3d::FromColumns(Cross(y, -shank), y, -shank);
    out.A_foot = foot.frame * RotationY(foot.pitch);
    const double bend = std::clamp(foot.pitch, 0.0, 1.1) * foot.toes;
    out.A_toes = foot.frame * RotationY(foot.pitch - bend);
    return out;
  }

  const LegInput& in_;
  Gait gait_;
  std::array<FootShape, 2> shapes_;
  std::array<Foot, 2> feet_;
  std::array<Vec3d, 2> hip_;
  Vec3d pelvis_;
};

}  // namespace

SolvedLegs SolveLegs(const LegInput& in) { return Solver(in).Solve(); }

Gait GaitOf(const Body& body, const MotionState& motion) {
  return GaitAt(std::hypot(motion.speed, motion.side_speed), LegLength(body), motion.gait, motion.run);
}

Vec3d HomePlace(const Body& body, size_t side) {
  const FootShape shape(body, side);
  return {shape.ball.x + body.p_PJ[At(kLegs[side].ankle)].x, (side == 0 ? 1 : -1) * body.size.hip_half_width + shape.ball.y, 0};
}

Vec3d LandingPlace(const Body& body, const Gait& gait, size_t side) {
  const LegAngles contact = LegCurves(gait, 0);
  const FootShape shape(body, side);
  const double x = body.p_PJ[At(kLegs[side].hip)].x + Forward(body.size, contact).x;
  // From the ankle to the ball of a foot that is turned out.
  const Vec3d ball = RotationZ(ToeOut(side)) * -shape.AnkleAt(std::min(0.0, contact.pitch));
  return {x + ball.x, AnkleSide(body, gait, side) + ball.y, 0};
}

Vec3d AnkleOverBall(const Body& body, size_t side, double pitch) { return FootShape(body, side).AnkleAt(pitch); }

double ToeOut(size_t side) { return (side == 0 ? 1 : -1) * 5 * kDegree; }

}  // namespace airsim360::internal

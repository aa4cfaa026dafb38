// From motion state to joints.
#include <cmath>

#include "airsim360/people/body/anatomy.h"
#include "airsim360/people/motion/blend.h"
#include "airsim360/people/motion/legs.h"

namespace airsim360 {
namespace internal {

PostureInput InputOf(const Body& body, const MotionState& motion, const PersonState& state) {
  const double t = static_cast<double>(motion.t_ns) * 1e-9;
  return {body,
          motion,
          state,
          motion.lower,
          motion.upper,
          motion.phase,
          t,
          t - static_cast<double>(motion.lower_since_ns) * 1e-9,
          t - static_cast<double>(motion.upper_since_ns) * 1e-9};
}

LegInput LegInputOf(const Body& body, const MotionState& motion, const PersonState& state, const Posture& posture, Vec3d shift) {
  const RigidTransform X_WP{RotationZ(state.yaw), state.p_WP};
  const Vec3d rest = body.p_PJ[At(Joint::kPelvis)];
  return {body, motion, state, X_WP, X_WP.R * posture.turn[kTPelvis], X_WP * (rest + posture.pelvis), posture.sink, shift};
}

}  // namespace internal

SkeletonPose PoseOf(const Body& body, const MotionState& motion, const PersonState& state) {
  using namespace internal;
  Posture posture = PostureOf(InputOf(body, motion, state));
  const Vec3d shift = AddOffsets(motion, posture);
  const LegInput in = LegInputOf(body, motion, state, posture, shift);
  const SolvedLegs legs = SolveLegs(in);

  SkeletonPose pose;
  pose.X_WP = in.X_WP;
  pose.props = posture.props;
  // `zero` turns of each joint in W; joints follow their parents.
  std::array<Mat3d, kJointCount> zero;
  const auto place = [&](Joint joint, const Mat3d& A) {
    const size_t j = At(joint), parent = At(ParentOf(joint));
    zero[j] = A;
    pose.X_WJ[j].R = A * body.R_zero[j];
    pose.X_WJ[j].p = pose.X_WJ[parent].p + pose.X_WJ[parent].R * (body.p_PJ[j] - body.p_PJ[parent]);
  };
  zero[0] = in.A_WPelvis;
  pose.X_WJ[0] = {in.A_WPelvis, legs.p_W_pelvis};
  for (size_t k = 1; k < kTurned.size(); ++k) place(kTurned[k], zero[At(ParentOf(kTurned[k]))] * posture.turn[k]);

  // Legs as solved.
  constexpr Joint kLegs[2][4] = {{Joint::kLeftHip, Joint::kLeftKnee, Joint::kLeftAnkle, Joint::kLeftToes},
                                 {Joint::kRightHip, Joint::kRightKnee, Joint::kRightAnkle, Joint::kRightToes}};
  for (size_t side = 0; side < 2; ++side) {
    const SolvedLeg& leg = legs.leg[side];
    place(kLegs[side][0], leg.A_thigh);
    place(kLegs[side][1], leg.A_shank);
    place(kLegs[side][2], leg.A_foot);
    place(kLegs[side][3], leg.A_toes);
  }

  // Fingers curl towards the palm, which faces the thigh at zero.
  constexpr Joint kHands[2][5] = {
      {Joint::kLeftWrist, Joint::kLeftFingers1, Joint::kLeftFingers2, Joint::kLeftThumb1, Joint::kLeftThumb2},
      {Joint::kRightWrist, Joint::kRightFingers1, Joint::kRightFingers2, Joint::kRightThumb1, Joint::kRightThumb2}};
  for (size_t side = 0; side < 2; ++side) {
    const double sign = side == 0 ? -1 : 1, curl = posture.curl[side];
    const Mat3d finger = RotationX(sign * 1.25 * curl), thumb = RotationX(sign * 0.35 * curl);
    place(kHands[side][1], zero[At(kHands[side][0])] * finger);
    place(kHands[side][2], zero[At(kHands[side][1])] * finger);
    place(kHands[side][3], zero[At(kHands[side][0])] * thumb);
    place(kHands[side][4], zero[At(kHands[side][3])] * thumb);
  }
  return pose;
}

}  // namespace airsim360

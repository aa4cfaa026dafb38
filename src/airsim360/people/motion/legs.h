// Legs: pelvis height, feet on the ground, two-bone inverse kinematics.
#pragma once

#include <cmath>

#include "airsim360/people/motion/gait_curves.h"
#include "airsim360/people/motion/posture.h"

namespace airsim360::internal {

/// A person's frame and gait at one instant.
struct LegInput {
  const Body& body;
  const MotionState& motion;
  const PersonState& state;
  RigidTransform X_WP;
  Mat3d A_WPelvis;   ///< pelvis against its rest, in W
  Vec3d p_W_pelvis;  ///< where x and y are meant, z is to be found
  double sink = 0;   ///< Posture::sink; then p_W_pelvis.z counts
  Vec3d shift;       ///< added to the pelvis once its height is found
};

/// What came out for one leg; rotations are from the anatomical zero (thigh, shank) and from rest (foot).
struct SolvedLeg {
  Vec3d hip, knee, ankle;
  Mat3d A_thigh, A_shank, A_foot, A_toes;
  double pitch = 0;
  double toes = 0;  ///< 1: the toes stay on the ground, 0: in line with the foot
};

struct SolvedLegs {
  Vec3d p_W_pelvis;
  std::array<SolvedLeg, 2> leg;  ///< left, right
};

SolvedLegs SolveLegs(const LegInput& in);

/// Phase of one leg.
inline double PhaseOf(const MotionState& motion, size_t side) {
  const double p = motion.phase + (side == 0 ? 0.0 : 0.5);
  return p - std::floor(p);
}

/// Leg length from hip to ankle, and to the sole.
inline double LegLength(const Body& body) { return body.size.thigh + body.size.shank + body.size.ankle_height; }

Gait GaitOf(const Body& body, const MotionState& motion);

/// Where the ball of a foot lands at phase 0, in P, on the ground.
Vec3d LandingPlace(const Body& body, const Gait& gait, size_t side);
/// Where the ball of a foot is when standing, in P.
Vec3d HomePlace(const Body& body, size_t side);
/// Ankle against the ground under the ball of the flat foot, in the frame of a foot at this pitch.
Vec3d AnkleOverBall(const Body& body, size_t side, double pitch);
/// How far feet are turned out, radians, to the left.
double ToeOut(size_t side);

}  // namespace airsim360::internal

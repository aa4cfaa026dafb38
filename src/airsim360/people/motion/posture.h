// What a person holds their pelvis, trunk, head and arms like, before the legs are solved.
#pragma once

#include <array>

#include "airsim360/people/body/body.h"
#include "airsim360/people/motion/pose.h"

namespace airsim360::internal {

/// Joints that transitions blend, in the order of Posture::turn.
inline constexpr std::array<Joint, kBlendedJoints> kTurned{
    Joint::kPelvis,        Joint::kSpine1,        Joint::kSpine2,       Joint::kSpine3,    Joint::kNeck,
    Joint::kHead,          Joint::kLeftClavicle,  Joint::kLeftShoulder, Joint::kLeftElbow, Joint::kLeftWrist,
    Joint::kRightClavicle, Joint::kRightShoulder, Joint::kRightElbow,   Joint::kRightWrist};
enum Turned : size_t { kTPelvis, kTSpine1, kTSpine2, kTSpine3, kTNeck, kTHead, kTLeftArm, kTRightArm = kTLeftArm + 4 };
// Within an arm.
inline constexpr size_t kClavicle = 0, kShoulder = 1, kElbow = 2, kWrist = 3;

// Of those who sit: the pelvis joint above a bench, and above a seat that was
// measured, as shares of the stature; degrees that they lean forward at a desk.
inline constexpr double kPelvisOverSeat = 0.055, kPelvisOverMeasured = 0.075, kLeanAtDesk = 8;

/// Rotations against the parent, from the anatomical zero (arms hang, palms in); axes as in P.
struct Posture {
  std::array<Mat3d, kBlendedJoints> turn;
  Vec3d pelvis;                   ///< of the pelvis joint against its place when standing, in P, metres
  double sink = 0;                ///< 0: height follows from the legs; 1: from pelvis.z alone (sitting, crouching)
  double curl[2] = {0.25, 0.25};  ///< of the fingers, 0 straight, 1 fist
  uint32_t props = 0;
};

/// Everything the posture depends on.
struct PostureInput {
  const Body& body;
  const MotionState& motion;
  const PersonState& state;
  Behaviour lower, upper;
  double phase, t;          ///< of the left leg; seconds
  double t_lower, t_upper;  ///< seconds since the behaviour began
};

Posture PostureOf(const PostureInput& in);

/// Trunk, head and arms of the lower behaviour, as PostureOf does before the upper layer; then the gesture.
void SetTrunk(const PostureInput& in, Posture& posture);
void SetArms(const PostureInput& in, Posture& posture);

/// Rotation R that a rotation vector stands for, and back (the shorter way).
Mat3d FromRotationVector(Vec3d v);
Vec3d ToRotationVector(const Mat3d& R);

/// Noise of a person: smooth in t, in [-1, 1], with about `rate` turns per second; `channel` tells streams apart.
double Sway(uint64_t seed, int channel, double rate, double t);
/// A number in [0, 1) for event `index` of a stream.
double Draw(uint64_t seed, int channel, int64_t index);

double SmoothStep(double edge0, double edge1, double x);

/// Arm of one side whose wrist is to reach `target` (frame of the shoulders' parent, spine3, relative to the
/// shoulder joint at rest there), the elbow towards `pole`. Fills shoulder and elbow; keeps clavicle.
void ReachWith(bool left, const Body& body, Vec3d target, Vec3d pole, Posture& posture);

}  // namespace airsim360::internal

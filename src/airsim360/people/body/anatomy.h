// Proportions of the procedural body, and what every body derives from its joints at rest.
#pragma once

#include "airsim360/people/body/body.h"

namespace airsim360::internal {

/// Index of a joint in arrays.
constexpr size_t At(Joint joint) { return static_cast<size_t>(joint); }
/// The same joint of the other side: left and right joints are declared in the same order.
Joint MirrorOf(Joint joint);

/// Shares of stature that change with age: children have larger heads and shorter legs.
struct Proportions {
  double stature = 1.75;
  double head = 0.130;      ///< chin to top, share of stature
  double hip = 0.530;       ///< height of the hip joint
  double shoulder = 0.818;  ///< height of the shoulder joint
  double shoulder_half = 0.113, hip_half = 0.052;
  double girth = 1;  ///< factor on breadths
  double belly = 0;  ///< 0 flat, 1 stout
  bool female = false;
  double adult = 1;  ///< 0 at 5 years, 1 from 16
};

/// Segment lengths of Drillis and Contini (in Winter, Biomechanics and Motor Control of Human Movement).
Proportions ProportionsOf(const BodySpec& spec);

/// Joints at rest.
std::array<Vec3d, kJointCount> RestJoints(const Proportions& p);

/// Fills R_zero and size (all but `radius`) from p_PJ.
void FinishSkeleton(Body& body);

/// The sockets of a procedural body of these proportions, in the order of kSocketNames.
std::vector<Socket> ProceduralSockets(const Body& body, const Proportions& p);

/// The smallest rotation that turns direction a into b.
Mat3d RotationBetween(Vec3d a, Vec3d b);

}  // namespace airsim360::internal

// Who sits on the bicycles of traffic.
#pragma once

#include <memory>

#include "airsim360/people/body/body.h"
#include "airsim360/sim/traffic/traffic.h"
#include "airsim360/worlds/props/bicycle.h"

namespace airsim360::internal {

/// Where a bicycle holds its rider: places in B, whose origin is on the ground below the middle of it. Metres.
struct Perch {
  Vec3d saddle, bracket;  ///< where one sits; axle of the cranks
  Vec3d grip;             ///< the left one
  double crank = 0;       ///< from the bracket to the axle of a pedal
  double pedal_side = 0;  ///< of the middle of a pedal
  double pedal_half_height = 0;
};
/// Of a mesh whose box has its middle at `offset_M`.
Perch PerchOf(const BicycleMeasures& measures, Vec3f offset_M, float scale);

/// The axle of a pedal, in B.
Vec3d PedalAt(const Perch& perch, bool left, double crank);
/// How far the toes on a pedal point down, radians: most as it comes up behind, least as it goes down in front.
double FootPitch(bool left, double crank);
/// How far a rider has a foot on the ground: 0 while riding, 1 at rest. Below a walking pace the left foot leaves its pedal.
double StandingAt(double speed);
/// How far a bicycle leans to the left while its rider stands, radians.
double LeanOf(double standing);

/// Someone on a bicycle at a crank angle (Cycling): on the saddle, hands at the grips, the balls of both feet on the pedals. At
/// `standing` 1 before the saddle, the left foot on the ground. In B as it leans.
SkeletonPose RidingPose(const Body& body, const Perch& perch, double crank, double standing = 0);

/// The scene with a rider, an entity of its own (human/rider), for each bicycle, after everything that it has; notes them in the
/// traffic. In place where `scene` is the only reference.
std::shared_ptr<Scene> AddRiders(std::shared_ptr<Scene> scene, SimTraffic& traffic);

}  // namespace airsim360::internal

// What guidance makes of a command for the controllers: one level of control and its values.
#pragma once

#include "airsim360/flight/control/mixer.h"
#include "airsim360/flight/control/reference.h"

namespace airsim360 {

enum class GoalLevel { kOff, kIdle, kSpeeds, kRates, kAttitude, kVelocity, kPosition, kTrajectory };

/// Only the fields of the level hold values.
struct Goal {
  GoalLevel level = GoalLevel::kOff;
  RotorValues speeds{};         ///< kSpeeds, rad/s
  Vec3d w_B;                    ///< kRates
  double roll = 0, pitch = 0;   ///< kAttitude
  bool throttle_given = false;  ///< kRates, kAttitude: `throttle`, not the reference's height
  double throttle = 0;          ///< share of the full thrust
  Vec3d v_W;                    ///< kVelocity
  bool hold_z = false;          ///< kVelocity: p_W.z is kept, v_W.z counts for nothing
  Vec3d p_W;                    ///< kPosition
  double speed = 0, climb = 0;  ///< kPosition: largest, m/s
  bool yaw_by_rate = false;
  double yaw = 0, yaw_rate = 0;  ///< by angle or by rate
  ReferencePoint reference;      ///< where the drone shall be now, smooth
};

}  // namespace airsim360

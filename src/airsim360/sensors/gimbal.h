// Gimbal: a mount with three joints that keeps chosen axes steady and follows commands at a limited rate.
#pragma once

#include "airsim360/base/config.h"
#include "airsim360/math/transform.h"

namespace airsim360 {

/// Angles of G as in BodyPose, radians.
struct GimbalAngles {
  double yaw = 0, pitch = 0, roll = 0;
};

struct GimbalSpec {
  Vec3d p_BG = {};  ///< metres, where the axes meet
  bool stabilise_yaw = false, stabilise_pitch = true, stabilise_roll = true;
  double max_rate_deg = 180;                        ///< degrees/s of each joint
  double yaw_limit_deg = 180;                       ///< either way from straight ahead
  double pitch_low_deg = -90, pitch_high_deg = 60;  ///< joint range
  double roll_limit_deg = 60;                       ///< either way

  void Visit(ConfigVisitor& v);
};

struct GimbalState {
  GimbalAngles joints;   ///< of G against B
  GimbalAngles command;  ///< of a stabilised axis: its angle in W; of another: against the body's own
};

/// Yaw, pitch and roll of a rotation as BodyPose takes them; roll 0 where the forward axis is vertical.
GimbalAngles AnglesOf(const Mat3d& R);

/// Where the joints would have to be for `command` if they were unlimited and at once.
GimbalAngles WantedJoints(const GimbalSpec& spec, const GimbalAngles& command, const Mat3d& R_WB);

/// Joints at the wanted place, within their limits.
GimbalState StartGimbal(const GimbalSpec& spec, const GimbalAngles& command, const Mat3d& R_WB);
/// Turns the joints towards the wanted place for dt seconds.
void StepGimbal(const GimbalSpec& spec, const Mat3d& R_WB, double dt, GimbalState& state);

RigidTransform GimbalPose(const GimbalSpec& spec, const GimbalState& state);  ///< X_BG

/// A gimbal and what it is told. One that has come to rest is a function of the body's attitude alone.
struct GimbalMount {
  GimbalSpec spec;
  GimbalAngles command;

  RigidTransform AtRest(const Mat3d& R_WB) const;  ///< X_BG
};

}  // namespace airsim360

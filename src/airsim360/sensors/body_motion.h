// What sensors are told of the vehicle that carries them.
#pragma once

#include "airsim360/base/config.h"
#include "airsim360/math/transform.h"
#include "airsim360/sensors/rig.h"

namespace airsim360 {

/// The exact motion of a body at one instant.
struct BodyMotion {
  Kinematics body;
  Vec3d a_WB;        ///< acceleration of B in W, m/s^2 (of the vehicle: without gravity's share taken off)
  Vec3d alpha_WB_B;  ///< angular acceleration in B, rad/s^2
};

/// Where a sensor sits: S has +X forward, +Y left, +Z up, as B.
struct Mount {
  Vec3d p_BS = {};                                  ///< metres
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;  ///< as every pose: pitch positive nose up

  /// X_BS, or the pose of S in the frame of the gimbal that carries it.
  RigidTransform pose() const;
  void Visit(ConfigVisitor& v);
};

}  // namespace airsim360

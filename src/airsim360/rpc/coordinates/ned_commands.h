// AirSim's low-level commands (its SimpleFlight goals) as commands of our autopilot. Arguments are NED, FRD,
// relative to the vehicle's own origin; angles in radians unless YawMode says degrees.
#pragma once

#include "airsim360/flight/control/command.h"
#include "airsim360/rpc/coordinates/ned.h"

namespace airsim360 {

/// What holds the height: a throttle, 0 to 1, or z of N (metres, down).
struct NedVertical {
  bool is_throttle = true;
  double value = 0;
};

YawTarget YawOf(const airsim::YawMode& mode);
Command NedVelocity(Vec3d v_N, const airsim::YawMode& yaw);
Command NedVelocityZ(double vx, double vy, double z, const airsim::YawMode& yaw, Vec3d origin_W);
Command NedPosition(Vec3d p_N, const airsim::YawMode& yaw, Vec3d origin_W);
/// `yaw` is an angle of N, or a rate.
Command FrdAttitude(double roll, double pitch, double yaw, bool yaw_is_rate, NedVertical vertical, Vec3d origin_W);
Command FrdRates(Vec3d rates_F, NedVertical vertical, Vec3d origin_W);
/// Signals 0 to 1 in AirSim's order: front right, rear left, front left, rear right.
Command MotorSignals(const std::array<double, 4>& signals);

}  // namespace airsim360

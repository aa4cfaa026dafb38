// Trajectories as text: CSV, JSON, the ROS message PolynomialTrajectory as YAML, MAVLink setpoints.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/planning/certificate.h"
#include "airsim360/planning/splines/polynomial_trajectory.h"
#include "airsim360/planning/splines/trajectory_limits.h"
#include "airsim360/planning/yaw_profile.h"

namespace airsim360 {

/// What a planned trajectory is written with.
struct PlanRecord {
  const PolynomialTrajectory& trajectory;
  TrajectoryPeaks peaks;
  double cost_snap = 0;         ///< integral of squared snap, m^2 / s^7
  double lower_bound = 0;       ///< seconds; 0 = not known (times were given)
  double start_time = 0;        ///< seconds, of the first waypoint
  YawRule yaw = ConstantYaw{};  ///< heading all along
  double radius = 0;            ///< metres, of the certificate
  std::optional<Certificate> certificate = std::nullopt;
  std::vector<Vec3d> waypoints = {};  ///< as given; empty = the joints of the trajectory
};

/// `t_s,px,py,pz,vx,vy,vz,ax,ay,az`: samples every `interval` seconds and at the end. Metres, seconds, W. A
/// heading that changes adds the column `yaw` (radians).
std::string TrajectorySamplesCsv(const PlanRecord& plan, double interval);

/// The object that docs/reference/contracts.md describes: order, times, coefficients[segment][axis][power], cost_snap,
/// max_speed, max_acceleration, and more. `yaw` is a number (radians), or for a heading that changes
/// yaw_coefficients[segment][power], an interpolation of degree 7.
std::string TrajectoryJson(const PlanRecord& plan);

/// mav_planning_msgs/PolynomialTrajectory: a list of segments with num_coeffs, segment_time, x, y, z, yaw in
/// increasing powers.
std::string PolynomialTrajectoryYaml(const PlanRecord& plan);

/// Fields of MAVLink SET_POSITION_TARGET_LOCAL_NED (84), a row every `interval` seconds and at the end:
/// local NED (north, east, down from the origin of W), nothing ignored (type_mask 0), yaw from north
/// clockwise, with its rate.
std::string MavlinkSetpointsCsv(const PlanRecord& plan, double interval);

}  // namespace airsim360

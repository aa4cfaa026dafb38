// QGroundControl mission plans: take-off, waypoints along the flight, landing, on the WGS84 ellipsoid.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "airsim360/math/geodesy.h"
#include "airsim360/planning/yaw_profile.h"

namespace airsim360 {

/// Waypoints every `spacing` metres or less along the flight (at equal times within a segment). Altitudes are
/// relative to the origin (frame 3).
struct QgcOptions {
  GeoPoint origin;
  double spacing = 5;
  double speed = 5;                 ///< m/s, of the command that sets it
  std::optional<YawRule> yaw = {};  ///< heading at the waypoints; none: the vehicle's own choice
};
std::string QgcPlan(const PolynomialTrajectory& trajectory, const QgcOptions& options);

}  // namespace airsim360

// QGroundControl mission plans: take-off, waypoints along the flight, landing, on the WGS84 ellipsoid.
#pragma once

#include <string>
#include <vector>

#include "airsim360/math/vector.h"
#include "airsim360/planning/polynomial_trajectory.h"

namespace airsim360 {

/// Degrees, and metres above the ellipsoid.
struct GeoPoint {
  double latitude_deg = 0, longitude_deg = 0, altitude = 0;
};

/// East, north and up from `origin` to the ellipsoid and back, exact but for rounding (WGS84, earth-centred
/// coordinates between).
GeoPoint ToGeo(Vec3d p_W, const GeoPoint& origin);
Vec3d FromGeo(const GeoPoint& point, const GeoPoint& origin);

/// Waypoints every `spacing` metres or less along the flight (at equal times within a segment). Altitudes are
/// relative to the origin (frame 3).
struct QgcOptions {
  GeoPoint origin;
  double spacing = 5;
  double speed = 5;  ///< m/s, of the command that sets it
};
std::string QgcPlan(const PolynomialTrajectory& trajectory, const QgcOptions& options);

}  // namespace airsim360

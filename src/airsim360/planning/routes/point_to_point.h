// Smooth flights that are proved free of collisions: through a polyline, or from one place to another.
#pragma once

#include <vector>

#include "airsim360/planning/certificate.h"
#include "airsim360/planning/clearance.h"
#include "airsim360/planning/routes/search.h"
#include "airsim360/planning/splines/time_allocation.h"

namespace airsim360 {

struct FlightOptions {
  TrajectoryLimits limits;  ///< speed and acceleration must be finite
  AllocationOptions allocation;
  double radius = 0.5;  ///< metres to keep from every surface
  int rounds = 40;      ///< of adding waypoints where the path is not proved free
};

struct CertifiedFlight {
  AllocatedTrajectory flight;
  std::vector<Vec3d> waypoints;  ///< those given and those added
  Certificate certificate;       ///< of the whole flight
  size_t added = 0;              ///< waypoints
};

/// A flight through `waypoints` whose legs are clear. Where it is not proved free the leg gets another
/// waypoint in its middle and the whole is solved again: it tends to the legs. `certificate` tells whether
/// that has succeeded.
CertifiedFlight FlyThrough(std::vector<Vec3d> waypoints, const ClearanceQuery& world, const FlightOptions& options);

/// A free flight that passes all `waypoints` in turn, going around what is between them. InputError with the
/// reason if there is none: a waypoint too close to a surface, enclosed, or no way at this radius.
CertifiedFlight FlyFree(const std::vector<Vec3d>& waypoints, const BoundedClearance& world, const FlightOptions& options);

}  // namespace airsim360

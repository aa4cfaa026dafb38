// How long to take from each waypoint to the next: least total time under limits on speed and acceleration.
#pragma once

#include <span>
#include <vector>

#include "airsim360/planning/splines/minimum_snap.h"
#include "airsim360/planning/splines/trajectory_limits.h"

namespace airsim360 {

struct AllocationOptions {
  SplineKind kind = SplineKind::kMinimumSnap;
  bool optimise = true;        ///< false: trapezoidal profiles along the chords, scaled to the limits
  double sample_interval = 0;  ///< > 0: the whole flight takes a multiple of it
  /// Two waypoints: further ones on the straight line between them as long as they save time. One polynomial
  /// cannot hold a speed. The trajectory then has more segments than the waypoints given.
  bool split = false;
};

struct AllocatedTrajectory {
  PolynomialTrajectory trajectory;  ///< respects the limits
  TrajectoryPeaks peaks;
  double lower_bound;  ///< seconds that no path from the first to the last waypoint, at rest there, can beat
  int evaluations;     ///< of the objective with its gradient
};

/// Time of a straight flight from rest to rest over `distance`: no path is faster under these limits.
double RestToRestTime(double distance, double max_speed, double max_acceleration);

/// Durations for which the optimal spline through the waypoints, at rest at both ends, is as short in time as
/// could be found, exactly within the limits. Speed and acceleration limits must be finite; the other limits
/// hold by uniform slowing. InputError for fewer than two waypoints, neighbouring ones that coincide, limits
/// that are not positive or would make the flight take more than 1e9 s.
AllocatedTrajectory AllocateTimes(std::span<const Vec3d> waypoints, const TrajectoryLimits& limits, const AllocationOptions& options = {});

}  // namespace airsim360

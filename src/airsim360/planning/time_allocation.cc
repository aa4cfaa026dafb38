#include "airsim360/planning/time_allocation.h"

#include <cmath>
#include <string>

#include "airsim360/base/error.h"

namespace airsim360 {

double RestToRestTime(double distance, double max_speed, double max_acceleration) {
  const double ramp = max_speed * max_speed / max_acceleration;
  return distance >= ramp ? distance / max_speed + max_speed / max_acceleration
                          : 2 * std::sqrt(distance / max_acceleration);
}

AllocatedTrajectory AllocateTimes(std::span<const Vec3d> waypoints, const TrajectoryLimits& limits,
                                  const AllocationOptions& options) {
  CheckLimits(limits);
  std::vector<double> durations;
  double length = 0;
  for (size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const double chord = Norm(waypoints[i + 1] - waypoints[i]);
    if (!(chord > 0)) {
      throw InputError("time allocation: waypoints " + std::to_string(i) + " and " + std::to_string(i + 1) +
                       " coincide");
    }
    length += chord;
    durations.push_back(RestToRestTime(chord, limits.speed, limits.acceleration));
  }
  PolynomialTrajectory trajectory = ScaleToLimits(
      SolveMinimumSnap({.waypoints = waypoints, .durations = durations, .kind = options.kind}), limits);
  const TrajectoryPeaks peaks = CertifiedPeaks(trajectory);
  return {std::move(trajectory), peaks, RestToRestTime(length, limits.speed, limits.acceleration), 1};
}

}  // namespace airsim360

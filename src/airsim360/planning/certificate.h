// Continuous collision certificates: proofs that a ball of some radius touches nothing on its whole way, not
// only at samples. Conservative advancement: where the centre has clearance d, the ball is free as long as
// the centre moves less than d - radius; certified maxima of speed and acceleration say how long that is.
#pragma once

#include <limits>

#include "airsim360/planning/clearance.h"
#include "airsim360/planning/splines/polynomial_trajectory.h"
#include "airsim360/planning/splines/trajectory_limits.h"

namespace airsim360 {

/// Metres of clearance beyond the radius that a proof needs everywhere, so that it ends.
inline constexpr double kCertificateSlack = 1e-3;

struct Certificate {
  bool certified = false;
  double violation_time = 0;   ///< seconds; first time that could not be proved free, if not certified
  double least_clearance = 0;  ///< metres: if certified, the clearance is never less on the way, and this is
                               ///< at least radius; else the clearance at violation_time is at least this
  int queries = 0;
};

/// Times of a path, seconds.
struct TimeSpan {
  double from = 0, to = std::numeric_limits<double>::infinity();
};

/// Proves that the clearance is at least `radius` at every time of the path within `span`. `peaks` must be
/// certified for this very path (CertifiedPeaks).
Certificate Certify(const PolynomialTrajectory& trajectory, const TrajectoryPeaks& peaks, const ClearanceQuery& world, double radius,
                    TimeSpan span = {});

/// Metres that the clearance is proved never to fall below on the way, whether a radius is kept or not; 0
/// where it touches something. As near to the least clearance as `queries` allow, never above it. `peaks` as
/// of Certify.
double LeastClearanceBound(const PolynomialTrajectory& trajectory, const TrajectoryPeaks& peaks, const ClearanceQuery& world,
                           int queries = 4096);

/// True if the clearance is proved to be at least `radius` everywhere on the straight segment from a to b.
bool SegmentIsClear(Vec3d a, Vec3d b, const ClearanceQuery& world, double radius);

}  // namespace airsim360

// How fast a path really is (certified maxima), and how much it must be slowed down to respect limits.
#pragma once

#include <limits>
#include <span>

#include "airsim360/planning/splines/minimum_snap.h"
#include "airsim360/planning/splines/polynomial_trajectory.h"

namespace airsim360 {

/// A maximum over time. `value` is an upper bound valid to rounding, at most 1e-10 (relative) above the true
/// maximum; the quantity at `time` is at most that far below it.
struct CertifiedPeak {
  double value = 0, time = 0;
};

struct TrajectoryPeaks {
  CertifiedPeak speed, acceleration;  ///< of the Euclidean norms, m/s and m/s^2
};

/// Largest speed and acceleration over the whole path.
TrajectoryPeaks CertifiedPeaks(const PolynomialTrajectory& trajectory);

/// Largest |d^n p / dt^n|, n = `derivative` (1 speed, 2 acceleration, 3 jerk).
CertifiedPeak PeakOfNorm(const PolynomialTrajectory& trajectory, int derivative);

/// Largest absolute value of one component (axis 0 = x) of the n-th derivative.
CertifiedPeak PeakOfAxis(const PolynomialTrajectory& trajectory, int derivative, int axis);

/// Largest value of direction . d^n p / dt^n, which may be negative; e.g. direction +z, n = 1: climb rate.
CertifiedPeak PeakAlong(const PolynomialTrajectory& trajectory, int derivative, Vec3d direction);

/// Largest thrust per mass of a drone on the path, |a + g e_z|, m/s^2.
CertifiedPeak PeakThrust(const PolynomialTrajectory& trajectory);

/// Largest roll and pitch rate of a drone on the path by flatness, |jerk x (a + g e_z)| / |a + g e_z|^2,
/// rad/s; at most 1e-6 above the true maximum. Infinite if the path contains a moment of free fall.
CertifiedPeak PeakBodyRate(const PolynomialTrajectory& trajectory);

/// Limits of a flight; infinity = none. All positive.
struct TrajectoryLimits {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double speed = kNone, acceleration = kNone;       ///< Euclidean norms, m/s, m/s^2
  Vec3d axis_speed = {kNone, kNone, kNone};         ///< |component|, m/s
  Vec3d axis_acceleration = {kNone, kNone, kNone};  ///< |component|, m/s^2
  double climb = kNone, descent = kNone;            ///< vertical speed up and down, m/s
  double thrust_per_mass = kNone;                   ///< of a drone: |a + g e_z|, m/s^2; must exceed 9.81
  double body_rate = kNone;                         ///< of a drone: roll and pitch rate |w_xy|, rad/s
};

/// Throws InputError naming the limit unless every limit is positive (and thrust exceeds gravity).
void CheckLimits(const TrajectoryLimits& limits);

/// True if the certified maxima respect every limit.
bool WithinLimits(const PolynomialTrajectory& trajectory, const TrajectoryLimits& limits);

/// The path slowed down (or sped up) uniformly in time so that it respects the limits and touches one of them
/// to 1e-9. For paths whose prescribed end derivatives are zero, where this keeps the optimum.
PolynomialTrajectory ScaleToLimits(const PolynomialTrajectory& trajectory, const TrajectoryLimits& limits);

/// For prescribed end derivatives that are not zero: the least multiple of the durations, to 1e-6, for which
/// the re-solved optimum respects the limits. InputError if the ends themselves break a limit or no multiple
/// from 1/1024 to 1024 will do.
PolynomialTrajectory SolveWithinLimits(const MinimumSnapProblem& problem, const TrajectoryLimits& limits);

}  // namespace airsim360

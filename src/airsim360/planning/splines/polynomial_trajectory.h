// A piecewise polynomial path in time: what minimum snap gives and everything downstream samples.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// Position in W (metres) and its derivatives at one time.
struct TrajectoryPoint {
  Vec3d p, v, a, jerk, snap;
};

/// Immutable. Degree 5 or 7, the same for all segments.
class PolynomialTrajectory {
 public:
  /// `coefficients` ascending powers of the segment's local time in seconds: [segment][axis][power], degree +
  /// 1 powers. InputError unless sizes agree, durations are positive and every number is finite.
  PolynomialTrajectory(int degree, std::vector<double> durations, std::vector<double> coefficients);

  int degree() const { return degree_; }
  size_t segments() const { return durations_.size(); }
  std::span<const double> durations() const { return durations_; }
  /// Seconds of the whole path.
  double duration() const { return starts_.back(); }
  /// Ascending powers of local time of one segment and axis (0 = x).
  std::span<const double> coefficients(size_t segment, int axis) const;
  std::span<const double> coefficients() const { return coefficients_; }
  /// Time at which a segment begins.
  double start(size_t segment) const { return starts_[segment]; }
  /// State at time t, clamped to [0, duration()].
  TrajectoryPoint At(double t) const;

 private:
  int degree_;
  std::vector<double> durations_, coefficients_, starts_;  // starts_: one more than durations_
};

/// Integral over the whole path of the squared `derivative`-th derivative, all axes together, exact but for
/// rounding: 4 gives the cost of minimum snap (m^2 / s^7). `derivative` from 0 to the degree.
double IntegralOfSquaredDerivative(const PolynomialTrajectory& trajectory, int derivative);

/// The same path `factor` > 0 times as long in time: velocity is divided by factor, acceleration by its
/// square. The optimum of the durations stays the optimum of the scaled ones when the end derivatives are
/// zero.
PolynomialTrajectory Slowed(const PolynomialTrajectory& trajectory, double factor);

/// Multiples of `interval` > 0 from 0 up to `duration`, and the duration itself when it is none of them.
std::vector<double> SampleTimes(double duration, double interval);

}  // namespace airsim360

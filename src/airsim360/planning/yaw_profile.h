// Where a vehicle looks while it flies a path.
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "airsim360/planning/splines/polynomial_trajectory.h"

namespace airsim360 {

/// Always the same heading, radians, anticlockwise from east (+x of W).
struct ConstantYaw {
  double yaw = 0;
};

/// Along the horizontal velocity. Where it is below 1e-3 m/s (at rest, straight up) the heading is that of
/// the nearest moment on the path where it is not; 0 if there is none.
struct YawAlongVelocity {};

/// Towards a point in W. Right above or below it as for YawAlongVelocity.
struct YawTowards {
  Vec3d point;
};

/// Given at increasing times, linear between them the short way round, constant before and after.
struct GivenYaw {
  std::vector<double> times, yaws;
};

/// A polynomial for each segment of the path: ascending powers of the segment's local time, radians, as
/// YawProfile::Powers gives them.
struct YawPowers {
  std::vector<std::vector<double>> segments;
};

using YawRule = std::variant<ConstantYaw, YawAlongVelocity, YawTowards, GivenYaw, YawPowers>;

/// A rule bound to a path, which must outlive it.
class YawProfile {
 public:
  /// InputError for numbers that are not finite, for times that do not increase or agree in number, and for polynomials
  /// that are not one for each segment of the path.
  YawProfile(const PolynomialTrajectory& trajectory, YawRule rule);
  /// Radians in (-pi, pi] at time t, clamped to the path.
  double At(double t) const;

  /// Ascending powers (degree 7) of t - from over [from, from + duration], for formats that hold headings as
  /// polynomials: interpolates the heading, unwrapped, at Chebyshev-Lobatto points, so that neighbouring
  /// pieces meet. The turn is chosen so that the heading at `from` is within half a turn of `near`.
  std::array<double, 8> Powers(double from, double duration, double near) const;

  bool is_constant() const { return std::holds_alternative<ConstantYaw>(rule_); }

 private:
  const PolynomialTrajectory& trajectory_;
  YawRule rule_;
};

}  // namespace airsim360

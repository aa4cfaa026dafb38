// Planned polynomials and timed routes as references for the autopilot.
#pragma once

#include <memory>
#include <optional>

#include "airsim360/flight/control/reference.h"
#include "airsim360/planning/splines/polynomial_trajectory.h"
#include "airsim360/routes/route.h"

namespace airsim360 {

/// Position of a planned trajectory with all its derivatives. The heading is fixed, looks at a point, or looks along the way:
/// towards where the path is `kHeadingSpan` seconds later from where it was as long before, at most
/// `kFastestTurn` rad/s being asked for.
class PlannedReference : public ReferenceTrajectory {
 public:
  static constexpr double kHeadingSpan = 0.5;
  static constexpr double kFastestTurn = 3;

  /// `yaw`: fixed heading, radians; none: along the way, and `yaw_at_rest` where the path stands still.
  PlannedReference(std::shared_ptr<const PolynomialTrajectory> trajectory, std::optional<double> yaw, double yaw_at_rest = 0);
  /// Looks at `look_at`; along the way where it is right above or below.
  PlannedReference(std::shared_ptr<const PolynomialTrajectory> trajectory, Vec3d look_at);
  ReferencePoint At(double t) const override;
  double duration() const override { return trajectory_->duration(); }

  const PolynomialTrajectory& trajectory() const { return *trajectory_; }
  std::optional<double> yaw() const { return yaw_; }
  double yaw_at_rest() const { return yaw_at_rest_; }
  std::optional<Vec3d> look_at() const { return look_at_; }

 private:
  std::shared_ptr<const PolynomialTrajectory> trajectory_;
  std::optional<double> yaw_;
  double yaw_at_rest_ = 0;
  std::optional<Vec3d> look_at_;
};

/// The piecewise quintic that a route is, from its start.
PolynomialTrajectory PolynomialOf(const Route& route);

}  // namespace airsim360

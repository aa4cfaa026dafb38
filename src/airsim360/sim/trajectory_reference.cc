#include "airsim360/sim/trajectory_reference.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"

namespace airsim360 {

PlannedReference::PlannedReference(std::shared_ptr<const PolynomialTrajectory> trajectory, std::optional<double> yaw, double yaw_at_rest)
    : trajectory_(std::move(trajectory)), yaw_(yaw), yaw_at_rest_(yaw_at_rest) {}

PlannedReference::PlannedReference(std::shared_ptr<const PolynomialTrajectory> trajectory, Vec3d look_at)
    : trajectory_(std::move(trajectory)), look_at_(look_at) {}

ReferencePoint PlannedReference::At(double t) const {
  const TrajectoryPoint point = trajectory_->At(t);
  ReferencePoint reference{point.p, point.v, point.a, point.jerk, point.snap, yaw_.value_or(yaw_at_rest_), 0};
  if (yaw_) return reference;
  if (look_at_) {
    constexpr double kAbove = 0.3;  // metres beside the point: no direction
    const double x = look_at_->x - point.p.x, y = look_at_->y - point.p.y, d2 = x * x + y * y;
    if (d2 > kAbove * kAbove) {
      reference.yaw = std::atan2(y, x);
      reference.yaw_rate = std::clamp((y * point.v.x - x * point.v.y) / d2, -kFastestTurn, kFastestTurn);
      return reference;
    }
  }
  // Along the way; its turning follows from the velocities at both ends of the span.
  constexpr double kStill = 0.05;  // metres within the span: no direction
  const TrajectoryPoint before = trajectory_->At(t - kHeadingSpan), after = trajectory_->At(t + kHeadingSpan);
  const Vec3d way = after.p - before.p, change = after.v - before.v;
  const double length2 = way.x * way.x + way.y * way.y;
  if (length2 < kStill * kStill) return reference;
  reference.yaw = std::atan2(way.y, way.x);
  reference.yaw_rate = std::clamp((way.x * change.y - way.y * change.x) / length2, -kFastestTurn, kFastestTurn);
  return reference;
}

PolynomialTrajectory PolynomialOf(const Route& route) {
  if (route.nodes().size() < 2) throw InputError("route: a trajectory needs two points or more");
  std::vector<double> durations, coefficients;
  for (size_t i = 1; i < route.nodes().size(); ++i) {
    const RouteNode &a = route.nodes()[i - 1], &b = route.nodes()[i];
    const double T = b.t - a.t;
    durations.push_back(T);
    // Quintic Hermite with zero acceleration at both ends, in powers of local time.
    for (int axis = 0; axis < 3; ++axis) {
      const double d = b.p[axis] - a.p[axis] - a.v[axis] * T, e = (b.v[axis] - a.v[axis]) * T;
      const double c3 = (10 * d - 4 * e) / (T * T * T), c4 = (-15 * d + 7 * e) / (T * T * T * T),
                   c5 = (6 * d - 3 * e) / (T * T * T * T * T);
      for (const double c : {a.p[axis], a.v[axis], 0.0, c3, c4, c5}) coefficients.push_back(c);
    }
  }
  return {5, std::move(durations), std::move(coefficients)};
}

}  // namespace airsim360

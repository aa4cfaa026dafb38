// A timed path with heading: what a vehicle follows and what a survey or a route file gives.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "airsim360/math/vector.h"
#include "airsim360/planning/splines/polynomial_trajectory.h"
#include "airsim360/planning/yaw_profile.h"

namespace airsim360 {

/// A moment that the route passes exactly. Between nodes position is the quintic with the nodes' positions
/// and velocities and zero acceleration at both ends (twice differentiable everywhere); heading turns with a
/// smooth step.
struct RouteNode {
  double t = 0;    ///< seconds
  Vec3d p;         ///< of the body origin in W, metres
  Vec3d v;         ///< m/s
  double yaw = 0;  ///< radians, counter-clockwise from east; unwrapped by Route
};

/// State of the route at one time.
struct RoutePoint {
  Vec3d p, v, a;
  double yaw = 0, yaw_rate = 0;
};

/// Immutable; a pure function of its nodes.
class Route {
 public:
  /// At least one node, times strictly increasing from 0; InputError otherwise. Headings turn the shorter
  /// way.
  explicit Route(std::vector<RouteNode> nodes);
  /// A planned flight, its positions exactly; the heading is exactly that of `yaw`, or along the way from node to node
  /// where none is given.
  static Route Along(const PolynomialTrajectory& path, const std::optional<YawRule>& yaw);

  /// The planned flight; nullptr if the route is not one.
  const PolynomialTrajectory* path() const { return path_.get(); }
  const std::vector<RouteNode>& nodes() const { return nodes_; }
  /// Seconds from the first to the last node.
  double duration() const { return nodes_.back().t; }
  /// State at time t, clamped to [0, duration()]; at rest outside.
  RoutePoint At(double t) const;

 private:
  double YawRate(double t) const;  // of heading_

  std::vector<RouteNode> nodes_;
  std::shared_ptr<const PolynomialTrajectory> path_;
  std::shared_ptr<const YawProfile> heading_;  // of path_; null: that of the nodes
};

/// A place to pass, from a route file.
struct Waypoint {
  Vec3d p;
  double yaw = 0;  ///< radians, used if `has_yaw`
  double t = 0;    ///< seconds, used if `has_time`
  bool has_yaw = false, has_time = false;
  size_t line = 0;  ///< of its file, from 1; 0 = not from a file
};

/// Passes exactly through every waypoint, at rest at both ends, with the velocity of the central difference
/// between; without times at about `speed` m/s, without headings looking along the direction of travel.
Route RouteThrough(const std::vector<Waypoint>& waypoints, double speed);

struct FlightLimits {
  double speed = 6;         ///< m/s
  double acceleration = 4;  ///< m/s^2
  double corner = 1.5;      ///< metres before and after a corner that are rounded
};

/// Flies along the straight legs between `points`, slows down for the corners and rounds them; heading along
/// the legs. Never leaves the legs by more than 0.19 * corner * |change of direction|.
Route RoundedRoute(std::vector<Vec3d> points, const FlightLimits& limits);

}  // namespace airsim360

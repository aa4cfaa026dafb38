#include "airsim360/routes/route.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/coordinate_limit.h"

namespace airsim360 {
namespace {

// Derivatives 0, 1 and 2 of the quintic Hermite basis with zero acceleration at both ends, at s in [0, 1],
// for (p0, v0, v1, p1).
struct HermiteBasis {
  double p0, v0, v1, p1;
};

HermiteBasis Position(double s) {
  const double s3 = s * s * s, s4 = s3 * s, s5 = s4 * s;
  return {1 - 10 * s3 + 15 * s4 - 6 * s5, s - 6 * s3 + 8 * s4 - 3 * s5, -4 * s3 + 7 * s4 - 3 * s5, 10 * s3 - 15 * s4 + 6 * s5};
}

HermiteBasis Velocity(double s) {
  const double s2 = s * s, s3 = s2 * s, s4 = s3 * s;
  const double p = 30 * s2 - 60 * s3 + 30 * s4;
  return {-p, 1 - 18 * s2 + 32 * s3 - 15 * s4, -12 * s2 + 28 * s3 - 15 * s4, p};
}

HermiteBasis Acceleration(double s) {
  const double s2 = s * s, s3 = s2 * s;
  const double p = 60 * s - 180 * s2 + 120 * s3;
  return {-p, -36 * s + 96 * s2 - 60 * s3, -24 * s + 84 * s2 - 60 * s3, p};
}

Vec3d Blend(const HermiteBasis& h, const RouteNode& a, const RouteNode& b, double T) {
  return a.p * h.p0 + a.v * (T * h.v0) + b.v * (T * h.v1) + b.p * h.p1;
}

bool IsFinite(Vec3d v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

Route::Route(std::vector<RouteNode> nodes) : nodes_(std::move(nodes)) {
  if (nodes_.empty()) throw InputError("route: no points");
  for (size_t i = 0; i < nodes_.size(); ++i) {
    RouteNode& node = nodes_[i];
    const double previous = i ? nodes_[i - 1].t : 0;
    if (!std::isfinite(node.t) || (i ? node.t <= previous : node.t != 0) || !IsWithinLimit(node.p) || !IsFinite(node.v)) {
      throw InputError("route: point " + std::to_string(i) + " has no valid time or position");
    }
    if (i) node.yaw = nodes_[i - 1].yaw + std::remainder(node.yaw - nodes_[i - 1].yaw, 2 * kPi);
  }
}

Route Route::Along(const PolynomialTrajectory& planned, const std::optional<YawRule>& yaw) {
  // Close enough that the heading, a smooth step from node to node, follows the way.
  constexpr double kNodeInterval = 0.5;  // seconds
  const auto path_of_route = std::make_shared<const PolynomialTrajectory>(planned);
  const PolynomialTrajectory& path = *path_of_route;
  const auto given = yaw ? std::make_shared<const YawProfile>(path, *yaw) : nullptr;
  std::vector<RouteNode> nodes;
  double heading = 0;
  const int count = std::max(1, static_cast<int>(std::ceil(path.duration() / kNodeInterval)));
  for (int i = 0; i <= count; ++i) {
    const double t = path.duration() * i / count;
    const TrajectoryPoint point = path.At(t);
    // At rest the heading is that of the way just after or before.
    const Vec3d travel = path.At(t + 0.25 * kNodeInterval).p - path.At(t - 0.25 * kNodeInterval).p;
    if (given) {
      heading = given->At(t);
    } else if (std::hypot(travel.x, travel.y) > 1e-3) {
      heading = std::atan2(travel.y, travel.x);
    }
    nodes.push_back({.t = t, .p = point.p, .v = point.v, .yaw = heading});
  }
  Route route(std::move(nodes));
  route.path_ = path_of_route;
  route.heading_ = given;
  return route;
}

double Route::YawRate(double t) const {
  constexpr double kStep = 1e-4;  // seconds
  const double before = std::max(t - kStep, 0.0), after = std::min(t + kStep, duration());
  return std::remainder(heading_->At(after) - heading_->At(before), 2 * kPi) / (after - before);
}

RoutePoint Route::At(double t) const {
  if (t <= 0) return {nodes_.front().p, {}, {}, nodes_.front().yaw, 0};
  if (t >= duration()) return {nodes_.back().p, {}, {}, nodes_.back().yaw, 0};
  const auto next = std::upper_bound(nodes_.begin(), nodes_.end(), t, [](double value, const RouteNode& node) { return value < node.t; });
  const RouteNode& b = *next;
  const RouteNode& a = *(next - 1);
  const double T = b.t - a.t;
  const double s = (t - a.t) / T;
  const double turn = b.yaw - a.yaw;
  if (path_) {
    const TrajectoryPoint point = path_->At(t);
    if (heading_) return {point.p, point.v, point.a, heading_->At(t), YawRate(t)};
    return {point.p, point.v, point.a, a.yaw + turn * s * s * (3 - 2 * s), turn * 6 * s * (1 - s) / T};
  }
  return {Blend(Position(s), a, b, T), Blend(Velocity(s), a, b, T) / T, Blend(Acceleration(s), a, b, T) / (T * T),
          a.yaw + turn * s * s * (3 - 2 * s), turn * 6 * s * (1 - s) / T};
}

Route RouteThrough(const std::vector<Waypoint>& waypoints, double speed) {
  constexpr double kTicks = 50;         // a second: free times fall on steps of the simulation
  constexpr double kShortestLeg = 0.5;  // seconds, also for waypoints in the same place
  std::vector<RouteNode> nodes;
  double ticks = 0;
  for (size_t i = 0; i < waypoints.size(); ++i) {
    const Waypoint& w = waypoints[i];
    if (i > 0) ticks += std::ceil(kTicks * std::max(kShortestLeg, Norm(w.p - waypoints[i - 1].p) / speed));
    const double t = w.has_time ? w.t - waypoints[0].t : ticks / kTicks;
    nodes.push_back({.t = t, .p = w.p, .v = {}, .yaw = w.yaw});
  }
  // Velocity by central differences; heading along it where none is given.
  double heading = 0;
  for (size_t i = 0; i < nodes.size(); ++i) {
    const RouteNode& a = nodes[i == 0 ? 0 : i - 1];
    const RouteNode& b = nodes[std::min(i + 1, nodes.size() - 1)];
    const Vec3d travel = b.p - a.p;
    if (i > 0 && i + 1 < nodes.size()) nodes[i].v = travel / (b.t - a.t);
    if (std::hypot(travel.x, travel.y) > 1e-6) heading = std::atan2(travel.y, travel.x);
    if (!waypoints[i].has_yaw) nodes[i].yaw = heading;
  }
  return Route(std::move(nodes));
}

namespace {

// One straight leg of a rounded route.
struct Leg {
  Vec3d direction;
  double length;
};

// Speeds at the corners: slow enough to turn within the rounding and to brake and speed up along the legs.
std::vector<double> CornerSpeeds(const std::vector<Leg>& legs, const std::vector<double>& cut, const FlightLimits& limits) {
  // A smooth step of velocity over time T peaks at 1.5 |dv| / T; a corner lasts 2 cut / speed.
  std::vector<double> speeds(legs.size() + 1, 0);
  for (size_t i = 1; i < legs.size(); ++i) {
    const double change = Norm(legs[i].direction - legs[i - 1].direction);
    speeds[i] = std::min(limits.speed, std::sqrt(cut[i] * limits.acceleration / (0.75 * std::max(change, 1e-6))));
  }
  // A change of speed from u to v takes 0.75 |v^2 - u^2| / acceleration of way.
  const auto reachable = [&](double from, size_t leg) {
    const double way = legs[leg].length - cut[leg] - cut[leg + 1];
    return std::sqrt(from * from + way * limits.acceleration / 0.75);
  };
  speeds.front() = std::min(limits.speed, std::sqrt(cut.front() * limits.acceleration / 0.75));
  speeds.back() = std::min(limits.speed, std::sqrt(cut.back() * limits.acceleration / 0.75));
  for (size_t i = 0; i < legs.size(); ++i) speeds[i + 1] = std::min(speeds[i + 1], reachable(speeds[i], i));
  for (size_t i = legs.size(); i-- > 0;) speeds[i] = std::min(speeds[i], reachable(speeds[i + 1], i));
  return speeds;
}

std::vector<double> LegHeadings(const std::vector<Leg>& legs) {
  std::vector<double> headings(legs.size(), 0);
  double heading = 0;
  for (size_t i = legs.size(); i-- > 0;) {  // vertical legs look where the next leg goes
    const Vec3d d = legs[i].direction;
    if (std::hypot(d.x, d.y) > 1e-3) heading = std::atan2(d.y, d.x);
    headings[i] = heading;
  }
  return headings;
}

// Adds the nodes of one leg: enter it at corner speed, reach the highest speed it allows, brake for the next
// corner.
struct LegSpeeds {
  double from, to;
};
struct LegCuts {
  double in, out;
};
void AppendLeg(Vec3d start, const Leg& leg, double heading, LegSpeeds speeds, LegCuts cuts, const FlightLimits& limits,
               std::vector<RouteNode>& nodes) {
  // A change of speed from u to v takes 0.75 |v^2 - u^2| / acceleration of way.
  const double way = leg.length - cuts.in - cuts.out;
  const double from2 = speeds.from * speeds.from, to2 = speeds.to * speeds.to;
  const double top = std::min(limits.speed, std::sqrt((way * limits.acceleration / 0.75 + from2 + to2) / 2));
  const double rise = 0.75 * (top * top - from2) / limits.acceleration;
  const double fall = 0.75 * (top * top - to2) / limits.acceleration;
  const double level = std::max(way - rise - fall, 0.0);
  double s = cuts.in, t = nodes.back().t;
  const auto add = [&](double distance, double time, double speed) {
    s += distance;
    t += time;
    if (time > 1e-9) nodes.push_back({.t = t, .p = start + leg.direction * s, .v = leg.direction * speed, .yaw = heading});
  };
  add(0, 2 * cuts.in / speeds.from, speeds.from);
  add(rise, 1.5 * (top - speeds.from) / limits.acceleration, top);
  add(level, level / top, top);
  add(fall, 1.5 * (top - speeds.to) / limits.acceleration, speeds.to);
}

}  // namespace

Route RoundedRoute(std::vector<Vec3d> points, const FlightLimits& limits) {
  // Legs between points that differ, and how much of them each corner (and the start and the end) takes.
  const auto same = [](Vec3d a, Vec3d b) { return Norm(a - b) < 1e-3; };
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
  if (points.size() < 2) return Route({RouteNode{0, points.at(0), {}, 0}});
  std::vector<Leg> legs;
  for (size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3d d = points[i + 1] - points[i];
    legs.push_back({Normalized(d), Norm(d)});
  }
  std::vector<double> cut(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    cut[i] = std::min({limits.corner, 0.45 * legs[i == 0 ? 0 : i - 1].length, 0.45 * legs[std::min(i, legs.size() - 1)].length});
  }
  const std::vector<double> speeds = CornerSpeeds(legs, cut, limits);
  const std::vector<double> headings = LegHeadings(legs);

  std::vector<RouteNode> nodes = {{.t = 0, .p = points[0], .v = {}, .yaw = headings[0]}};
  for (size_t i = 0; i < legs.size(); ++i) {
    AppendLeg(points[i], legs[i], headings[i], {speeds[i], speeds[i + 1]}, {cut[i], cut[i + 1]}, limits, nodes);
  }
  const double landing = 2 * cut.back() / speeds.back();
  nodes.push_back({.t = nodes.back().t + landing, .p = points.back(), .v = {}, .yaw = headings.back()});
  return Route(std::move(nodes));
}

}  // namespace airsim360

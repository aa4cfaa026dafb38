#include "airsim360/mission/flying.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/planning/routes/area_routes.h"
#include "airsim360/planning/routes/point_to_point.h"

namespace airsim360 {
namespace {

constexpr double kHere = 0.05;        // metres: no way is needed
constexpr int kPlacesAround = 16;     // tried around a thing
constexpr int kPointsPerTurn = 16;    // of an orbit: the spline through them is on the circle to 0.1 mm at 10 m
constexpr double kMostPoints = 4000;  // of all turns

std::string At(Vec3d p) {
  char text[80];
  std::snprintf(text, sizeof text, "(%.1f, %.1f, %.1f)", p.x, p.y, p.z);
  return text;
}

// Angles of places around a thing: the present one first, then ever farther to both sides.
double Turn(int i) { return (i % 2 == 0 ? 1 : -1) * ((i + 1) / 2) * 2 * std::numbers::pi / kPlacesAround; }

}  // namespace

MissionWay MissionPlanner::Free(Vec3d from, Vec3d to, const TrajectoryLimits& limits, double clearance) {
  if (Norm(to - from) < kHere) return {nullptr, to, {}};
  const Vec3d ends[] = {from, to};
  try {
    CheckAboveGround(*tracer_, to, "the goal " + At(to));
    const CertifiedFlight flight =
        FlyFree({from, to}, space_.Around(ends), {.limits = limits, .allocation = {.split = true}, .radius = clearance});
    if (!flight.certificate.certified) return {nullptr, to, "no way to " + At(to) + " could be proved free"};
    return {std::make_shared<const PolynomialTrajectory>(flight.flight.trajectory), to, {}};
  } catch (const InputError& error) {
    return {nullptr, to, error.what()};
  }
}

MissionWay MissionPlanner::Goto(Vec3d from, const ThingNow& to, const GotoRequest& request) {
  if (to.is_point) {
    const Vec3d goal{to.p_W.x, to.p_W.y, to.has_height ? to.p_W.z : from.z};
    return Free(from, goal, request.limits, request.clearance);
  }
  const double reach = std::hypot(to.half_size.x, to.half_size.y) + request.distance;
  const double bearing = std::atan2(from.y - to.p_W.y, from.x - to.p_W.x);
  MissionWay way;
  for (int i = 0; i < kPlacesAround; ++i) {
    const double angle = bearing + Turn(i);
    const Vec3d goal{to.p_W.x + reach * std::cos(angle), to.p_W.y + reach * std::sin(angle), to.p_W.z + request.height};
    const Vec3d ends[] = {from, goal};
    if (space_.Around(ends).Clearance(goal, request.clearance + 1) < request.clearance + kCertificateSlack) {
      if (way.problem.empty()) way.problem = "no place " + std::to_string(request.distance).substr(0, 4) + " m around it is free";
      continue;
    }
    way = Free(from, goal, request.limits, request.clearance);
    if (way.problem.empty()) return way;
  }
  return way;
}

Vec3d OrbitCenter(const ThingNow& around, double height) { return around.p_W + Vec3d{0, 0, height}; }

MissionWay MissionPlanner::ToOrbit(Vec3d from, const ThingNow& around, const OrbitRequest& request) {
  Vec3d center = OrbitCenter(around, request.height);
  if (!around.has_height) center.z = from.z;
  const double angle = std::atan2(from.y - center.y, from.x - center.x);
  return Free(from, center + Vec3d{std::cos(angle), std::sin(angle), 0} * request.radius, request.limits, request.clearance);
}

MissionWay MissionPlanner::Orbit(Vec3d from, const ThingNow& around, const OrbitRequest& request) {
  Vec3d center = OrbitCenter(around, request.height);
  center.z = from.z;
  if (std::abs(request.turns) * kPointsPerTurn > kMostPoints || request.turns == 0) return {nullptr, from, "`turns` is not in 0 … 250"};
  try {
    const std::vector<Vec3d> points = OrbitRoute({.center = center,
                                                  .radius = request.radius,
                                                  .turns = request.turns,
                                                  .start = std::atan2(from.y - center.y, from.x - center.x),
                                                  .points_per_turn = kPointsPerTurn});
    const AllocatedTrajectory flight = AllocateTimes(points, request.limits);
    const Certificate proof = Certify(flight.trajectory, flight.peaks, space_.Around(points), request.clearance);
    if (!proof.certified) return {nullptr, from, "something is in the way near " + At(flight.trajectory.At(proof.violation_time).p)};
    return {std::make_shared<const PolynomialTrajectory>(flight.trajectory), points.back(), {}};
  } catch (const InputError& error) {
    return {nullptr, from, error.what()};
  }
}

}  // namespace airsim360

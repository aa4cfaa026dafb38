#include "airsim360/planning/routes/point_to_point.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/planning/splines/knots.h"

namespace airsim360 {
namespace {

constexpr double kShortestLeg = 0.02;  // metres: legs are not divided further

// Legs of the path that are not proved free.
std::vector<size_t> OpenLegs(const AllocatedTrajectory& flight, const ClearanceQuery& world, double radius) {
  std::vector<size_t> legs;
  const PolynomialTrajectory& path = flight.trajectory;
  for (size_t i = 0; i < path.segments(); ++i) {
    const TimeSpan span{path.start(i), path.start(i) + path.durations()[i]};
    if (!Certify(path, flight.peaks, world, radius, span).certified) legs.push_back(i);
  }
  return legs;
}

std::string Text(Vec3d p) {
  char text[96];
  std::snprintf(text, sizeof(text), "(%.2f, %.2f, %.2f)", p.x, p.y, p.z);
  return text;
}

std::string Metres(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g m", value);
  return text;
}

// Lattice spacings to try one after another, from coarse to fine.
std::vector<double> Spacings(double distance, double radius) {
  const double first = std::clamp(distance / 40, 0.5, 2.0), last = std::clamp(radius / 2, 0.1, 0.5);
  std::vector<double> spacings;
  for (double s = first; s > last * 1.01; s /= 2) spacings.push_back(s);
  spacings.push_back(last);
  return spacings;
}

// Clear legs from a to b; why there are none, if the result is not found. Shortcuts make up for what the
// greedy search loses in length.
SearchResult FindLegs(Vec3d a, Vec3d b, const BoundedClearance& world, double radius, size_t max_expanded) {
  constexpr double kGreed = 1.6;  // weight of the distance to go
  SearchResult result;
  result.outcome = SearchOutcome::kGaveUp;
  const double distance = Norm(b - a);
  for (const double spacing : Spacings(distance, radius)) {
    for (const double margin : {std::max(20.0, 0.5 * distance), 4 * std::max(50.0, distance)}) {
      const BoundedClearance part(world, BoxAround(a, b, margin, world.box()));
      const Vec3d extent = part.box().max - part.box().min;
      const SearchOptions options{.radius = radius, .spacing = spacing, .heuristic = kGreed, .max_expanded = max_expanded};
      if (extent.x * extent.y * extent.z / std::pow(spacing, 3) > 0.5 * static_cast<double>(options.max_nodes)) continue;
      SearchResult found = FindPath(a, b, part, options);
      if (found.outcome == SearchOutcome::kFound) {
        found.path = Shortcut(std::move(found.path), world, radius);
        return found;
      }
      if (found.outcome == SearchOutcome::kGaveUp) break;  // a larger box would not help
      result = std::move(found);
      if (result.outcome == SearchOutcome::kStartBlocked || result.outcome == SearchOutcome::kGoalBlocked) return result;
    }
  }
  return result;
}

[[noreturn]] void Refuse(const SearchResult& result, size_t leg, Vec3d a, Vec3d b, const BoundedClearance& world, double radius) {
  const bool first = result.outcome == SearchOutcome::kStartBlocked || result.outcome == SearchOutcome::kStartEnclosed;
  const Vec3d p = first ? a : b;
  const std::string name = "waypoint " + std::to_string(leg + (first ? 1 : 2)) + " " + Text(p);
  if (!world.box().Contains(p)) {
    throw InputError(name + " is outside the space for flights, " + Text(world.box().min) + " … " + Text(world.box().max));
  }
  if (result.outcome == SearchOutcome::kStartBlocked || result.outcome == SearchOutcome::kGoalBlocked) {
    throw InputError(name + " is only " + Metres(world.Clearance(p, radius + 1)) +
                     " from a surface or the end of the world; the radius is " + Metres(radius));
  }
  throw InputError("no way from " + Text(a) + " to " + Text(b) + " at radius " + Metres(radius) + ": " + name + " is enclosed (" +
                   Metres(std::cbrt(result.reached_volume)) + " cubed can be reached from it)");
}

}  // namespace

CertifiedFlight FlyThrough(std::vector<Vec3d> waypoints, const ClearanceQuery& world, const FlightOptions& options) {
  const size_t given = waypoints.size();
  for (int round = 0;; ++round) {
    AllocatedTrajectory flight = AllocateTimes(waypoints, options.limits, options.allocation);
    // A straight flight may have been split: its legs are those that it was split into.
    if (const std::vector<Vec3d> knots = KnotsOf(flight.trajectory); knots.size() > waypoints.size())
      waypoints.insert(waypoints.end() - 1, knots.begin() + 1, knots.end() - 1);
    const std::vector<size_t> open = OpenLegs(flight, world, options.radius);
    // Middles of the open legs, unless they are short already.
    std::vector<Vec3d> more;
    for (size_t i = 0, k = 0; i < waypoints.size(); ++i) {
      more.push_back(waypoints[i]);
      if (k == open.size() || open[k] != i) continue;
      ++k;
      if (Norm(waypoints[i + 1] - waypoints[i]) > kShortestLeg) more.push_back((waypoints[i] + waypoints[i + 1]) * 0.5);
    }
    if (open.empty() || more.size() == waypoints.size() || round == options.rounds) {
      const Certificate certificate = Certify(flight.trajectory, flight.peaks, world, options.radius);
      const size_t added = waypoints.size() - given;
      return {std::move(flight), std::move(waypoints), certificate, added};
    }
    waypoints = std::move(more);
  }
}

CertifiedFlight FlyFree(const std::vector<Vec3d>& waypoints, const BoundedClearance& world, const FlightOptions& options) {
  constexpr size_t kThorough = 200'000, kQuick = 20'000;  // nodes looked at
  // Legs at about the radius itself: if there are none, there is no way.
  const double least = options.radius + 5 * kCertificateSlack;
  std::vector<std::vector<Vec3d>> legs;
  for (size_t i = 0; i + 1 < waypoints.size(); ++i) {
    SearchResult found = FindLegs(waypoints[i], waypoints[i + 1], world, least, kThorough);
    if (found.outcome != SearchOutcome::kFound) Refuse(found, i, waypoints[i], waypoints[i + 1], world, options.radius);
    legs.push_back(std::move(found.path));
  }
  // Legs with room to spare where there are any: a smooth path follows them more easily.
  for (const double spare : {0.5, 0.2, 0.0}) {
    std::vector<Vec3d> points = {waypoints.front()};
    for (size_t i = 0; i < legs.size(); ++i) {
      std::vector<Vec3d> way = legs[i];
      if (spare > 0) {
        const double radius = least + std::max(0.1, spare * options.radius);
        SearchResult roomy = FindLegs(waypoints[i], waypoints[i + 1], world, radius, kQuick);
        if (roomy.outcome == SearchOutcome::kFound) way = std::move(roomy.path);
      }
      points.insert(points.end(), way.begin() + 1, way.end());
    }
    CertifiedFlight flight = FlyThrough(std::move(points), world, options);
    flight.added = flight.waypoints.size() - waypoints.size();
    if (flight.certificate.certified) return flight;
  }
  throw InputError("no smooth flight could be proved free at radius " + Metres(options.radius) + "; try a smaller --radius or --amax");
}

}  // namespace airsim360

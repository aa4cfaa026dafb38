#include "airsim360/app/plan/plan_waypoints.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/nearest_name.h"
#include "airsim360/planning/routes/area_routes.h"
#include "airsim360/planning/routes/random_route.h"
#include "airsim360/routes/road_route.h"
#include "airsim360/routes/route_file.h"
#include "airsim360/routes/world_clearance.h"

namespace airsim360 {
namespace {

const std::vector<std::string> kRoutes = {"coverage", "orbit", "road", "random"};

Vec3d ParsePlace(const char* flag, const std::string& text) {
  const auto v = ParseNumbers(flag, text, 3, "x,y,z in metres");
  return {v[0], v[1], v[2]};
}

void Add(PlanWaypoints& out, Vec3d p, std::string source) {
  Waypoint waypoint;
  waypoint.p = p;
  out.points.push_back(waypoint);
  out.sources.push_back(std::move(source));
}

PlanWaypoints FromFile(const std::string& file) {
  PlanWaypoints out;
  out.points = ReadRouteFile(file);
  for (const Waypoint& waypoint : out.points) out.sources.push_back(file + ":" + std::to_string(waypoint.line));
  return out;
}

Vec3d CenterOfEntity(const Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (const Entity& entity : scene.entities) {
    if (entity.name == name && !entity.bounds.empty()) return VecCast<double>(entity.bounds.center());
    names.push_back(entity.name);
  }
  throw InputError("--entity: no entity '" + name + "' in the world" + DidYouMean(name, names));
}

std::vector<Vec3d> RandomWaypoints(const WaypointArguments& arguments, std::shared_ptr<const RayTracer> tracer, uint64_t seed,
                                   double clearance) {
  const auto range = ParseNumbers("--length", arguments.length, 2, "MIN,MAX in metres");
  if (!(range[0] > 0 && range[1] >= range[0])) throw InputError("--length: '" + arguments.length + "' is not a range of lengths");
  const Box3d box = FlightBox(*tracer);
  const auto map = MapScene(tracer->scene(), box, 0.5);
  const Vec3d spawn = tracer->scene().spawn ? VecCast<double>(*tracer->scene().spawn) : (box.min + box.max) * 0.5;
  const ReachableSpace space(*map, spawn, clearance);
  const WorldClearance surfaces(tracer, map);
  const BoundedClearance space_for_flights(surfaces, box);
  constexpr double kSpare = 0.25;  // metres that the legs keep beyond the clearance, for the curves
  const RandomRouteOptions options{.min_length = range[0], .max_length = range[1], .room = clearance + kSpare};
  RngStream random(seed, "random route");
  constexpr int kDraws = 2000;
  for (int i = 0; i < kDraws; ++i) {
    if (auto route = DrawRoute(*map, space, space_for_flights, options, random)) return *route;
  }
  throw InputError("--route: no random route of " + arguments.length + " m fits into the world");
}

std::vector<Vec3d> OfKind(const WaypointArguments& a, std::shared_ptr<const RayTracer> tracer, uint64_t seed, double clearance) {
  const double heading = a.heading_deg * std::numbers::pi / 180;
  if (a.route == "random") return RandomWaypoints(a, tracer, seed, clearance);
  if (a.route == "road") return RoadRoute(*tracer, {.height = a.height});
  if (a.route == "coverage") {
    const auto v = ParseNumbers("--area", a.area, 4, "x0,y0,x1,y1 in metres");
    return CoverageRoute({.min = {std::min(v[0], v[2]), std::min(v[1], v[3])},
                          .max = {std::max(v[0], v[2]), std::max(v[1], v[3])},
                          .height = a.height,
                          .spacing = a.spacing,
                          .heading = heading});
  }
  Vec3d center = a.entity.empty() ? ParsePlace("--center", a.center) : CenterOfEntity(tracer->scene(), a.entity);
  if (!a.entity.empty()) center.z += a.height;
  return OrbitRoute({.center = center, .radius = a.radius, .turns = a.turns, .start = heading});
}

}  // namespace

std::vector<Vec3d> PlanWaypoints::Positions() const {
  std::vector<Vec3d> positions;
  for (const Waypoint& waypoint : points) positions.push_back(waypoint.p);
  return positions;
}

bool NeedsWorld(const WaypointArguments& a) { return !a.from.empty() || a.route == "random" || a.route == "road" || !a.entity.empty(); }

void CheckSources(const WaypointArguments& arguments) {
  const int sources = !arguments.file.empty() + !arguments.from.empty() + !arguments.route.empty();
  if (sources != 1 || arguments.from.empty() != arguments.to.empty()) {
    throw InputError("plan: give one of --waypoints FILE, --from x,y,z --to x,y,z, --route KIND or --dataset waypoint");
  }
}

PlanWaypoints FindWaypoints(const WaypointArguments& arguments, std::shared_ptr<const RayTracer> tracer, uint64_t seed, double clearance) {
  PlanWaypoints out;
  if (!arguments.file.empty()) return FromFile(arguments.file);
  if (!arguments.from.empty()) {
    Add(out, ParsePlace("--from", arguments.from), "--from");
    Add(out, ParsePlace("--to", arguments.to), "--to");
    return out;
  }
  ParseChoice("kind of route", arguments.route, kRoutes, "--route");
  for (const Vec3d p : OfKind(arguments, tracer, seed, clearance))
    Add(out, p, "--route " + arguments.route + ", waypoint " + std::to_string(out.points.size() + 1));
  return out;
}

void CheckWaypoints(const PlanWaypoints& waypoints) {
  const auto& points = waypoints.points;
  if (points.size() < 2) {
    throw InputError(waypoints.sources.front() + ": only " + std::to_string(points.size()) + " waypoint; a trajectory needs at least two");
  }
  for (size_t i = 1; i < points.size(); ++i) {
    const Vec3d p = points[i].p;
    if (Norm(p - points[i - 1].p) > 1e-6) continue;
    char text[160];
    std::snprintf(text, sizeof(text), ": waypoint %zu (%.9g, %.9g, %.9g) coincides with the one before it", i + 1, p.x, p.y, p.z);
    throw InputError(waypoints.sources[i] + text);
  }
}

}  // namespace airsim360

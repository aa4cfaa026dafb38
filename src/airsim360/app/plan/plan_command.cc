// airsim360 plan: smooth flights through waypoints within limits, free of collisions in a world; the waypoint
// set.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/app/flags/session.h"
#include "airsim360/app/flags/world_flags.h"
#include "airsim360/app/plan/plan_dataset.h"
#include "airsim360/app/plan/plan_limits.h"
#include "airsim360/app/plan/plan_output.h"
#include "airsim360/app/plan/plan_waypoints.h"
#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/base/steady_clock.h"
#include "airsim360/math/coordinate_limit.h"
#include "airsim360/planning/arc_length.h"
#include "airsim360/planning/routes/point_to_point.h"
#include "airsim360/planning/splines/knots.h"
#include "airsim360/routes/world_clearance.h"
#include "airsim360/stage/stage.h"

namespace airsim360 {
namespace {

struct PlanArguments {
  WaypointArguments waypoints;
  WaypointSetArguments set;
  LimitArguments limits;
  std::string world, out, format, yaw, origin, minimise = "snap";
  double dt = 0, clearance = 0.5;
  int order = 0;
  bool avoid = false;
};

GeoPoint ParseOrigin(const std::string& text) {
  GeoPoint p;
  char rest;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &p.latitude_deg, &p.longitude_deg, &p.altitude, &rest) != 3 ||
      !(std::fabs(p.latitude_deg) <= 90) || !(std::fabs(p.longitude_deg) <= 180) || !(std::fabs(p.altitude) <= 1e5))
    throw InputError("--origin: '" + text + "' is not latitude,longitude,altitude in degrees and metres");
  return p;
}

// Empty: east.
YawRule ParseYaw(const std::string& text) {
  if (text.empty()) return ConstantYaw{};
  if (text == "velocity") return YawAlongVelocity{};
  Vec3d p;
  char rest;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &p.x, &p.y, &p.z, &rest) == 3 && std::isfinite(Norm(p)))
    return YawTowards{CheckedPlace("--yaw", p)};
  if (std::sscanf(text.c_str(), "%lf%c", &p.x, &rest) == 1 && std::isfinite(p.x)) return ConstantYaw{p.x * std::numbers::pi / 180};
  throw InputError("--yaw: '" + text + "' is neither degrees nor 'velocity' nor a point x,y,z");
}

// A world with its distances and a map around the waypoints.
struct PlanWorld {
  std::shared_ptr<const RayTracer> tracer;
  std::unique_ptr<FlightSpace> space;
  const BoundedClearance* bounded = nullptr;
};

// Places on the Earth become metres.
void Place(WaypointArguments& arguments, const WorldRequest& request) {
  const auto place = [&](const char* flag, std::string& text) {
    if (!text.empty()) text = WithPlace(flag, text, request);
  };
  place("--from", arguments.from);
  place("--to", arguments.to);
  place("--center", arguments.center);
}

void MapAround(PlanWorld& world, const std::vector<Vec3d>& points) {
  world.space = std::make_unique<FlightSpace>(world.tracer);
  world.bounded = &world.space->Around(points);
}

// Times given with the waypoints: the limits are only reported.
AllocatedTrajectory WithGivenTimes(const PlanWaypoints& waypoints, SplineKind kind) {
  std::vector<double> durations;
  for (size_t i = 1; i < waypoints.points.size(); ++i) durations.push_back(waypoints.points[i].t - waypoints.points[i - 1].t);
  const std::vector<Vec3d> positions = waypoints.Positions();
  PolynomialTrajectory path = SolveMinimumSnap({.waypoints = positions, .durations = durations, .kind = kind});
  const TrajectoryPeaks peaks = CertifiedPeaks(path);
  return {std::move(path), peaks, 0, 0};
}

// Puts the source of a waypoint before a message that begins with "waypoint N".
[[noreturn]] void Rethrow(const InputError& error, const PlanWaypoints& waypoints) {
  const std::string what = error.what();
  const size_t at = what.find("waypoint ");
  const size_t number = at == std::string::npos ? 0 : std::strtoul(what.c_str() + at + 9, nullptr, 10);
  if (number == 0 || number > waypoints.sources.size()) throw InputError(what);
  throw InputError(waypoints.sources[number - 1] + ": " + what);
}

struct Planned {
  AllocatedTrajectory flight;
  std::optional<Certificate> certificate;
  size_t added = 0;
  std::vector<Vec3d> waypoints;
};

// --order and --minimise.
SplineKind ParseKind(const PlanArguments& arguments) {
  const int order = arguments.order;
  if (order != 0 && order != 5 && order != 7) throw InputError("--order: " + std::to_string(order) + " is not 5 or 7; did you mean 7?");
  const std::vector<std::string> quantities = {"snap", "jerk"};
  ParseChoice("quantity", arguments.minimise, quantities, "--minimise");
  if (arguments.minimise == "snap") return order == 5 ? SplineKind::kPaperQuintic : SplineKind::kMinimumSnap;
  if (order == 7) throw InputError("--order: 7 has least snap; least jerk is of order 5");
  return SplineKind::kMinimumJerk;
}

// InputError for a waypoint whose surroundings no flight through it can keep to.
void CheckWaypointsAreFree(const PlanWaypoints& waypoints, const PlanWorld& world, double radius) {
  for (size_t i = 0; i < waypoints.points.size(); ++i) {
    const Vec3d p = waypoints.points[i].p;
    const double clearance = world.space->clearance().Clearance(p, radius + 1);
    if (clearance >= radius) continue;
    char text[200];
    std::snprintf(text, sizeof(text), ": waypoint %zu (%.2f, %.2f, %.2f) is only %.3g m from a surface; --clearance is %g m", i + 1, p.x,
                  p.y, p.z, clearance, radius);
    throw InputError(waypoints.sources[i] + text);
  }
}

Planned Plan(const PlanArguments& arguments, const TrajectoryLimits& limits, const PlanWaypoints& waypoints, const PlanWorld& world) {
  const SplineKind kind = ParseKind(arguments);
  const FlightOptions options{
      .limits = limits, .allocation = {.kind = kind, .sample_interval = arguments.dt, .split = true}, .radius = arguments.clearance};
  const bool timed = waypoints.points.front().has_time;
  if (arguments.avoid) {
    try {
      for (size_t i = 0; i < waypoints.points.size(); ++i)
        CheckAboveGround(*world.tracer, waypoints.points[i].p, "waypoint " + std::to_string(i + 1));
      CertifiedFlight flight = FlyFree(waypoints.Positions(), *world.bounded, options);
      return {std::move(flight.flight), flight.certificate, flight.added, std::move(flight.waypoints)};
    } catch (const InputError& error) {
      Rethrow(error, waypoints);
    }
  }
  AllocatedTrajectory flight =
      timed ? WithGivenTimes(waypoints, kind) : AllocateTimes(waypoints.Positions(), options.limits, options.allocation);
  std::optional<Certificate> certificate;
  if (world.bounded) {
    CheckWaypointsAreFree(waypoints, world, arguments.clearance);
    certificate = Certify(flight.trajectory, flight.peaks, *world.bounded, arguments.clearance);
    if (!certificate->certified) {
      char text[160];
      std::snprintf(text, sizeof(text),
                    "the flight comes closer than %g m to a surface or the end of the world at t = %.3f s; "
                    "--avoid goes around",
                    arguments.clearance, certificate->violation_time);
      LogWarning(text);
    }
  }
  std::vector<Vec3d> points = waypoints.Positions();
  const size_t given = points.size();
  if (flight.trajectory.segments() + 1 > given) points = KnotsOf(flight.trajectory);
  return {std::move(flight), certificate, points.size() - given, std::move(points)};
}

// Metres that are proved for the whole flight.
double LeastClearance(const Planned& planned, const ClearanceQuery& world) {
  const double bound = LeastClearanceBound(planned.flight.trajectory, planned.flight.peaks, world);
  return planned.certificate->certified ? std::max(bound, planned.certificate->least_clearance) : bound;
}

void Report(const TrajectoryLimits& limits, const Planned& planned, const PlanRecord& record,
            const std::vector<std::filesystem::path>& files, double plan_ms, bool json) {
  const PolynomialTrajectory& path = record.trajectory;
  const double length = ArcLength(path);
  const bool within = RespectsLimits(path, limits);
  if (json) {
    nlohmann::ordered_json out = {{"order", path.degree()},
                                  {"segments", path.segments()},
                                  {"duration", path.duration()},
                                  {"length_m", length},
                                  {"cost_snap", record.cost_snap},
                                  {"max_speed", record.peaks.speed.value},
                                  {"max_acceleration", record.peaks.acceleration.value},
                                  {"within_limits", within},
                                  {"waypoints_added", planned.added},
                                  {"plan_ms", plan_ms}};
    ReportDrone(path, limits, out);
    if (record.lower_bound > 0) out["time_lower_bound"] = record.lower_bound;
    if (record.certificate) {
      out["collision_free"] = record.certificate->certified;
      out["least_clearance_bound"] = record.certificate->least_clearance;
    }
    for (const auto& file : files) out["files"].push_back(file.string());
    PrintJson(out);
    return;
  }
  std::printf("%zu segments, %.2f m in %.3f s; at most %.4f m/s and %.4f m/s^2%s\n", path.segments(), length, path.duration(),
              record.peaks.speed.value, record.peaks.acceleration.value, within ? "" : " (beyond the limits)");
  if (record.certificate && record.certificate->certified)
    std::printf("proved free of collisions with a radius of %g m; %zu waypoints added\n", record.radius, planned.added);
  for (const auto& file : files) std::printf("%s\n", file.c_str());
}

// What follows from the flags alone: everything that can be wrong with them is found before a world is loaded.
PlanOutput ReadOutput(const PlanArguments& arguments) {
  PlanOutput output{.out = arguments.out, .interval = arguments.dt > 0 ? arguments.dt : 0.1};
  if (!arguments.format.empty()) output.formats = ParseList("--format", arguments.format, PlanFormats());
  FormatsToWrite(output);
  if (!arguments.origin.empty()) output.origin = ParseOrigin(arguments.origin);
  if (arguments.origin.empty() && std::ranges::count(FormatsToWrite(output), "qgc") > 0)
    throw InputError(
        "--origin: the format qgc is in latitude and longitude: give those and the altitude of the world's "
        "origin, for example 47.397742,8.545594,488 (where PX4's simulator starts)");
  CheckSources(arguments.waypoints);
  ParseKind(arguments);
  if (arguments.dt != 0) CheckPositive("--dt", arguments.dt);
  CheckPositive("--clearance", arguments.clearance);
  output.has_yaw = !arguments.yaw.empty();
  return output;
}

// The waypoints, and around them the world if there is one.
PlanWaypoints OpenWorld(const PlanArguments& arguments, const GlobalOptions& globals, TrajectoryLimits& limits, PlanWorld& world) {
  PlanWaypoints waypoints;
  if (!NeedsWorld(arguments.waypoints)) waypoints = FindWaypoints(arguments.waypoints, nullptr, globals.seed, arguments.clearance);
  if (!waypoints.points.empty()) CheckWaypoints(waypoints);
  const bool timed = waypoints.timed();
  if (timed && arguments.avoid) throw InputError("--avoid: the waypoints have times; remove the column t");
  limits = ParseLimits(arguments.limits, timed);
  if (arguments.world.empty()) return waypoints;
  world.tracer = Stage(StageOptionsOf(arguments.world, globals)).tracer();
  if (waypoints.points.empty()) {
    waypoints = FindWaypoints(arguments.waypoints, world.tracer, globals.seed, arguments.clearance);
    CheckWaypoints(waypoints);
  }
  MapAround(world, waypoints.Positions());
  return waypoints;
}

void RunPlan(PlanArguments arguments, const GlobalOptions& globals) {
  if (!arguments.set.dataset.empty()) {
    arguments.set.out = arguments.out;
    arguments.set.clearance = CheckPositive("--clearance", arguments.clearance);
    return RunWaypointSet(arguments.set, globals);
  }
  PlanOutput output = ReadOutput(arguments);
  const YawRule yaw = ParseYaw(arguments.yaw);
  arguments.avoid |= !arguments.waypoints.from.empty();
  if ((arguments.avoid || NeedsWorld(arguments.waypoints)) && arguments.world.empty())
    throw InputError("--world: it is needed to find a free way");
  Place(arguments.waypoints, RequestOf(arguments.world, globals));
  PlanWorld world;
  TrajectoryLimits limits;
  const PlanWaypoints waypoints = OpenWorld(arguments, globals, limits, world);
  if (world.tracer) output.plot.map = world.space->clearance().field();

  const double start = SteadySeconds();
  Planned planned = Plan(arguments, limits, waypoints, world);
  const double plan_ms = 1e3 * (SteadySeconds() - start);
  if (planned.certificate) planned.certificate->least_clearance = LeastClearance(planned, *world.bounded);
  const PolynomialTrajectory& path = planned.flight.trajectory;
  const PlanRecord record{.trajectory = path,
                          .peaks = planned.flight.peaks,
                          .cost_snap = IntegralOfSquaredDerivative(path, 4),
                          .lower_bound = planned.flight.lower_bound,
                          .start_time = waypoints.timed() ? waypoints.points.front().t : 0,
                          .yaw = yaw,
                          .radius = arguments.clearance,
                          .certificate = planned.certificate,
                          .waypoints = planned.waypoints};
  output.plot.title = "degree " + std::to_string(path.degree()) + ", " + std::to_string(path.segments()) + " segments" +
                      (arguments.world.empty() ? "" : ", " + arguments.world);
  output.plot.max_speed = arguments.limits.vmax;
  output.plot.max_acceleration = arguments.limits.amax;
  Report(limits, planned, record, WritePlan(record, output), plan_ms, globals.json);
}

}  // namespace

void AddPlanCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command =
      app.add_subcommand("plan", "a smooth flight through waypoints within limits of speed and acceleration, around obstacles");
  auto a = std::make_shared<PlanArguments>();
  WaypointArguments& w = a->waypoints;
  command->add_option("--out", a->out, "file (several formats: its name without extension); --dataset: folder")->required();
  command->add_option("--waypoints", w.file, "CSV x,y,z[,t] (metres east-north-up, seconds), YAML, GPX or KML");
  AddLimitFlags(*command, a->limits);
  RefuseZero(command->add_option("--dt", a->dt, "seconds between samples; the flight takes a multiple of it (default: 0.1, any)"), "--dt");
  command->add_option("--order", a->order, "degree: 7, the true minimum of snap (default), or 5, as in the paper");
  command->add_option("--minimise", a->minimise, "snap (default) or jerk (then of degree 5)");
  command->add_option("--world", a->world, "name or file of a world: the flight is checked against it");
  AddBoxFlag(*command, globals);
  command->add_flag("--avoid", a->avoid, "go around what is in the way in --world");
  command->add_option("--clearance", a->clearance, "metres to keep from every surface (default 0.5)");
  command->add_option("--from", w.from, "x,y,z: start of a free flight in --world; in maps also 60.1708N,24.9375E for x,y");
  command->add_option("--to", w.to, "x,y,z: its end");
  command->add_option("--route", w.route, "coverage, orbit, road or random: waypoints of that kind");
  command->add_option("--area", w.area, "coverage: x0,y0,x1,y1");
  command->add_option("--height", w.height, "coverage: z; road: above the road; orbit --entity: above its middle (20)");
  command->add_option("--spacing", w.spacing, "coverage: metres between lanes (10)");
  command->add_option("--heading", w.heading_deg, "coverage: of the lanes; orbit: of the start; degrees from east (0)");
  command->add_option("--center", w.center, "orbit: x,y,z");
  command->add_option("--entity", w.entity, "orbit: around this entity of the world");
  command->add_option("--radius", w.radius, "orbit: metres (10)");
  command->add_option("--turns", w.turns, "orbit: counter-clockwise, negative for clockwise (1)");
  command->add_option("--length", w.length, "random: MIN,MAX metres (50,150)");
  command->add_option("--format", a->format,
                      "csv, json, npz, yaml, crazyflie, crazyflie-compressed, qgc, mavlink, svg; several with "
                      "commas (default: by the extension of --out)");
  command->add_option("--yaw", a->yaw,
                      "heading of the drone in exports: degrees anticlockwise from east (0), 'velocity' (the "
                      "way it flies) or x,y,z (towards a point)");
  command->add_option("--origin", a->origin, "qgc, which cannot do without: latitude,longitude,altitude of the origin of the world");
  command->add_option("--dataset", a->set.dataset, "waypoint: the Omni360-WayPoint set, into the folder --out");
  command->add_option("--routes", a->set.routes, "dataset: at most this many routes of each world (default: the paper's)");
  command->add_option("--worlds", a->set.worlds, "dataset: only these worlds");
  command->add_option("--shard", a->set.shard, "dataset: I/N, only parts with number % N == I (default 0/1)");
  command->callback([a, &globals] { RunPlan(*a, globals); });
}

}  // namespace airsim360

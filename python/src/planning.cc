// Minimum-snap trajectories and their proofs.
#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/planning/routes/point_to_point.h"
#include "airsim360/routes/world_clearance.h"
#include "handles.h"

namespace airsim360::python {
namespace {

constexpr double kMapVoxel = 0.5, kMapMargin = 40;  // metres; of the map around the waypoints

/// Distances of a world, with a map around some points.
struct Surroundings {
  std::unique_ptr<WorldClearance> clearance;
  std::unique_ptr<BoundedClearance> bounded;
};

Surroundings MapAround(World& world, const std::vector<Vec3d>& points, bool with_map) {
  const auto tracer = world.stage()->solid();
  const Box3d space = FlightBox(*tracer);
  std::shared_ptr<const ClearanceField> map;
  Box3d box{points.front(), points.front()};
  for (const Vec3d p : points) box = {Min(box.min, p), Max(box.max, p)};
  box = BoxAround(box.min, box.max, kMapMargin, space);
  const Vec3d size = box.max - box.min;
  const double least = std::min({size.x, size.y, size.z});
  if (with_map && least > 1) map = MapScene(tracer->scene(), box, std::min(kMapVoxel, least / 40));
  Surroundings around;
  around.clearance = std::make_unique<WorldClearance>(tracer, map);
  around.bounded = std::make_unique<BoundedClearance>(*around.clearance, space);
  return around;
}

struct PlanArguments {
  std::vector<Vec3d> points;
  std::optional<std::vector<double>> times;
  TrajectoryLimits limits;
  SplineKind kind;
  BoundaryDerivatives start, end;
  bool moving;  ///< start or end is not at rest
  std::shared_ptr<World> world;
  double clearance;
  bool avoid;
};

AllocatedTrajectory AtTimes(const PlanArguments& a) {
  const std::vector<Vec3d>& points = a.points;
  const std::vector<double>& times = *a.times;
  if (times.size() != points.size())
    throw InputError("times: " + std::to_string(times.size()) + " for " + std::to_string(points.size()) + " waypoints");
  std::vector<double> durations;
  for (size_t i = 1; i < times.size(); ++i) {
    durations.push_back(times[i] - times[i - 1]);
    if (!(durations.back() > 0)) throw InputError("times[" + std::to_string(i) + "] is not after the one before it");
  }
  PolynomialTrajectory path =
      SolveMinimumSnap({.waypoints = points, .durations = durations, .start = a.start, .end = a.end, .kind = a.kind});
  const TrajectoryPeaks peaks = CertifiedPeaks(path);
  return {std::move(path), peaks, 0, 0};
}

/// Times that suit a flight from rest to rest, stretched as the moving ends need.
AllocatedTrajectory WithinLimits(const PlanArguments& a) {
  AllocatedTrajectory rest = AllocateTimes(a.points, a.limits, {.kind = a.kind});
  if (!a.moving) return rest;
  PolynomialTrajectory path = SolveWithinLimits(
      {.waypoints = a.points, .durations = rest.trajectory.durations(), .start = a.start, .end = a.end, .kind = a.kind}, a.limits);
  const TrajectoryPeaks peaks = CertifiedPeaks(path);
  return {std::move(path), peaks, 0, 0};
}

Plan Solve(const PlanArguments& a) {
  const FlightOptions options{.limits = a.limits, .allocation = {.kind = a.kind}, .radius = a.clearance};
  Plan plan;
  plan.waypoints = a.points;
  std::optional<AllocatedTrajectory> flight;
  if (a.avoid) {
    for (size_t i = 0; i < a.points.size(); ++i)
      CheckAboveGround(*a.world->stage()->solid(), a.points[i], "waypoint " + std::to_string(i + 1));
    const Surroundings around = MapAround(*a.world, a.points, true);
    CertifiedFlight free = FlyFree(a.points, *around.bounded, options);
    plan.certificate = free.certificate;
    plan.waypoints = std::move(free.waypoints);
    flight = std::move(free.flight);
  } else {
    flight = a.times ? AtTimes(a) : WithinLimits(a);
    if (a.world) {
      const Surroundings around = MapAround(*a.world, a.points, false);
      plan.certificate = Certify(flight->trajectory, flight->peaks, *around.bounded, a.clearance);
    }
  }
  plan.peaks = flight->peaks;
  plan.cost_snap = IntegralOfSquaredDerivative(flight->trajectory, 4);
  plan.trajectory = std::make_shared<const PolynomialTrajectory>(std::move(flight->trajectory));
  return plan;
}

/// The other limits by their names.
void ReadLimits(const py::dict& values, TrajectoryLimits& limits) {
  const std::vector<std::string> names = {"axis_vmax", "axis_amax", "climb", "descent", "thrust", "body_rate"};
  const auto axes = [](const py::handle& value, const char* name) { return ToPoints(py::make_tuple(value), name).at(0); };
  for (const auto& [key, value] : values) {
    const std::string name = py::str(key);
    if (name == "axis_vmax") {
      limits.axis_speed = axes(value, "axis_vmax");
    } else if (name == "axis_amax") {
      limits.axis_acceleration = axes(value, "axis_amax");
    } else if (name == "climb") {
      limits.climb = value.cast<double>();
    } else if (name == "descent") {
      limits.descent = value.cast<double>();
    } else if (name == "thrust") {
      limits.thrust_per_mass = value.cast<double>();
    } else if (name == "body_rate") {
      limits.body_rate = value.cast<double>();
    } else {
      throw InputError("limits: " + UnknownChoiceMessage("limit", name, names));
    }
  }
}

/// Up to three rows: velocity, acceleration, jerk.
BoundaryDerivatives ReadEnd(const py::object& value, const char* what, bool& moving) {
  if (value.is_none()) return {};
  const std::vector<Vec3d> rows = ToPoints(value, what);
  if (rows.size() > 3) throw InputError(std::string(what) + ": at most velocity, acceleration and jerk");
  BoundaryDerivatives end;
  Vec3d* const fields[] = {&end.v, &end.a, &end.jerk};
  for (size_t i = 0; i < rows.size(); ++i) {
    *fields[i] = rows[i];
    moving |= Norm(rows[i]) > 0;
  }
  return end;
}

SplineKind ReadKind(int order, const std::string& minimise) {
  if (order != 5 && order != 7) throw InputError("order: " + std::to_string(order) + " is not 5 or 7; did you mean 7?");
  if (minimise == "jerk" && order == 5) return SplineKind::kMinimumJerk;
  if (minimise != "snap") throw InputError("minimise: '" + minimise + "' is not snap, or jerk with order=5");
  return order == 5 ? SplineKind::kPaperQuintic : SplineKind::kMinimumSnap;
}

Plan PlanMinimumSnap(const py::object& waypoints, const std::optional<std::vector<double>>& times, double vmax, double amax, int order,
                     const std::shared_ptr<World>& world, double clearance, bool avoid, const py::dict& limits, const std::string& minimise,
                     const py::object& start, const py::object& end) {
  PlanArguments a{.points = ToPoints(waypoints, "waypoints"),
                  .times = times,
                  .limits = {.speed = vmax, .acceleration = amax},
                  .kind = ReadKind(order, minimise),
                  .start = {},
                  .end = {},
                  .moving = false,
                  .world = world,
                  .clearance = clearance,
                  .avoid = avoid};
  ReadLimits(limits, a.limits);
  a.start = ReadEnd(start, "start", a.moving);
  a.end = ReadEnd(end, "end", a.moving);
  if (avoid && a.moving) throw InputError("avoid: flights around obstacles start and end at rest");
  if (avoid && !world) throw InputError("avoid: give the world whose surfaces are to be avoided");
  if (avoid && times) throw InputError("avoid: times cannot be given, waypoints are added");
  if (!(clearance > 0 && std::isfinite(clearance))) throw InputError("clearance: " + std::to_string(clearance) + " is not positive");
  if (a.points.size() < 2) throw InputError("waypoints: at least two are needed");
  Plan plan;
  {
    const py::gil_scoped_release release;
    plan = Solve(a);
  }
  if (plan.certificate && !plan.certificate->certified) {
    const std::string text =
        Text("plan_minimum_snap: the flight comes within %.3g m of a surface at %.3g s, less than the clearance of %g m%s",
             plan.certificate->least_clearance, plan.certificate->violation_time, clearance, avoid ? "" : "; avoid=True leads it around");
    if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) < 0) throw py::error_already_set();
  }
  return plan;
}

py::array_t<double> Times(const Plan& p) {
  const auto n = static_cast<py::ssize_t>(p.trajectory->segments());
  py::array_t<double> a(n + 1);
  for (py::ssize_t i = 0; i < n; ++i) a.mutable_data()[i] = p.trajectory->start(static_cast<size_t>(i));
  a.mutable_data()[n] = p.trajectory->duration();
  return a;
}

py::array Coefficients(const py::object& self) {
  const PolynomialTrajectory& path = *self.cast<const Plan&>().trajectory;
  const py::ssize_t powers = path.degree() + 1, word = sizeof(double);
  return View(path.coefficients().data(), {static_cast<py::ssize_t>(path.segments()), 3, powers}, {3 * powers * word, powers * word, word},
              self);
}

// Rows of points as a dictionary of arrays.
py::dict At(const Plan& plan, const std::vector<double>& times) {
  const auto n = static_cast<py::ssize_t>(times.size());
  py::array_t<double> t(n), fields[5];
  for (auto& field : fields) field = py::array_t<double>({n, py::ssize_t{3}});
  for (py::ssize_t i = 0; i < n; ++i) {
    t.mutable_data()[i] = Finite(times[static_cast<size_t>(i)], "t");
    const TrajectoryPoint point = plan.trajectory->At(t.data()[i]);
    const Vec3d values[5] = {point.p, point.v, point.a, point.jerk, point.snap};
    for (int k = 0; k < 5; ++k) {
      for (int axis = 0; axis < 3; ++axis) fields[k].mutable_data()[3 * i + axis] = values[k][axis];
    }
  }
  py::dict d;
  d["t"] = t;
  const char* names[5] = {"p", "v", "a", "jerk", "snap"};
  for (int k = 0; k < 5; ++k) d[names[k]] = fields[k];
  return d;
}

py::object CertificateOf(const Plan& p) {
  if (!p.certificate) return py::none();
  py::dict d;
  d["certified"] = p.certificate->certified;
  d["least_clearance"] = p.certificate->least_clearance;
  d["violation_time"] = p.certificate->certified ? py::object(py::none()) : py::float_(p.certificate->violation_time);
  return d;
}

}  // namespace

void BindPlanning(py::module_& m) {
  py::class_<Plan>(m, "Plan", "A minimum-snap trajectory in W: metres, seconds.")
      .def("__repr__",
           [](const Plan& p) {
             return Text("Plan(%zu waypoints, %.3f s, at most %.3f m/s and %.3f m/s^2)", p.waypoints.size(), p.trajectory->duration(),
                         p.peaks.speed.value, p.peaks.acceleration.value);
           })
      .def_property_readonly("times", &Times, "(segments + 1,) seconds at which the waypoints are passed.")
      .def_property_readonly(
          "waypoints", [](const Plan& p) { return FromPoints(p.waypoints); }, "(segments + 1, 3) metres in W")
      .def_property_readonly("coefficients", &Coefficients,
                             "(segments, 3, order + 1): ascending powers of the segment's local time. A view, do not write.")
      .def_property_readonly(
          "order", [](const Plan& p) { return p.trajectory->degree(); }, "Degree of the polynomials.")
      .def_property_readonly(
          "duration", [](const Plan& p) { return p.trajectory->duration(); }, "Seconds.")
      .def_readonly("cost_snap", &Plan::cost_snap, "Integral of squared snap over all axes, m^2/s^7.")
      .def_property_readonly(
          "max_speed", [](const Plan& p) { return p.peaks.speed.value; }, "m/s, certified upper bound")
      .def_property_readonly(
          "max_acceleration", [](const Plan& p) { return p.peaks.acceleration.value; }, "m/s^2, certified upper bound")
      .def_property_readonly("certificate", &CertificateOf,
                             "With a world: whether the clearance is proved everywhere (certified, "
                             "least_clearance, violation_time); else None.")
      .def(
          "at",
          [](const Plan& p, const py::object& times) {
            const Doubles given = ToNumbers(times, "times");
            if (given.ndim() > 1)
              throw InputError("times: an array of " + std::to_string(given.ndim()) + " dimensions, not one time or (N,)");
            const py::dict points = At(p, {given.data(), given.data() + given.size()});
            if (given.ndim() == 1) return points;
            py::dict point;
            for (const auto& [name, values] : points) point[name] = values[py::int_(0)];
            return point;
          },
          py::arg("times"), "t (N,), p, v, a, jerk, snap (N, 3) at given times, clamped to the flight; for one time a number and (3,).")
      .def(
          "sample",
          [](const Plan& p, double dt) {
            if (!(dt > 0) || p.trajectory->duration() / dt > 1e8)
              throw InputError("dt: " + std::to_string(dt) + " s is not positive, or too small");
            return At(p, SampleTimes(p.trajectory->duration(), dt));
          },
          py::arg("dt") = 0.1, "As at(), every dt seconds and at the end.");
  m.def("plan_minimum_snap", &PlanMinimumSnap, py::arg("waypoints"), py::arg("times") = py::none(), py::arg("vmax") = 4.0,
        py::arg("amax") = 4.0, py::arg("order") = 7, py::arg("world") = py::none(), py::arg("clearance") = 0.5, py::arg("avoid") = false,
        py::arg("limits") = py::dict(), py::arg("minimise") = "snap", py::arg("start") = py::none(), py::arg("end") = py::none(),
        R"(The smoothest flight through waypoints (N, 3) of W, at rest at both ends.

times: (N,) seconds; None: the fastest that were found within vmax (m/s) and amax (m/s^2). order: 7 (minimum snap) or 5
(the paper's quintic; with minimise="jerk" least jerk). world: the flight is checked against its surfaces with `clearance`
metres, and a UserWarning says where it comes nearer; avoid: it is led around them. limits: more of them, axis_vmax and axis_amax (3,), climb, descent (m/s), thrust
(m/s^2, of a drone: |a + g|), body_rate (rad/s, roll and pitch). start, end: (1 to 3, 3), velocity, acceleration and jerk
there.)");
}

}  // namespace airsim360::python

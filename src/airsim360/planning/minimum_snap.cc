#include "airsim360/planning/minimum_snap.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/planning/aligned_buffer.h"
#include "airsim360/planning/spline_kernel.h"
#include "airsim360/planning/spline_wide.h"

namespace airsim360 {
namespace {

using namespace internal;

[[noreturn]] void Fail(const std::string& text) { throw InputError("minimum snap: " + text); }

void CheckCounts(size_t waypoints, size_t durations) {
  if (waypoints < 2) Fail(std::to_string(waypoints) + " waypoints, at least 2 are needed");
  if (durations + 1 != waypoints) {
    Fail(std::to_string(waypoints) + " waypoints need " + std::to_string(waypoints - 1) + " durations, not " +
         std::to_string(durations));
  }
}

/// Cheap test of all numbers first; the culprit is looked for only if there is one.
void CheckNumbers(const CheckKernels& kernels, std::span<const Vec3d> waypoints,
                  std::span<const double> durations) {
  if (kernels.all_finite(&waypoints[0].x, 3 * waypoints.size()) &&
      kernels.all_finite(durations.data(), durations.size()) &&
      kernels.all_positive(durations.data(), durations.size())) {
    return;
  }
  for (size_t i = 0; i < durations.size(); ++i) {
    if (!(durations[i] > 0) || !std::isfinite(durations[i])) {
      Fail("duration " + std::to_string(i) + " is " + std::to_string(durations[i]) +
           " s, must be positive and finite");
    }
  }
  for (size_t i = 0; i < waypoints.size(); ++i) {
    if (!kernels.all_finite(&waypoints[i].x, 3)) Fail("waypoint " + std::to_string(i) + " is not finite");
  }
}

void CheckEnds(const CheckKernels& kernels, const MinimumSnapProblem& problem) {
  static_assert(sizeof(BoundaryDerivatives) == 9 * sizeof(double));
  if (!kernels.all_finite(&problem.start.v.x, 9)) Fail("derivatives at the start are not finite");
  if (!kernels.all_finite(&problem.end.v.x, 9)) Fail("derivatives at the end are not finite");
}

/// Four lanes per vector.
void Pad(Vec3d v, double* out) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
  out[3] = 0;
}

}  // namespace

struct MinimumSnapSolver::Impl {
  const SplineKernels* kernels = AIRSIM360_SELECT_KERNEL(kSplineKernels);
  const CheckKernels* checks = AIRSIM360_SELECT_KERNEL(kCheckKernels);
  SplineKind kind = SplineKind::kMinimumSnap;
  bool free = false;
  std::vector<double> durations, coefficients;
  AlignedBuffer knots, workspace;
  double start[12] = {}, end[12] = {};

  void Copy(const MinimumSnapProblem& problem) {
    kind = problem.kind;
    free = kind == SplineKind::kPaperQuintic || (kind == SplineKind::kMinimumSnap && problem.free_jerk);
    durations.assign(problem.durations.begin(), problem.durations.end());
    double* out = knots.Reserve(4 * problem.waypoints.size());
    for (const Vec3d& waypoint : problem.waypoints) {
      Pad(waypoint, out);
      out += 4;
    }
    Pad(problem.start.v, start);
    Pad(problem.start.a, start + 4);
    Pad(problem.start.jerk, start + 8);
    Pad(problem.end.v, end);
    Pad(problem.end.a, end + 4);
    Pad(problem.end.jerk, end + 8);
    coefficients.resize(durations.size() * 3 * static_cast<size_t>(PowersOf(kind)));
  }

  void Solve() {
    const size_t segments = durations.size();
    const RouteArguments arguments = {.knots = knots.data(),
                                      .durations = durations.data(),
                                      .segments = segments,
                                      .start = start,
                                      .end = end,
                                      .free_start = free,
                                      .free_end = free,
                                      .workspace = workspace.Reserve(RouteWorkspace(segments)),
                                      .coefficients = coefficients.data()};
    if (segments == 1) return SolveRouteWide(kind, arguments);
    kernels->route[static_cast<int>(kind)](arguments);
    if (checks->any_uneven(durations.data(), segments)) RefineUneven(kind, *checks, arguments);
  }
};

MinimumSnapSolver::MinimumSnapSolver() : impl_(std::make_unique<Impl>()) {}
MinimumSnapSolver::~MinimumSnapSolver() = default;
MinimumSnapSolver::MinimumSnapSolver(MinimumSnapSolver&&) noexcept = default;
MinimumSnapSolver& MinimumSnapSolver::operator=(MinimumSnapSolver&&) noexcept = default;

void MinimumSnapSolver::Solve(const MinimumSnapProblem& problem) {
  CheckCounts(problem.waypoints.size(), problem.durations.size());
  CheckNumbers(*impl_->checks, problem.waypoints, problem.durations);
  CheckEnds(*impl_->checks, problem);
  impl_->Copy(problem);
  impl_->Solve();
}

int MinimumSnapSolver::degree() const { return PowersOf(impl_->kind) - 1; }

std::span<const double> MinimumSnapSolver::coefficients() const { return impl_->coefficients; }

PolynomialTrajectory MinimumSnapSolver::Trajectory() const {
  return PolynomialTrajectory(degree(), impl_->durations, impl_->coefficients);
}

double MinimumSnapSolver::Cost() const {
  return IntegralOfSquaredDerivative(Trajectory(), impl_->kind == SplineKind::kMinimumJerk ? 3 : 4);
}

PolynomialTrajectory SolveMinimumSnap(const MinimumSnapProblem& problem) {
  MinimumSnapSolver solver;
  solver.Solve(problem);
  return solver.Trajectory();
}

void SolveMinimumSnapBatch(std::span<const Vec3d> waypoints, std::span<const double> durations, size_t routes,
                           SplineKind kind, std::span<double> coefficients) {
  const size_t segments = routes == 0 ? 0 : durations.size() / routes;
  const size_t size = segments * 3 * static_cast<size_t>(PowersOf(kind));
  if (durations.size() != routes * segments || waypoints.size() != routes * (segments + 1) ||
      coefficients.size() != routes * size) {
    Fail("sizes of the batch do not agree");
  }
  if (routes == 0) return;
  CheckCounts(segments + 1, segments);
  const CheckKernels& checks = *AIRSIM360_SELECT_KERNEL(kCheckKernels);
  CheckNumbers(checks, waypoints, durations);

  const SplineKernels* const kernels = AIRSIM360_SELECT_KERNEL(kSplineKernels);
  static thread_local AlignedBuffer workspace;
  BatchArguments arguments = {};
  arguments.segments = segments;
  arguments.workspace = workspace.Reserve(BatchWorkspace(segments));
  std::vector<size_t> uneven;
  for (size_t first = 0; first < routes; first += 8) {
    for (size_t lane = 0; lane < 8; ++lane) {
      // Lanes beyond the last route repeat it: they write the same numbers once more.
      const size_t route = std::min(first + lane, routes - 1);
      arguments.waypoints[lane] = &waypoints[route * (segments + 1)].x;
      arguments.durations[lane] = &durations[route * segments];
      arguments.coefficients[lane] = &coefficients[route * size];
      if (first + lane == route &&
          (segments == 1 || checks.any_uneven(arguments.durations[lane], segments))) {
        uneven.push_back(route);
      }
    }
    kernels->batch[static_cast<int>(kind)](arguments);
  }
  if (uneven.empty()) return;
  MinimumSnapSolver solver;
  for (const size_t route : uneven) {
    solver.Solve({.waypoints = waypoints.subspan(route * (segments + 1), segments + 1),
                  .durations = durations.subspan(route * segments, segments),
                  .kind = kind});
    std::copy(solver.coefficients().begin(), solver.coefficients().end(), &coefficients[route * size]);
  }
}

}  // namespace airsim360

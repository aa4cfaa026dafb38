#include "airsim360/planning/splines/minimum_snap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/planning/splines/aligned_buffer.h"
#include "airsim360/planning/splines/spline_chunks.h"
#include "airsim360/planning/splines/spline_kernel.h"
#include "airsim360/planning/splines/spline_wide.h"

namespace airsim360 {
namespace {

using namespace internal;

[[noreturn]] void Fail(const std::string& text) { throw InputError("minimum snap: " + text); }

[[noreturn]] void FailOnCounts(size_t waypoints, size_t durations) {
  if (waypoints < 2) Fail(std::to_string(waypoints) + " waypoints, at least 2 are needed");
  Fail(std::to_string(waypoints) + " waypoints need " + std::to_string(waypoints - 1) + " durations, not " + std::to_string(durations));
}

void CheckCounts(size_t waypoints, size_t durations) {
  if (waypoints < 2 || durations + 1 != waypoints) FailOnCounts(waypoints, durations);
}

/// Names the number that is wrong.
[[noreturn]] void FailOnNumbers(const CheckKernels& kernels, std::span<const Vec3d> waypoints, std::span<const double> durations) {
  for (size_t i = 0; i < durations.size(); ++i) {
    if (!(durations[i] > 0) || !std::isfinite(durations[i])) {
      Fail("duration " + std::to_string(i) + " is " + std::to_string(durations[i]) + " s, must be positive and finite");
    }
  }
  for (size_t i = 0; i < waypoints.size(); ++i) {
    if (!kernels.all_finite(&waypoints[i].x, 3)) Fail("waypoint " + std::to_string(i) + " is not finite");
  }
  Fail("numbers are too large: the path is not finite");
}

/// Routes of few segments are solved again sooner: it costs little, and at their ends nothing evens out what
/// a long segment beside short ones loses.
bool UnevenFew(std::span<const double> durations) {
  if (durations.size() > kFewSegments) return false;
  const auto [least, largest] = std::ranges::minmax(durations);
  return largest > kEvenRatio * least;
}

/// Whether all prescribed derivatives are (positive) zeros. In pairs, as a compiler is likely to have written
/// them: wider loads would wait for the stores.
bool AtRest(const MinimumSnapProblem& problem) {
  typedef unsigned long long Pair __attribute__((vector_size(16), aligned(8), may_alias));
  static_assert(offsetof(MinimumSnapProblem, end) == offsetof(MinimumSnapProblem, start) + sizeof(BoundaryDerivatives) &&
                2 * sizeof(BoundaryDerivatives) == 9 * sizeof(Pair));
  const Pair* const pairs = reinterpret_cast<const Pair*>(&problem.start);
  const Pair any = (((pairs[0] | pairs[1]) | (pairs[2] | pairs[3])) | ((pairs[4] | pairs[5]) | (pairs[6] | pairs[7]))) | pairs[8];
  return (any[0] | any[1]) == 0;
}

}  // namespace

struct MinimumSnapSolver::Impl {
  const SplineKernels* kernels = AIRSIM360_SELECT_KERNEL(kSplineKernels);
  const BatchKernels* batches = AIRSIM360_SELECT_KERNEL(kBatchKernels);
  const AdjointKernels* adjoints = AIRSIM360_SELECT_KERNEL(kAdjointKernels);
  const CheckKernels* checks = AIRSIM360_SELECT_KERNEL(kCheckKernels);
  SplineKind kind = SplineKind::kMinimumSnap;
  bool free = false, refine = false, at_rest = true;
  std::vector<double> durations, coefficients;
  std::vector<double> cost_gradient, direct;
  AlignedBuffer waypoint_gradient;
  AlignedBuffer knots, workspace;
  alignas(64) double ends[2][12] = {};

  /// Routes of few segments at rest, whose solution takes less time than the way to the general one.
  bool SolveFew(const MinimumSnapProblem& problem) {
    const size_t segments = problem.durations.size();
    if (segments - 2 > kFewSegments - 2 || problem.kind != SplineKind::kMinimumSnap || problem.free_jerk || !AtRest(problem)) {
      return false;
    }
    Resize(segments, 8);
    const NumberCheck check =
        kernels->few[segments - 2](&problem.waypoints[0].x, problem.durations.data(), knots.data(), durations.data(), coefficients.data());
    if (!check.valid) FailOnBadNumbers(problem);
    kind = SplineKind::kMinimumSnap;
    free = false;
    if (!at_rest) std::memset(ends, 0, sizeof(ends));
    at_rest = true;
    if (check.uneven && problem.refine) Refine(Arguments());
    return true;
  }

  void Resize(size_t segments, size_t powers) {
    if (durations.size() != segments) {
      durations.resize(segments);
      knots.Reserve(4 * segments + 4);
    }
    if (coefficients.size() != segments * 3 * powers) coefficients.resize(segments * 3 * powers);
  }

  [[noreturn]] void FailOnBadNumbers(const MinimumSnapProblem& problem) {
    durations.clear();
    coefficients.clear();
    FailOnNumbers(*checks, problem.waypoints, problem.durations);
  }

  /// Takes the numbers and looks at them on the way.
  void Copy(const MinimumSnapProblem& problem) {
    const size_t segments = problem.durations.size();
    kind = problem.kind;
    Resize(segments, static_cast<size_t>(PowersOf(kind)));
    const NumberCheck check = checks->copy_durations(problem.durations.data(), segments, durations.data());
    if (!checks->pad_points(&problem.waypoints[0].x, segments + 1, knots.data()) || !check.valid) {
      FailOnBadNumbers(problem);
    }
    const bool rest = AtRest(problem);
    // Zeros stay from one problem to the next.
    if (!(rest && at_rest) && !checks->pad_points(&problem.start.v.x, 6, ends[0])) {
      durations.clear();
      coefficients.clear();
      at_rest = false;
      const bool at_end = checks->all_finite(&problem.start.v.x, 9);
      Fail(std::string("derivatives at the ") + (at_end ? "end" : "start") + " are not finite");
    }
    at_rest = rest;
    free = kind == SplineKind::kPaperQuintic || (kind == SplineKind::kMinimumSnap && problem.free_jerk);
    refine = problem.refine && (check.uneven || UnevenFew(problem.durations));
  }

  RouteArguments Arguments() {
    const size_t segments = durations.size();
    return {.knots = knots.data(),
            .durations = durations.data(),
            .segments = segments,
            .start = ends[0],
            .end = ends[1],
            .free_start = free,
            .free_end = free,
            .workspace = workspace.Reserve(
                std::max({RouteWorkspace(segments), AdjointWorkspace(segments), segments < kLeastChunkedSegments ? 0 : ChunkWorkspace()})),
            .coefficients = coefficients.data()};
  }

  /// Durations that grow or shrink on and on can leave the range of double precision on the way to an answer
  /// within it; not if the largest is at most 1e12 times the least, for no power above the twentieth appears.
  void Refine(const RouteArguments& arguments) {
    const auto [least, largest] = std::ranges::minmax(durations);
    if (largest <= 1e12 * least && least >= kShortestDuration && largest <= kLongestDuration) {
      return RefineUneven(kind, *checks, arguments);
    }
    if (checks->all_finite(coefficients.data(), coefficients.size())) {
      RefineUneven(kind, *checks, arguments);
    } else {
      SolveRouteWide(kind, arguments);
    }
    FailIfNotFinite();
  }

  void FailIfNotFinite() {
    if (checks->all_finite(coefficients.data(), coefficients.size())) return;
    const auto [least, largest] = std::ranges::minmax(durations);
    durations.clear();
    coefficients.clear();
    char text[160];
    std::snprintf(text, sizeof(text), "the path leaves the range of numbers: durations from %g to %g s are too small or too different",
                  least, largest);
    Fail(text);
  }

  void Solve() {
    const RouteArguments arguments = Arguments();
    if (arguments.segments == 1) {
      SolveRouteWide(kind, arguments);
      return FailIfNotFinite();
    }
    const bool try_chunks = arguments.segments >= kLeastChunkedSegments && !free;
    if (!try_chunks || !SolveRouteInChunks(kind, *batches, arguments)) {
      kernels->route[static_cast<int>(kind)](arguments);
    }
    if (refine) Refine(arguments);
  }

  /// Of a true optimum: by a duration less twice the Hamiltonian of the segment, here at its start; by a
  /// waypoint twice the jump of the highest derivative.
  void OptimumGradient(std::span<double> by_duration, std::span<Vec3d> by_waypoint) const {
    const bool snap = kind == SplineKind::kMinimumSnap;
    const size_t powers = snap ? 8 : 6, top = powers - 1;
    const double factor = snap ? 2 * 5040 : -2 * 120;
    std::fill(by_waypoint.begin(), by_waypoint.end(), Vec3d{});
    for (size_t i = 0; i < durations.size(); ++i) {
      const double* c = &coefficients[3 * i * powers];
      double sum = 0;
      for (int axis = 0; axis < 3; ++axis, c += powers) {
        // With p_n = n! c_n: -p4^2 + 2 p3 p5 - 2 p2 p6 + 2 p1 p7, or -p3^2 + 2 p2 p4 - 2 p1 p5.
        sum += snap ? -576 * c[4] * c[4] + 1440 * c[3] * c[5] - 2880 * c[2] * c[6] + 10080 * c[1] * c[7]
                    : -36 * c[3] * c[3] + 96 * c[2] * c[4] - 240 * c[1] * c[5];
        if (by_waypoint.empty()) continue;
        by_waypoint[i][axis] += factor * c[top];
        by_waypoint[i + 1][axis] -= factor * c[top];
      }
      if (!by_duration.empty()) by_duration[i] = sum;
    }
  }

  /// Derivatives of the cost by the coefficients (cost_gradient) and, at fixed coefficients, by the durations
  /// (direct).
  void CostPartials() {
    const size_t powers = static_cast<size_t>(PowersOf(kind)), order = 4;
    cost_gradient.resize(coefficients.size());
    direct.resize(durations.size());
    for (size_t i = 0; i < durations.size(); ++i) {
      const double duration = durations[i];
      direct[i] = 0;
      for (size_t axis = 0; axis < 3; ++axis) {
        const double* const c = &coefficients[(3 * i + axis) * powers];
        double* const gradient = &cost_gradient[(3 * i + axis) * powers];
        std::fill(gradient, gradient + order, 0.0);
        // Snap h0 + h1 t: the cost is h0^2 T + h0 h1 T^2 + h1^2 T^3 / 3.
        const double h0 = 24 * c[4], h1 = 120 * c[5], end = h0 + h1 * duration;
        gradient[4] = 24 * duration * (2 * h0 + h1 * duration);
        gradient[5] = 120 * duration * duration * (h0 + 2.0 / 3 * h1 * duration);
        direct[i] += end * end;
      }
    }
  }
};

MinimumSnapSolver::MinimumSnapSolver() : impl_(std::make_unique<Impl>()) {}
MinimumSnapSolver::~MinimumSnapSolver() = default;
MinimumSnapSolver::MinimumSnapSolver(MinimumSnapSolver&&) noexcept = default;
MinimumSnapSolver& MinimumSnapSolver::operator=(MinimumSnapSolver&&) noexcept = default;

void MinimumSnapSolver::Solve(const MinimumSnapProblem& problem) {
  CheckCounts(problem.waypoints.size(), problem.durations.size());
  if (impl_->SolveFew(problem)) return;
  impl_->Copy(problem);
  impl_->Solve();
}

int MinimumSnapSolver::degree() const { return PowersOf(impl_->kind) - 1; }

std::span<const double> MinimumSnapSolver::coefficients() const { return impl_->coefficients; }

PolynomialTrajectory MinimumSnapSolver::Trajectory() const { return PolynomialTrajectory(degree(), impl_->durations, impl_->coefficients); }

double MinimumSnapSolver::Cost() const {
  return IntegralOfSquaredDerivative(Trajectory(), impl_->kind == SplineKind::kMinimumJerk ? 3 : 4);
}

void MinimumSnapSolver::Backpropagate(std::span<const double> by_coefficient, std::span<double> by_duration, std::span<Vec3d> by_waypoint) {
  Impl& impl = *impl_;
  const size_t segments = impl.durations.size();
  if (by_coefficient.size() != impl.coefficients.size() || by_duration.size() != segments ||
      (!by_waypoint.empty() && by_waypoint.size() != segments + 1)) {
    Fail("sizes of the gradients do not agree with the solution");
  }
  double* const waypoints = impl.waypoint_gradient.Reserve(4 * (segments + 1));
  impl.adjoints->adjoint[static_cast<int>(impl.kind)](
      {.route = impl.Arguments(), .by_coefficient = by_coefficient.data(), .by_duration = by_duration.data(), .by_waypoint = waypoints});
  for (size_t k = 0; k < by_waypoint.size(); ++k) {
    by_waypoint[k] = {waypoints[4 * k], waypoints[4 * k + 1], waypoints[4 * k + 2]};
  }
}

void MinimumSnapSolver::CostGradient(std::span<double> by_duration, std::span<Vec3d> by_waypoint) {
  Impl& impl = *impl_;
  const size_t segments = impl.durations.size();
  if ((!by_duration.empty() && by_duration.size() != segments) || (!by_waypoint.empty() && by_waypoint.size() != segments + 1)) {
    Fail("sizes of the gradients do not agree with the solution");
  }
  if (impl.kind != SplineKind::kPaperQuintic) return impl.OptimumGradient(by_duration, by_waypoint);
  impl.CostPartials();
  Backpropagate(impl.cost_gradient, impl.direct, by_waypoint);
  std::copy(impl.direct.begin(), impl.direct.begin() + static_cast<ptrdiff_t>(by_duration.size()), by_duration.begin());
}

PolynomialTrajectory SolveMinimumSnap(const MinimumSnapProblem& problem) {
  MinimumSnapSolver solver;
  solver.Solve(problem);
  return solver.Trajectory();
}

void SolveMinimumSnapBatch(std::span<const Vec3d> waypoints, std::span<const double> durations, size_t routes, SplineKind kind,
                           std::span<double> coefficients) {
  const size_t segments = routes == 0 ? 0 : durations.size() / routes;
  const size_t size = segments * 3 * static_cast<size_t>(PowersOf(kind));
  if (durations.size() != routes * segments || waypoints.size() != routes * (segments + 1) || coefficients.size() != routes * size) {
    Fail("sizes of the batch do not agree");
  }
  if (routes == 0) return;
  CheckCounts(segments + 1, segments);
  const CheckKernels& checks = *AIRSIM360_SELECT_KERNEL(kCheckKernels);
  const BatchKernels* const kernels = AIRSIM360_SELECT_KERNEL(kBatchKernels);
  static thread_local AlignedBuffer workspace;
  BatchCheck check;
  BatchArguments arguments = {};
  arguments.check = &check;
  arguments.stride = 3;
  arguments.segments = segments;
  arguments.workspace = workspace.Reserve(BatchWorkspace(segments));
  std::vector<size_t> uneven;
  for (size_t first = 0; first < routes; first += 8) {
    // Also behind the end: portions of a batch usually follow each other.
    arguments.next_waypoints = reinterpret_cast<uintptr_t>(waypoints.data()) + (first + 8) * (segments + 1) * sizeof(Vec3d);
    arguments.next_durations = reinterpret_cast<uintptr_t>(durations.data()) + (first + 8) * segments * sizeof(double);
    for (size_t lane = 0; lane < 8; ++lane) {
      // Lanes beyond the last route repeat it: they write the same numbers once more.
      const size_t route = std::min(first + lane, routes - 1);
      arguments.waypoints[lane] = &waypoints[route * (segments + 1)].x;
      arguments.durations[lane] = &durations[route * segments];
      arguments.coefficients[lane] = &coefficients[route * size];
    }
    kernels->batch[static_cast<int>(kind)](arguments);
    if (check.plain && segments > 1) continue;
    for (size_t lane = 0; lane < std::min<size_t>(8, routes - first); ++lane) {
      const double least = check.least[lane], largest = check.largest[lane];
      if (!(least > 0 && largest - largest == 0 && check.reach[lane] - check.reach[lane] == 0)) {
        FailOnNumbers(checks, waypoints, durations);
      }
      if (segments == 1 || least < kShortestDuration || largest > kLongestDuration ||
          (largest > kEvenRatio * least && (segments <= kFewSegments || checks.any_uneven(arguments.durations[lane], segments)))) {
        uneven.push_back(first + lane);
      }
    }
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

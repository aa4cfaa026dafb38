#include "airsim360/planning/minimum_snap.h"

#include <cmath>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/planning/spline_filter.h"

namespace airsim360 {
namespace {

using namespace internal;

void CheckVector(Vec3d v, const std::string& what) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(v[axis])) throw InputError("minimum snap: " + what + " is not finite");
  }
}

void CheckProblem(const MinimumSnapProblem& problem) {
  const size_t segments = problem.durations.size();
  if (problem.waypoints.size() < 2) {
    throw InputError("minimum snap: " + std::to_string(problem.waypoints.size()) +
                     " waypoints, at least 2 are needed");
  }
  if (segments + 1 != problem.waypoints.size()) {
    throw InputError("minimum snap: " + std::to_string(problem.waypoints.size()) + " waypoints need " +
                     std::to_string(problem.waypoints.size() - 1) + " durations, not " +
                     std::to_string(segments));
  }
  for (size_t i = 0; i < segments; ++i) {
    const double duration = problem.durations[i];
    if (!(duration > 0) || !std::isfinite(duration)) {
      throw InputError("minimum snap: duration " + std::to_string(i) + " is " + std::to_string(duration) +
                       " s, must be positive and finite");
    }
  }
  for (size_t i = 0; i <= segments; ++i) CheckVector(problem.waypoints[i], "waypoint " + std::to_string(i));
  for (const BoundaryDerivatives* end : {&problem.start, &problem.end}) {
    CheckVector(end->v, "end velocity");
    CheckVector(end->a, "end acceleration");
    CheckVector(end->jerk, "end jerk");
  }
}

/// Derivative i + 1 of one axis at an end, in units of a segment.
double EndState(const BoundaryDerivatives& end, int axis, int i, double duration) {
  const double value = i == 0 ? end.v[axis] : i == 1 ? end.a[axis] : end.jerk[axis];
  double power = duration;
  for (int k = 0; k < i; ++k) power *= duration;
  return value * power;
}

/// x = A^-1 b by LDL^T, A symmetric positive definite of n <= 3 rows, packed by Packed().
template <int D>
void SolveSymmetric(const double* a, int n, double* b) {
  double l[D][D] = {}, d[D];
  for (int j = 0; j < n; ++j) {
    d[j] = a[Packed(j + 1, j + 1, D)];
    for (int k = 0; k < j; ++k) d[j] -= l[j][k] * l[j][k] * d[k];
    for (int i = j + 1; i < n; ++i) {
      double sum = a[Packed(j + 1, i + 1, D)];
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k] * d[k];
      l[i][j] = sum / d[j];
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= l[i][k] * b[k];
  }
  for (int i = n; i-- > 0;) {
    b[i] /= d[i];
    for (int k = i + 1; k < n; ++k) b[i] -= l[k][i] * b[k];
  }
}

}  // namespace

struct MinimumSnapSolver::Impl {
  SplineKind kind = SplineKind::kMinimumSnap;
  std::vector<Vec3d> waypoints;
  std::vector<double> durations, coefficients;

  template <class Model>
  void Solve(const MinimumSnapProblem& problem, bool free);
};

template <class Model>
void MinimumSnapSolver::Impl::Solve(const MinimumSnapProblem& problem, bool free) {
  constexpr int D = Model::kStates, kPowers = Model::kDegree + 1;
  const size_t segments = durations.size();
  std::vector<SegmentRecord<double, 3, D>> records(segments);
  KnotBelief<double, 3, D> belief = {};
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < D; ++i) {
      belief.mean[axis][i] = free && i == D - 1 ? 0 : EndState(problem.start, axis, i, durations[0]);
    }
  }
  for (size_t k = 0; k < segments; ++k) {
    SegmentRecord<double, 3, D>& record = records[k];
    record.start = belief;
    if (free && k == 0) {
      StepFreeCovariance<double, Model>(record, belief);
    } else {
      StepCovariance<double, Model>(record, belief);
    }
    const double from[3] = {waypoints[k].x, waypoints[k].y, waypoints[k].z};
    const double to[3] = {waypoints[k + 1].x, waypoints[k + 1].y, waypoints[k + 1].z};
    StepMean<double, Model>(from, to, record, belief);
    if (k + 1 < segments) {
      ChangeUnits(durations[k + 1] / durations[k], durations[k] / durations[k + 1], belief);
    }
  }
  double after[3][D] = {};
  for (int axis = 0; axis < 3; ++axis) {
    const int n = free ? D - 1 : D;
    for (int i = 0; i < n; ++i) {
      after[axis][i] = belief.mean[axis][i] - EndState(problem.end, axis, i, durations[segments - 1]);
    }
    SolveSymmetric<D>(belief.covariance, n, after[axis]);
  }
  for (size_t k = segments; k-- > 0;) {
    const double inverse = 1 / durations[k];
    for (int axis = 0; axis < 3; ++axis) {
      const Costate<double, D> end = EndCostate(records[k], axis, after[axis]);
      const Costate<double, D> start = StartCostate<double>(end);
      double c[kPowers];
      c[0] = waypoints[k][axis];
      SmoothStart(records[k].start, axis, start, c + 1);
      HighCoefficients<double, Model, false>(Model::kIsLinear ? end : start, c + D + 1);
      for (int i = 2; i <= D; ++i) c[i] /= Factorial<double>(i);
      if (free && k == 0) {
        double rest = waypoints[k + 1][axis] - waypoints[k][axis];
        for (int i = 1; i < kPowers; ++i) rest -= i == D ? 0 : c[i];
        c[D] = rest;
      }
      double power = 1;
      for (int i = 0; i < kPowers; ++i, power *= inverse) {
        coefficients[(k * 3 + static_cast<size_t>(axis)) * kPowers + static_cast<size_t>(i)] = c[i] * power;
      }
      for (int i = 1; i <= D; ++i) after[axis][i - 1] = start.at[i];
      if (k > 0) ChangeCostateUnits<double, D>(durations[k - 1] / durations[k], after[axis]);
    }
  }
}

MinimumSnapSolver::MinimumSnapSolver() : impl_(std::make_unique<Impl>()) {}
MinimumSnapSolver::~MinimumSnapSolver() = default;
MinimumSnapSolver::MinimumSnapSolver(MinimumSnapSolver&&) noexcept = default;
MinimumSnapSolver& MinimumSnapSolver::operator=(MinimumSnapSolver&&) noexcept = default;

void MinimumSnapSolver::Solve(const MinimumSnapProblem& problem) {
  CheckProblem(problem);
  impl_->kind = problem.kind;
  impl_->waypoints.assign(problem.waypoints.begin(), problem.waypoints.end());
  impl_->durations.assign(problem.durations.begin(), problem.durations.end());
  impl_->coefficients.resize(impl_->durations.size() * 3 * static_cast<size_t>(PowersOf(problem.kind)));
  switch (problem.kind) {
    case SplineKind::kMinimumSnap:
      return impl_->Solve<SnapModel>(problem, problem.free_jerk);
    case SplineKind::kPaperQuintic:
      return impl_->Solve<QuinticModel>(problem, true);
    case SplineKind::kMinimumJerk:
      return impl_->Solve<JerkModel>(problem, false);
  }
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
    throw InputError("minimum snap: sizes of the batch do not agree");
  }
  MinimumSnapSolver solver;
  for (size_t i = 0; i < routes; ++i) {
    solver.Solve({.waypoints = waypoints.subspan(i * (segments + 1), segments + 1),
                  .durations = durations.subspan(i * segments, segments),
                  .kind = kind});
    std::copy(solver.coefficients().begin(), solver.coefficients().end(),
              coefficients.begin() + static_cast<ptrdiff_t>(i * size));
  }
}

}  // namespace airsim360

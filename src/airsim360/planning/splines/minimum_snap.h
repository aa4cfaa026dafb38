// The smoothest path through waypoints at given times: unique minimum of the integral of squared snap (or
// jerk), found in O(segments). Mathematics: docs/internals/trajectories.md.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "airsim360/math/vector.h"
#include "airsim360/planning/splines/polynomial_trajectory.h"

namespace airsim360 {

enum class SplineKind {
  kMinimumSnap,   ///< degree 7, C6: the true minimum of squared snap
  kPaperQuintic,  ///< degree 5, C3, least squared snap of that class; end velocity and acceleration given,
                  ///< jerk free; snap jumps at waypoints
  kMinimumJerk,   ///< degree 5, C4: the true minimum of squared jerk
};

/// What is prescribed at an end besides its position: m/s, m/s^2, m/s^3.
struct BoundaryDerivatives {
  Vec3d v, a, jerk;
};

/// Views only: the arrays must live while the problem is solved.
struct MinimumSnapProblem {
  std::span<const Vec3d> waypoints;   ///< metres in W, at least two
  std::span<const double> durations;  ///< seconds, positive, one fewer than waypoints
  BoundaryDerivatives start = {}, end = {};
  SplineKind kind = SplineKind::kMinimumSnap;
  bool free_jerk = false;  ///< kMinimumSnap: jerk at both ends is free (then snap is zero there)
  /// Places with very uneven durations are solved again in wide arithmetic; false leaves them at double
  /// precision, for the inner loop of an optimisation.
  bool refine = true;
};

/// Solves one problem after another without allocating once its buffers have grown. Not thread-safe.
class MinimumSnapSolver {
 public:
  MinimumSnapSolver();
  ~MinimumSnapSolver();
  MinimumSnapSolver(MinimumSnapSolver&&) noexcept;
  MinimumSnapSolver& operator=(MinimumSnapSolver&&) noexcept;

  /// InputError for fewer than two waypoints, counts that disagree, numbers that are not finite, durations
  /// that are not positive, coefficients out of the range of double precision (only looked for at uneven
  /// durations and with `refine`). Equal neighbouring waypoints are fine here: a loop through a point is a
  /// valid path. After an error there is no last solution.
  void Solve(const MinimumSnapProblem& problem);

  int degree() const;
  /// Of the last solution: ascending powers of local time, [segment][axis][power].
  std::span<const double> coefficients() const;
  /// Integral of squared snap (kMinimumJerk: jerk) of the last solution.
  double Cost() const;
  /// Derivatives of Cost() of the last solution with respect to every duration and every waypoint (first and
  /// last too). Either span may be empty.
  void CostGradient(std::span<double> by_duration, std::span<Vec3d> by_waypoint);
  /// For any function F(coefficients, durations) of the last solution: on entry `by_coefficient` = dF/dc at
  /// fixed durations (laid out like coefficients()) and `by_duration` = dF/dT at fixed coefficients; on
  /// return by_duration and by_waypoint hold the total derivatives of F with the coefficients following the
  /// optimum. `by_waypoint` may be empty.
  void Backpropagate(std::span<const double> by_coefficient, std::span<double> by_duration, std::span<Vec3d> by_waypoint);
  PolynomialTrajectory Trajectory() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// One problem, one answer. Errors as MinimumSnapSolver::Solve.
PolynomialTrajectory SolveMinimumSnap(const MinimumSnapProblem& problem);

/// Many routes with the same number of segments, `routes` of them: waypoints [route][waypoint], durations
/// [route][segment], coefficients [route][segment][axis][power] (written). Ends at rest (all prescribed
/// derivatives zero). Fastest in portions of 8 routes whose coefficients fit the caches. InputError as Solve,
/// naming the route.
void SolveMinimumSnapBatch(std::span<const Vec3d> waypoints, std::span<const double> durations, size_t routes, SplineKind kind,
                           std::span<double> coefficients);

/// Powers of one segment and axis: 8 for kMinimumSnap, else 6.
constexpr int PowersOf(SplineKind kind) { return kind == SplineKind::kMinimumSnap ? 8 : 6; }

}  // namespace airsim360

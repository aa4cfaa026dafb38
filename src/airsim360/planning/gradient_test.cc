#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/planning/splines/minimum_snap.h"
#include "airsim360/planning/splines/spline_test_internal.h"

namespace airsim360 {
namespace {

using internal::RandomRoute;
using internal::Route;

constexpr SplineKind kGradientKinds[] = {SplineKind::kMinimumSnap, SplineKind::kPaperQuintic, SplineKind::kMinimumJerk};

/// F of a route by a fixed smooth function of its coefficients and durations, with its partial derivatives.
struct Probe {
  std::vector<double> weights;

  double Value(const MinimumSnapSolver& solver, std::span<const double> durations) const {
    double sum = 0;
    ForEach(solver, durations, [&](size_t i, double g, double) { sum += weights[i] * g + 0.01 * g * g; });
    for (const double duration : durations) sum += std::sin(duration);
    return sum;
  }

  void Partials(const MinimumSnapSolver& solver, std::span<const double> durations, std::vector<double>& by_c,
                std::vector<double>& by_t) const {
    const size_t powers = static_cast<size_t>(solver.degree()) + 1;
    by_c.assign(solver.coefficients().size(), 0);
    by_t.clear();
    for (const double duration : durations) by_t.push_back(std::cos(duration));
    ForEach(solver, durations, [&](size_t i, double g, double power) {
      const double by_g = weights[i] + 0.02 * g;
      by_c[i] = by_g * power;
      by_t[i / (3 * powers)] += by_g * g * static_cast<double>(i % powers) / durations[i / (3 * powers)];
    });
  }

 private:
  /// visit(index, c_k T^k, T^k)
  template <class Visit>
  void ForEach(const MinimumSnapSolver& solver, std::span<const double> durations, Visit visit) const {
    const size_t powers = static_cast<size_t>(solver.degree()) + 1;
    for (size_t i = 0; i < solver.coefficients().size(); ++i) {
      const double power = std::pow(durations[i / (3 * powers)], static_cast<double>(i % powers));
      visit(i, solver.coefficients()[i] * power, power);
    }
  }
};

/// Central difference of f at x.
template <class F>
double Difference(double& x, double step, F f) {
  const double middle = x;
  x = middle + step;
  const double up = f();
  x = middle - step;
  const double down = f();
  x = middle;
  return (up - down) / (2 * step);
}

TEST(Gradients, BackpropagationEqualsFiniteDifferences) {
  for (const SplineKind kind : kGradientKinds) {
    for (const bool free_jerk : {false, true}) {
      for (const size_t segments : {1, 2, 3, 6, 9}) {
        Route route = RandomRoute(segments, 5 + segments, /*moving_ends=*/true);
        MinimumSnapSolver solver;
        solver.Solve(route.Problem(kind, free_jerk));
        RngStream random(2, "weights", segments);
        Probe probe;
        for (size_t i = 0; i < solver.coefficients().size(); ++i) probe.weights.push_back(random.Uniform(-1, 1));

        std::vector<double> by_c, by_t;
        probe.Partials(solver, route.durations, by_c, by_t);
        std::vector<Vec3d> by_w(segments + 1);
        solver.Backpropagate(by_c, by_t, by_w);
        const auto value = [&] {
          solver.Solve(route.Problem(kind, free_jerk));
          return probe.Value(solver, route.durations);
        };
        double scale = 1;
        for (const double g : by_t) scale = std::max(scale, std::abs(g));
        for (size_t i = 0; i < segments; ++i) {
          EXPECT_NEAR(Difference(route.durations[i], 1e-5, value), by_t[i], 1e-6 * scale)
              << "duration " << i << " of " << segments << ", kind " << static_cast<int>(kind) << free_jerk;
        }
        for (size_t i = 0; i <= segments; ++i) {
          EXPECT_NEAR(Difference(route.waypoints[i].y, 1e-4, value), by_w[i].y, 1e-6 * scale)
              << "waypoint " << i << " of " << segments << ", kind " << static_cast<int>(kind) << free_jerk;
        }
      }
    }
  }
}

TEST(Gradients, CostGradientEqualsTheHamiltonianAndTheJumpOfTheSeventhDerivative) {
  const Route route = RandomRoute(7, 3, true);
  MinimumSnapSolver solver;
  solver.Solve(route.Problem(SplineKind::kMinimumSnap, false));
  std::vector<double> by_t(7);
  std::vector<Vec3d> by_w(8);
  solver.CostGradient(by_t, by_w);
  const std::span<const double> c = solver.coefficients();
  for (size_t i = 0; i < 7; ++i) {
    // dJ/dT = -(p4^2 - 2 p3 p5 + 2 p2 p6 - 2 p1 p7), constant along the segment; here at its start.
    double hamiltonian = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double* k = &c[(3 * i + axis) * 8];
      hamiltonian += std::pow(24 * k[4], 2) - 2 * (6 * k[3]) * (120 * k[5]) + 2 * (2 * k[2]) * (720 * k[6]) - 2 * k[1] * (5040 * k[7]);
    }
    EXPECT_NEAR(by_t[i] / -hamiltonian, 1, 1e-8);
  }
  for (size_t i = 1; i < 7; ++i) {
    EXPECT_NEAR(by_w[i].x / (2 * 5040 * (c[24 * i + 7] - c[24 * (i - 1) + 7])), 1, 1e-8);
  }
}

TEST(Gradients, CostGradientEqualsFiniteDifferencesForAllKinds) {
  for (const SplineKind kind : kGradientKinds) {
    Route route = RandomRoute(5, 8, true);
    MinimumSnapSolver solver;
    solver.Solve(route.Problem(kind, false));
    std::vector<double> by_t(5);
    solver.CostGradient(by_t, {});
    for (size_t i = 0; i < 5; ++i) {
      const double difference = Difference(route.durations[i], 1e-5, [&] {
        solver.Solve(route.Problem(kind, false));
        return solver.Cost();
      });
      EXPECT_NEAR(difference / by_t[i], 1, 1e-5);
    }
  }
}

}  // namespace
}  // namespace airsim360

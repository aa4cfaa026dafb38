// Second methods and random routes for the tests of the splines.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/planning/splines/minimum_snap.h"
#include "airsim360/planning/splines/spline_wide.h"

namespace airsim360::internal {

struct Route {
  std::vector<Vec3d> waypoints;
  std::vector<double> durations;
  BoundaryDerivatives start, end;

  MinimumSnapProblem Problem(SplineKind kind, bool free_jerk) const {
    return {.waypoints = waypoints, .durations = durations, .start = start, .end = end, .kind = kind, .free_jerk = free_jerk};
  }
};

inline Vec3d RandomVector(RngStream& random, double size) {
  return {random.Uniform(-size, size), random.Uniform(-size, size), random.Uniform(-size, size)};
}

/// Waypoints in a cube of 32 m; durations as a flight of 3 m/s and 3 m/s^2 would take from stop to stop.
inline Route RandomRoute(size_t segments, uint64_t id, bool moving_ends) {
  RngStream random(1, "route", id);
  Route route;
  for (size_t i = 0; i <= segments; ++i) route.waypoints.push_back(RandomVector(random, 16));
  for (size_t i = 0; i < segments; ++i) {
    const double d = Norm(route.waypoints[i + 1] - route.waypoints[i]);
    route.durations.push_back(d > 3 ? d / 3 + 1 : 2 * std::sqrt(d / 3));
  }
  if (moving_ends) {
    for (BoundaryDerivatives* end : {&route.start, &route.end}) {
      *end = {RandomVector(random, 3), RandomVector(random, 2), RandomVector(random, 1)};
    }
  }
  return route;
}

/// Largest |c_k| T^k: the size of the terms of the polynomials, metres.
inline double LargestCoefficient(const PolynomialTrajectory& trajectory) {
  double largest = 0;
  for (size_t i = 0; i < trajectory.segments(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      double power = 1;
      for (const double c : trajectory.coefficients(i, axis)) {
        largest = std::max(largest, std::abs(c * power));
        power *= trajectory.durations()[i];
      }
    }
  }
  return largest;
}

inline double LargestDifference(const PolynomialTrajectory& a, const PolynomialTrajectory& b) {
  std::vector<double> difference(a.coefficients().begin(), a.coefficients().end());
  for (size_t i = 0; i < difference.size(); ++i) difference[i] -= b.coefficients()[i];
  return LargestCoefficient(PolynomialTrajectory(a.degree(), {a.durations().begin(), a.durations().end()}, difference));
}

/// The same smoother in 113-bit arithmetic, whatever the durations.
inline PolynomialTrajectory WideOptimum(const MinimumSnapProblem& problem) {
  std::vector<double> knots;
  for (const Vec3d& p : problem.waypoints) knots.insert(knots.end(), {p.x, p.y, p.z, 0});
  const bool free = problem.kind == SplineKind::kPaperQuintic || (problem.kind == SplineKind::kMinimumSnap && problem.free_jerk);
  double ends[2][12] = {};
  for (int side = 0; side < 2; ++side) {
    const BoundaryDerivatives& end = side == 0 ? problem.start : problem.end;
    for (int axis = 0; axis < 3; ++axis) {
      ends[side][axis] = end.v[axis];
      ends[side][4 + axis] = end.a[axis];
      ends[side][8 + axis] = end.jerk[axis];
    }
  }
  std::vector<double> coefficients(problem.durations.size() * 3 * static_cast<size_t>(PowersOf(problem.kind)));
  SolveRouteWide(problem.kind, {.knots = knots.data(),
                                .durations = problem.durations.data(),
                                .segments = problem.durations.size(),
                                .start = ends[0],
                                .end = ends[1],
                                .free_start = free,
                                .free_end = free,
                                .workspace = nullptr,
                                .coefficients = coefficients.data()});
  return PolynomialTrajectory(PowersOf(problem.kind) - 1, {problem.durations.begin(), problem.durations.end()}, coefficients);
}

/// x = A^-1 b by Gaussian elimination with partial pivoting; A row by row.
inline std::vector<double> DenseSolve(std::vector<std::vector<long double>> a, std::vector<long double> b) {
  const size_t n = b.size();
  for (size_t j = 0; j < n; ++j) {
    size_t pivot = j;
    for (size_t i = j; i < n; ++i) {
      if (std::abs(a[i][j]) > std::abs(a[pivot][j])) pivot = i;
    }
    std::swap(a[j], a[pivot]);
    std::swap(b[j], b[pivot]);
    for (size_t i = j + 1; i < n; ++i) {
      const long double f = a[i][j] / a[j][j];
      if (f == 0) continue;
      for (size_t k = j; k < n; ++k) a[i][k] -= f * a[j][k];
      b[i] -= f * b[j];
    }
  }
  std::vector<double> x(n);
  std::vector<long double> y(n);
  for (size_t i = n; i-- > 0;) {
    y[i] = b[i];
    for (size_t k = i + 1; k < n; ++k) y[i] -= a[i][k] * y[k];
    y[i] /= a[i][i];
    x[i] = static_cast<double>(y[i]);
  }
  return x;
}

/// Coefficients by the full optimality conditions of the quadratic programme over polynomial coefficients:
/// least integral of the squared derivative under interpolation, continuity and end conditions.
inline PolynomialTrajectory DenseOptimum(const MinimumSnapProblem& problem) {
  const int powers = PowersOf(problem.kind), order = problem.kind == SplineKind::kMinimumJerk ? 3 : 4;
  const bool free = problem.kind == SplineKind::kPaperQuintic || (problem.kind == SplineKind::kMinimumSnap && problem.free_jerk);
  const size_t segments = problem.durations.size(), unknowns = segments * static_cast<size_t>(powers);
  const int continuity = order - 1, clamped = free ? order - 2 : order - 1;
  std::vector<double> coefficients(unknowns * 3);
  // Falling factorial k (k - 1) ... of n factors: derivative n of tau^k is this times tau^(k - n).
  const auto falling = [](int k, int n) {
    long double product = 1;
    for (int i = 0; i < n; ++i) product *= k - i;
    return product;
  };
  for (int axis = 0; axis < 3; ++axis) {
    // Unknown: c_k T^k. Rows: derivative n at the start (tau = 0) or end (tau = 1) of a segment, in SI.
    std::vector<std::vector<long double>> rows;
    std::vector<long double> values;
    const auto add = [&](size_t segment, int n, bool at_end, long double sign, std::vector<long double>& row) {
      const long double unit = std::pow(static_cast<long double>(problem.durations[segment]), -n);
      for (int k = n; k < (at_end ? powers : n + 1); ++k) {
        row[segment * static_cast<size_t>(powers) + static_cast<size_t>(k)] += sign * unit * falling(k, n);
      }
    };
    const auto fix = [&](size_t segment, int n, bool at_end, double value) {
      std::vector<long double> row(unknowns);
      add(segment, n, at_end, 1, row);
      rows.push_back(row);
      values.push_back(value);
    };
    const auto given = [&](const BoundaryDerivatives& end, int n) { return n == 1 ? end.v[axis] : n == 2 ? end.a[axis] : end.jerk[axis]; };
    for (size_t i = 0; i < segments; ++i) {
      fix(i, 0, false, problem.waypoints[i][axis]);
      fix(i, 0, true, problem.waypoints[i + 1][axis]);
      for (int n = 1; i > 0 && n <= continuity; ++n) {
        std::vector<long double> row(unknowns);
        add(i - 1, n, true, 1, row);
        add(i, n, false, -1, row);
        rows.push_back(row);
        values.push_back(0);
      }
    }
    for (int n = 1; n <= clamped; ++n) {
      fix(0, n, false, given(problem.start, n));
      fix(segments - 1, n, true, given(problem.end, n));
    }
    const size_t size = unknowns + rows.size();
    std::vector<std::vector<long double>> a(size, std::vector<long double>(size));
    std::vector<long double> b(size);
    for (size_t i = 0; i < segments; ++i) {
      const long double unit = std::pow(static_cast<long double>(problem.durations[i]), 1 - 2 * order);
      const size_t at = i * static_cast<size_t>(powers);
      for (int j = order; j < powers; ++j) {
        for (int k = order; k < powers; ++k) {
          a[at + static_cast<size_t>(j)][at + static_cast<size_t>(k)] =
              unit * falling(j, order) * falling(k, order) / (j + k - 2 * order + 1);
        }
      }
    }
    for (size_t r = 0; r < rows.size(); ++r) {
      for (size_t k = 0; k < unknowns; ++k) a[unknowns + r][k] = a[k][unknowns + r] = rows[r][k];
      b[unknowns + r] = values[r];
    }
    const std::vector<double> x = DenseSolve(a, b);
    for (size_t i = 0; i < segments; ++i) {
      double power = 1;
      for (int k = 0; k < powers; ++k, power *= problem.durations[i]) {
        coefficients[(i * 3 + static_cast<size_t>(axis)) * static_cast<size_t>(powers) + static_cast<size_t>(k)] =
            x[i * static_cast<size_t>(powers) + static_cast<size_t>(k)] / power;
      }
    }
  }
  return PolynomialTrajectory(powers - 1, {problem.durations.begin(), problem.durations.end()}, coefficients);
}

}  // namespace airsim360::internal

#include "airsim360/planning/splines/minimum_snap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/planning/splines/spline_test_internal.h"

namespace airsim360 {
namespace {

using internal::DenseOptimum;
using internal::LargestCoefficient;
using internal::LargestDifference;
using internal::RandomRoute;
using internal::Route;

constexpr SplineKind kKinds[] = {SplineKind::kMinimumSnap, SplineKind::kPaperQuintic, SplineKind::kMinimumJerk};

struct ExactCost {
  std::vector<double> waypoints;
  double quintic, free_septic, septic;
};

// Exact rationals from the solution of the full optimality conditions in rational arithmetic.
const ExactCost kExactCosts[] = {
    {{0, 1}, 43200, 30240, 100800},
    {{0, 1, 2}, 21600.0 / 19, 945, 3150},
    {{0, 1, 0}, 60800.0 / 3, 193536.0 / 13, 32256},
    {{0, 1, 2, 3}, 7473600.0 / 1691, 1239840.0 / 359, 5342400.0 / 629},
};

double CostOf(const std::vector<double>& x, SplineKind kind, bool free_jerk) {
  std::vector<Vec3d> waypoints;
  for (double value : x) waypoints.push_back({value, 0, 0});
  const std::vector<double> durations(x.size() - 1, 1.0);
  MinimumSnapSolver solver;
  solver.Solve({.waypoints = waypoints, .durations = durations, .kind = kind, .free_jerk = free_jerk});
  return solver.Cost();
}

TEST(MinimumSnap, CostEqualsTheExactRationalValues) {
  for (const ExactCost& row : kExactCosts) {
    EXPECT_NEAR(CostOf(row.waypoints, SplineKind::kPaperQuintic, true) / row.quintic, 1, 1e-12);
    EXPECT_NEAR(CostOf(row.waypoints, SplineKind::kMinimumSnap, true) / row.free_septic, 1, 1e-12);
    EXPECT_NEAR(CostOf(row.waypoints, SplineKind::kMinimumSnap, false) / row.septic, 1, 1e-12);
  }
}

TEST(MinimumSnap, EqualsTheDenseOptimalityConditionsForAnyEnds) {
  for (const SplineKind kind : kKinds) {
    for (const bool free_jerk : {false, true}) {
      for (size_t segments = 1; segments <= 9; ++segments) {
        const Route route = RandomRoute(segments, 10 + segments, /*moving_ends=*/true);
        const MinimumSnapProblem problem = route.Problem(kind, free_jerk);
        const PolynomialTrajectory trajectory = SolveMinimumSnap(problem);
        // The dense elimination itself is good to about 1e-10.
        EXPECT_LT(LargestDifference(trajectory, DenseOptimum(problem)), 1e-8 * LargestCoefficient(trajectory))
            << "kind " << static_cast<int>(kind) << ", " << segments << " segments, free " << free_jerk;
      }
    }
  }
}

TEST(MinimumSnap, ReproducesAnyPolynomialOfItsDegree) {
  RngStream random(3, "polynomial");
  std::vector<double> c[3];
  for (auto& axis : c) {
    for (int k = 0; k < 8; ++k) axis.push_back(random.Uniform(-1, 1) / (1 << k));
  }
  const PolynomialTrajectory whole(7, {6.0}, [&] {
    std::vector<double> all;
    for (const auto& axis : c) all.insert(all.end(), axis.begin(), axis.end());
    return all;
  }());
  const std::vector<double> durations = {0.5, 1.5, 0.7, 1.3, 2.0};
  std::vector<Vec3d> waypoints = {whole.At(0).p};
  double t = 0;
  for (const double duration : durations) waypoints.push_back(whole.At(t += duration).p);
  const TrajectoryPoint first = whole.At(0), last = whole.At(6);
  const PolynomialTrajectory spline = SolveMinimumSnap(
      {.waypoints = waypoints, .durations = durations, .start = {first.v, first.a, first.jerk}, .end = {last.v, last.a, last.jerk}});
  for (int i = 0; i <= 600; ++i) {
    EXPECT_LT(Norm(spline.At(0.01 * i).p - whole.At(0.01 * i).p), 1e-11 * 3000);
    EXPECT_LT(Norm(spline.At(0.01 * i).snap - whole.At(0.01 * i).snap), 1e-9 * 3000);
  }
}

TEST(MinimumSnap, PassesThroughWaypointsWithinFourUlp) {
  for (const SplineKind kind : kKinds) {
    for (uint64_t id = 0; id < 50; ++id) {
      const Route route = RandomRoute(1 + id % 20, id, false);
      const PolynomialTrajectory trajectory = SolveMinimumSnap(route.Problem(kind, false));
      double scale = LargestCoefficient(trajectory);
      for (size_t k = 0; k < route.waypoints.size(); ++k) {
        const Vec3d error = trajectory.At(trajectory.start(k)).p - route.waypoints[k];
        // Ulp of the largest term of the polynomial: the last waypoint is a sum of such terms.
        for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(error[axis]), 4 * 0x1p-52 * scale);
      }
    }
  }
}

TEST(MinimumSnap, WaypointOnTheOptimumChangesNothing) {
  const std::vector<Vec3d> ends = {{0, 0, 0}, {2, 0, 0}}, all = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<double> one = {2}, two = {1, 1};
  const PolynomialTrajectory direct = SolveMinimumSnap({.waypoints = ends, .durations = one});
  const PolynomialTrajectory stopped = SolveMinimumSnap({.waypoints = all, .durations = two});
  for (int i = 0; i <= 20; ++i) {
    const TrajectoryPoint a = direct.At(0.1 * i), b = stopped.At(0.1 * i);
    EXPECT_NEAR(a.p.x, b.p.x, 1e-13);
    EXPECT_NEAR(a.v.x, b.v.x, 1e-12);
    EXPECT_NEAR(a.jerk.x, b.jerk.x, 1e-10);
  }
  const TrajectoryPoint middle = stopped.At(1);
  EXPECT_NEAR(middle.v.x, 35.0 / 16, 1e-13);
  EXPECT_NEAR(middle.jerk.x, -105.0 / 8, 1e-11);
}

TEST(MinimumSnap, MovesTurnsMirrorsAndStretchesWithItsWaypoints) {
  for (const SplineKind kind : kKinds) {
    for (uint64_t id = 0; id < 20; ++id) {
      Route route = RandomRoute(2 + id % 9, 40 + id, false);
      MinimumSnapSolver solver;
      solver.Solve(route.Problem(kind, false));
      const double cost = solver.Cost();
      const PolynomialTrajectory original = solver.Trajectory();
      const double scale = LargestCoefficient(original), half = 0.37 * original.duration();

      // Translation and rotation about the vertical by an angle with exact sine and cosine.
      Route moved = route;
      const auto move = [](Vec3d p) { return Vec3d{0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y, p.z}; };
      for (Vec3d& p : moved.waypoints) p = move(p) + Vec3d{5, -3, 2};
      solver.Solve(moved.Problem(kind, false));
      EXPECT_NEAR(solver.Cost() / cost, 1, 1e-10);
      EXPECT_LT(Norm(solver.Trajectory().At(half).p - (move(original.At(half).p) + Vec3d{5, -3, 2})), 1e-12 * scale);

      // Axes in another order give the same bits.
      Route permuted = route;
      for (Vec3d& p : permuted.waypoints) p = {p.z, p.x, p.y};
      solver.Solve(permuted.Problem(kind, false));
      EXPECT_EQ(solver.Trajectory().At(half).p.y, original.At(half).p.x);

      // Backwards in time.
      Route reversed = route;
      std::reverse(reversed.waypoints.begin(), reversed.waypoints.end());
      std::reverse(reversed.durations.begin(), reversed.durations.end());
      solver.Solve(reversed.Problem(kind, false));
      EXPECT_LT(Norm(solver.Trajectory().At(original.duration() - half).p - original.At(half).p), 1e-12 * scale);

      // Three times as slow: cost over 3^7, or 3^5 for jerk.
      Route slow = route;
      for (double& duration : slow.durations) duration *= 3;
      solver.Solve(slow.Problem(kind, false));
      EXPECT_NEAR(solver.Cost() * std::pow(3, kind == SplineKind::kMinimumJerk ? 5 : 7) / cost, 1, 1e-10);
    }
  }
}

TEST(MinimumSnap, InfluenceOfOneWaypointDecaysByTheEulerFrobeniusRoot) {
  std::vector<Vec3d> waypoints(41);
  const std::vector<double> durations(40, 1.0);
  waypoints[20].x = 1;
  const double root[] = {0.5352804307964, 0, 0.4305753470999738};
  for (const SplineKind kind : {SplineKind::kMinimumSnap, SplineKind::kMinimumJerk}) {
    const PolynomialTrajectory t = SolveMinimumSnap({.waypoints = waypoints, .durations = durations, .kind = kind});
    EXPECT_NEAR(-t.At(31).v.x / t.At(30).v.x, root[static_cast<int>(kind)], 1e-3);
  }
}

TEST(MinimumSnap, LongAndShortRoutesAgreeWithWideArithmetic) {
  for (const SplineKind kind : kKinds) {
    for (const size_t segments : {2, 3, 7, 10, 64, 65, 100, 127, 257, 1000, 1003, 2100}) {
      const Route route = RandomRoute(segments, segments, /*moving_ends=*/true);
      const MinimumSnapProblem problem = route.Problem(kind, false);
      const PolynomialTrajectory trajectory = SolveMinimumSnap(problem);
      EXPECT_LT(LargestDifference(trajectory, internal::WideOptimum(problem)), 1e-12 * LargestCoefficient(trajectory))
          << segments << " segments, kind " << static_cast<int>(kind);
    }
  }
}

TEST(MinimumSnap, RoutesAtRestOwnNothingToTheOneSolvedBefore) {
  MinimumSnapSolver solver;
  for (size_t segments = 2; segments <= 7; ++segments) {
    const Route moving = RandomRoute(segments, segments, /*moving_ends=*/true);
    solver.Solve(moving.Problem(SplineKind::kMinimumSnap, false));
    for (int repeat = 0; repeat < 2; ++repeat) {
      const MinimumSnapProblem rest = {.waypoints = moving.waypoints, .durations = moving.durations};
      solver.Solve(rest);
      const PolynomialTrajectory exact = internal::WideOptimum(rest);
      EXPECT_LT(LargestDifference(solver.Trajectory(), exact), 1e-12 * LargestCoefficient(exact)) << segments;
    }
  }
}

TEST(MinimumSnap, VeryUnevenTimesKeepTwelveDigits) {
  RngStream random(5, "uneven");
  for (int i = 0; i < 10; ++i) {
    Route route = RandomRoute(12, static_cast<uint64_t>(i), false);
    for (double& duration : route.durations) duration = 0.005 * std::pow(1e4, random.Uniform());
    const MinimumSnapProblem problem = route.Problem(SplineKind::kMinimumSnap, false);
    const PolynomialTrajectory trajectory = SolveMinimumSnap(problem);
    EXPECT_LT(LargestDifference(trajectory, internal::WideOptimum(problem)), 1e-12 * LargestCoefficient(trajectory));
  }
}

TEST(MinimumSnap, ShortRoutesKeepTwelveDigitsWithALongSegmentAnywhere) {
  RngStream random(7, "short uneven");
  for (int i = 0; i < 600; ++i) {
    Route route = RandomRoute(2 + static_cast<size_t>(i) % 4, static_cast<uint64_t>(i), i % 8 == 0);
    for (double& duration : route.durations) duration = 0.5 * std::pow(i % 3 == 0 ? 7.9 : 64, random.Uniform());
    const MinimumSnapProblem problem = route.Problem(SplineKind::kMinimumSnap, false);
    const PolynomialTrajectory trajectory = SolveMinimumSnap(problem);
    EXPECT_LT(LargestDifference(trajectory, internal::WideOptimum(problem)), 1e-12 * LargestCoefficient(trajectory));
  }
}

TEST(MinimumSnap, LongUnevenRoutesKeepTwelveDigits) {
  RngStream random(6, "long uneven");
  Route route = RandomRoute(1000, 1, true);
  for (double& duration : route.durations) duration = 0.05 * std::pow(100, random.Uniform());
  for (const SplineKind kind : {SplineKind::kMinimumSnap, SplineKind::kMinimumJerk}) {
    const MinimumSnapProblem problem = route.Problem(kind, false);
    const PolynomialTrajectory trajectory = SolveMinimumSnap(problem);
    EXPECT_LT(LargestDifference(trajectory, internal::WideOptimum(problem)), 1e-12 * LargestCoefficient(trajectory));
  }
}

TEST(MinimumSnap, BatchGivesEachRouteItsOwnSolution) {
  for (const SplineKind kind : kKinds) {
    for (const size_t segments : {1, 2, 10}) {
      constexpr size_t kRoutes = 11;  // not a multiple of the lanes
      std::vector<Vec3d> waypoints;
      std::vector<double> durations;
      for (size_t i = 0; i < kRoutes; ++i) {
        const Route route = RandomRoute(segments, 70 + i, false);
        waypoints.insert(waypoints.end(), route.waypoints.begin(), route.waypoints.end());
        durations.insert(durations.end(), route.durations.begin(), route.durations.end());
      }
      const size_t size = segments * 3 * static_cast<size_t>(PowersOf(kind));
      std::vector<double> coefficients(kRoutes * size);
      SolveMinimumSnapBatch(waypoints, durations, kRoutes, kind, coefficients);
      for (size_t i = 0; i < kRoutes; ++i) {
        const MinimumSnapProblem problem = {.waypoints = std::span(waypoints).subspan(i * (segments + 1), segments + 1),
                                            .durations = std::span(durations).subspan(i * segments, segments),
                                            .kind = kind};
        const PolynomialTrajectory batch(PowersOf(kind) - 1, {problem.durations.begin(), problem.durations.end()},
                                         {&coefficients[i * size], &coefficients[i * size] + size});
        EXPECT_LT(LargestDifference(batch, internal::WideOptimum(problem)), 2e-12 * LargestCoefficient(batch));
      }
    }
  }
}

TEST(MinimumSnap, AbsurdDurationsGiveAPathOrAnError) {
  size_t refused = 0;
  for (const double growth : {1e-30, 1e-6, 1e-3, 1e3, 1e6, 1e30, 1e120}) {
    for (size_t segments = 1; segments <= 40; segments += 3) {
      Route route = RandomRoute(segments, segments, false);
      for (size_t i = 0; i < segments; ++i) {
        route.durations[i] = std::max(1e-300, std::min(1e300, std::pow(growth, static_cast<double>(i) - 20)));
      }
      try {
        const PolynomialTrajectory path = SolveMinimumSnap(route.Problem(SplineKind::kMinimumSnap, false));
        for (const double c : path.coefficients()) ASSERT_TRUE(std::isfinite(c));
      } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("durations from"), std::string::npos) << error.what();
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 0u);
}

TEST(MinimumSnap, BadProblemsAreRefused) {
  const std::vector<Vec3d> one = {{0, 0, 0}}, two = {{0, 0, 0}, {1, 0, 0}}, bad = {{0, 0, 0}, {NAN, 0, 0}};
  const std::vector<double> none, good = {1}, zero = {0}, negative = {-1}, nan = {NAN}, endless = {INFINITY};
  EXPECT_THROW(SolveMinimumSnap({.waypoints = one, .durations = none}), InputError);
  EXPECT_THROW(SolveMinimumSnap({.waypoints = two, .durations = none}), InputError);
  EXPECT_THROW(SolveMinimumSnap({.waypoints = bad, .durations = good}), InputError);
  EXPECT_THROW(SolveMinimumSnap({.waypoints = two, .durations = good, .end = {{NAN, 0, 0}, {}, {}}}), InputError);
  for (const std::vector<double>& durations : {zero, negative, nan, endless}) {
    EXPECT_THROW(SolveMinimumSnap({.waypoints = two, .durations = durations}), InputError);
  }
}

}  // namespace
}  // namespace airsim360

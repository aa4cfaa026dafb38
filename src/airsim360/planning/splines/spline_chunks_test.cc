// Long routes in chunks against the same routes in one piece.
#include "airsim360/planning/splines/spline_chunks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "airsim360/planning/splines/aligned_buffer.h"
#include "airsim360/planning/splines/spline_test_internal.h"

namespace airsim360::internal {
namespace {

struct Problem {
  std::vector<double> knots, durations;
  double start[12] = {0.5, -1, 2, 0, 0.3, 0.1, -2, 0, 1, 0, -1, 0};
  double end[12] = {-3, 0.2, 1, 0, 0, 0.7, 0.4, 0, -2, 1, 0.5, 0};
};

/// Durations whose neighbours differ as much as they may without counting as uneven.
Problem RoughProblem(size_t segments, uint64_t seed) {
  Problem problem;
  const Route route = RandomRoute(segments, seed, false);
  for (const Vec3d& p : route.waypoints) problem.knots.insert(problem.knots.end(), {p.x, p.y, p.z, 0});
  for (size_t i = 0; i < segments; ++i) {
    const double t = route.durations[i];
    problem.durations.push_back(1 + 6.9 * (t * 1e3 - std::floor(t * 1e3)));
  }
  return problem;
}

template <class Solve>
std::vector<double> Coefficients(const Problem& problem, int kind, Solve&& solve) {
  const size_t segments = problem.durations.size();
  AlignedBuffer workspace;
  std::vector<double> out(segments * 3 * (kind == 0 ? 8 : 6), NAN);
  solve(RouteArguments{.knots = problem.knots.data(),
                       .durations = problem.durations.data(),
                       .segments = segments,
                       .start = problem.start,
                       .end = problem.end,
                       .free_start = false,
                       .free_end = false,
                       .workspace = workspace.Reserve(std::max(RouteWorkspace(segments), ChunkWorkspace())),
                       .coefficients = out.data()});
  return out;
}

std::vector<double> InChunks(const Problem& problem, int kind, const BatchKernels& kernels) {
  return Coefficients(problem, kind,
                      [&](const RouteArguments& route) { EXPECT_TRUE(SolveRouteInChunks(static_cast<SplineKind>(kind), kernels, route)); });
}

/// Largest difference of c_k T^k, over the largest c_k T^k.
double Difference(const Problem& problem, const std::vector<double>& a, const std::vector<double>& b) {
  const size_t powers = a.size() / problem.durations.size() / 3;
  double difference = 0, scale = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double unit = std::pow(problem.durations[i / (3 * powers)], static_cast<double>(i % powers));
    if (!std::isfinite(a[i])) return INFINITY;
    difference = std::max(difference, std::abs(a[i] - b[i]) * unit);
    scale = std::max(scale, std::abs(b[i]) * unit);
  }
  return difference / scale;
}

TEST(SplineChunks, AgreeWithOnePiece) {
  // One window, one more than fills it, several.
  for (const size_t segments : {512, 777, 2048, 2049, 5000}) {
    for (const int kind : {0, 2}) {
      const Problem problem = RoughProblem(segments, segments);
      const auto whole = Coefficients(problem, kind, AIRSIM360_SELECT_KERNEL(kSplineKernels)->route[kind]);
      const auto chunks = InChunks(problem, kind, *AIRSIM360_SELECT_KERNEL(kBatchKernels));
      EXPECT_LT(Difference(problem, chunks, whole), 1e-11) << segments << " segments, kind " << kind;
    }
  }
}

TEST(SplineChunks, KeepTwelveDigitsAgainstWideArithmetic) {
  for (const int kind : {0, 2}) {
    Problem problem = RoughProblem(900, 5);
    for (const bool even : {false, true}) {
      if (even) problem.durations.assign(900, 2.5);
      const auto wide =
          Coefficients(problem, kind, [&](const RouteArguments& route) { SolveRouteWide(static_cast<SplineKind>(kind), route); });
      const auto chunks = InChunks(problem, kind, *AIRSIM360_SELECT_KERNEL(kBatchKernels));
      EXPECT_LT(Difference(problem, chunks, wide), 1e-12) << "kind " << kind << ", even " << even;
    }
  }
}

TEST(SplineChunks, RefusedWhereInfluenceDoesNotDecay) {
  // Growing by a third per segment: derivatives in units of the duration are forgotten too slowly.
  Problem problem = RoughProblem(900, 6);
  for (size_t i = 0; i < 900; ++i) {
    const size_t phase = i % 120;
    problem.durations[i] = std::pow(1.3, phase < 60 ? phase : 120 - phase);
  }
  for (const int kind : {0, 2}) {
    Coefficients(problem, kind, [&](const RouteArguments& route) {
      EXPECT_FALSE(SolveRouteInChunks(static_cast<SplineKind>(kind), *AIRSIM360_SELECT_KERNEL(kBatchKernels), route));
    });
  }
  // The solver then takes the route in one piece.
  Route route = RandomRoute(900, 6, false);
  route.durations = problem.durations;
  const MinimumSnapProblem whole = route.Problem(SplineKind::kMinimumSnap, false);
  const PolynomialTrajectory wide = WideOptimum(whole);
  EXPECT_LT(LargestDifference(SolveMinimumSnap(whole), wide), 1e-11 * LargestCoefficient(wide));
}

TEST(SplineChunks, InstructionSetsAgreeBitForBit) {
  const Problem problem = RoughProblem(600, 9);
  for (const int kind : {0, 2}) {
    const auto base = InChunks(problem, kind, isa_sse42::kBatchKernels);
    const auto same = [&](const BatchKernels& kernels) {
      const auto values = InChunks(problem, kind, kernels);
      return std::memcmp(values.data(), base.data(), base.size() * sizeof(double)) == 0;
    };
    const KernelIsa best = CurrentKernelIsa();
    EXPECT_TRUE(best < KernelIsa::kAvx2 || same(isa_avx2::kBatchKernels));
    EXPECT_TRUE(best < KernelIsa::kAvx512 || same(isa_avx512::kBatchKernels));
  }
}

}  // namespace
}  // namespace airsim360::internal

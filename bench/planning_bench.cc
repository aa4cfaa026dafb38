// Minimum snap, gradients, certified peaks and time allocation: our own times. Peers were measured beside
// this library by programs that are not kept (docs/internals/benchmarks/trajectories.md has the figures and the commits). Usage:
// planning_bench [--long] (--long: also 100,000 segments)
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/planning/splines/minimum_snap.h"
#include "airsim360/planning/splines/time_allocation.h"
#include "clock.h"

using namespace airsim360;

namespace {

constexpr int kRounds = 21;

double Microseconds() { return 1e6 * SecondsOf(CLOCK_THREAD_CPUTIME_ID); }

/// Median over rounds of the time of one call.
template <class F>
double Median(int calls, F call) {
  std::vector<double> times;
  for (int round = 0; round < kRounds; ++round) {
    const double begin = Microseconds();
    for (int i = 0; i < calls; ++i) call(i);
    times.push_back((Microseconds() - begin) / calls);
  }
  std::nth_element(times.begin(), times.begin() + kRounds / 2, times.end());
  return times[kRounds / 2];
}

struct Route {
  std::vector<Vec3d> waypoints;
  std::vector<double> durations;
};

/// Waypoints in a cube of 32 m, durations from stop to stop at 3 m/s and 3 m/s^2.
Route RandomRoute(size_t segments, uint64_t id) {
  RngStream random(1, "bench", id);
  Route route;
  for (size_t i = 0; i <= segments; ++i) {
    route.waypoints.push_back({random.Uniform(-16, 16), random.Uniform(-16, 16), random.Uniform(-16, 16)});
  }
  for (size_t i = 0; i < segments; ++i) {
    route.durations.push_back(RestToRestTime(Norm(route.waypoints[i + 1] - route.waypoints[i]), 3, 3));
  }
  return route;
}

void Solves(size_t segments) {
  std::vector<Route> routes;
  for (uint64_t i = 0; i < (segments > 10000 ? 1 : 16); ++i) routes.push_back(RandomRoute(segments, i));
  const int calls = static_cast<int>(std::max<size_t>(1, 20000 / segments));
  MinimumSnapSolver solver;
  std::vector<double> by_t(segments), by_c;
  double sink = 0;
  const auto solve = [&](int i, SplineKind kind) {
    const Route& route = routes[static_cast<size_t>(i) % routes.size()];
    solver.Solve({.waypoints = route.waypoints, .durations = route.durations, .kind = kind});
    sink += solver.coefficients()[1];
  };
  const double snap = Median(calls, [&](int i) { solve(i, SplineKind::kMinimumSnap); });
  const double quintic = Median(calls, [&](int i) { solve(i, SplineKind::kPaperQuintic); });
  const double jerk = Median(calls, [&](int i) { solve(i, SplineKind::kMinimumJerk); });
  solve(0, SplineKind::kMinimumSnap);
  by_c.assign(solver.coefficients().begin(), solver.coefficients().end());
  std::vector<Vec3d> by_w(segments + 1);
  const double gradient = Median(calls, [&](int i) {
    solve(i, SplineKind::kMinimumSnap);
    std::fill(by_t.begin(), by_t.end(), 0.0);
    solver.Backpropagate(by_c, by_t, by_w);
  });
  std::vector<PolynomialTrajectory> paths;
  for (const Route& route : routes) {
    paths.push_back(SolveMinimumSnap({.waypoints = route.waypoints, .durations = route.durations}));
  }
  const double peaks = Median(calls, [&](int i) { sink += CertifiedPeaks(paths[static_cast<size_t>(i) % paths.size()]).speed.value; });
  std::printf("%7zu segments: snap %.3f  quintic %.3f  jerk %.3f  snap + adjoint %.3f  peaks %.3f us%s\n", segments, snap, quintic, jerk,
              gradient, peaks, sink == 0.5 ? "!" : "");
}

void Batch() {
  constexpr size_t kRoutes = 100'000, kSegments = 10, kPortion = 8;
  std::vector<Vec3d> waypoints;
  std::vector<double> durations, coefficients(kPortion * kSegments * 24);
  for (uint64_t i = 0; i < kRoutes; ++i) {
    const Route route = RandomRoute(kSegments, i);
    waypoints.insert(waypoints.end(), route.waypoints.begin(), route.waypoints.end());
    durations.insert(durations.end(), route.durations.begin(), route.durations.end());
  }
  const double time = Median(1, [&](int) {
    for (size_t i = 0; i < kRoutes; i += kPortion) {
      SolveMinimumSnapBatch(std::span(waypoints).subspan(i * (kSegments + 1), kPortion * (kSegments + 1)),
                            std::span(durations).subspan(i * kSegments, kPortion * kSegments), kPortion, SplineKind::kMinimumSnap,
                            coefficients);
    }
  });
  std::printf("batch of 10-segment routes: %.3f us a route\n", time / kRoutes);
}

void Allocation(size_t segments) {
  std::vector<Route> routes;
  for (uint64_t i = 0; i < 8; ++i) routes.push_back(RandomRoute(segments, 100 + i));
  double duration = 0, plain = 0;
  const TrajectoryLimits limits = {.speed = 16, .acceleration = 3};
  const double time =
      Median(8, [&](int i) { duration += AllocateTimes(routes[static_cast<size_t>(i)].waypoints, limits).trajectory.duration(); });
  for (const Route& route : routes) {
    plain += AllocateTimes(route.waypoints, limits, {.optimise = false}).trajectory.duration();
  }
  std::printf("allocation, %zu segments: %.0f us, flight %.2f s (trapezoids %.2f s)\n", segments, time, duration / (8 * kRounds),
              plain / 8);
}

}  // namespace

int main(int argc, char** argv) {
  for (const size_t segments : {2, 5, 10, 100, 1000}) Solves(segments);
  if (argc > 1 && std::string(argv[1]) == "--long") Solves(100000);
  Batch();
  for (const size_t segments : {2, 10, 50}) Allocation(segments);
  return 0;
}

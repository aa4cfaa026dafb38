#include "airsim360/planning/minimum_snap.h"

#include <gtest/gtest.h>

namespace airsim360 {
namespace {

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

}  // namespace
}  // namespace airsim360

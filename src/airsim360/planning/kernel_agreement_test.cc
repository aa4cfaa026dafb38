// The copies of the kernels for different instruction sets give the same bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "airsim360/planning/splines/aligned_buffer.h"
#include "airsim360/planning/splines/excess_kernel.h"
#include "airsim360/planning/splines/hull_kernel.h"
#include "airsim360/planning/splines/spline_kernel.h"
#include "airsim360/planning/splines/spline_test_internal.h"

namespace airsim360::internal {
namespace {

struct Kernels {
  const SplineKernels* spline;
  const BatchKernels* batch;
  const AdjointKernels* adjoint;
  const ExcessKernels* excess;
  const HullKernels* hull;
};

const Kernels kSse42 = {&isa_sse42::kSplineKernels, &isa_sse42::kBatchKernels, &isa_sse42::kAdjointKernels, &isa_sse42::kExcessKernels,
                        &isa_sse42::kHullKernels};
const Kernels kAvx2 = {&isa_avx2::kSplineKernels, &isa_avx2::kBatchKernels, &isa_avx2::kAdjointKernels, &isa_avx2::kExcessKernels,
                       &isa_avx2::kHullKernels};
const Kernels kAvx512 = {&isa_avx512::kSplineKernels, &isa_avx512::kBatchKernels, &isa_avx512::kAdjointKernels, &isa_avx512::kExcessKernels,
                         &isa_avx512::kHullKernels};

/// Everything the kernels compute for one route and kind.
std::vector<double> Results(const Kernels& kernels, const Route& route, int kind) {
  const size_t segments = route.durations.size(), powers = kind == 0 ? 8 : 6;
  std::vector<double> knots, flat, coefficients(segments * 3 * powers);
  for (const Vec3d& p : route.waypoints) {
    knots.insert(knots.end(), {p.x, p.y, p.z, 0});
    flat.insert(flat.end(), {p.x, p.y, p.z});
  }
  const double rest[12] = {};
  AlignedBuffer workspace;
  workspace.Reserve(RouteWorkspace(segments) + AdjointWorkspace(segments) + BatchWorkspace(segments));
  const RouteArguments arguments = {.knots = knots.data(),
                                    .durations = route.durations.data(),
                                    .segments = segments,
                                    .start = rest,
                                    .end = rest,
                                    .free_start = kind == 1,
                                    .free_end = kind == 1,
                                    .workspace = workspace.data(),
                                    .coefficients = coefficients.data()};
  kernels.spline->route[kind](arguments);
  std::vector<double> all = coefficients;
  if (kind == 0 && segments <= kFewSegments) {
    std::vector<double> few(coefficients.size());
    const NumberCheck check =
        kernels.spline->few[segments - 2](flat.data(), route.durations.data(), knots.data(), workspace.data(), few.data());
    EXPECT_TRUE(check.valid);
    all.insert(all.end(), few.begin(), few.end());
  }

  BatchCheck check;
  BatchArguments batch = {};
  batch.stride = 3;
  batch.segments = segments;
  batch.workspace = workspace.data();
  batch.check = &check;
  std::vector<double> eight(8 * coefficients.size());
  for (size_t lane = 0; lane < 8; ++lane) {
    batch.waypoints[lane] = flat.data();
    batch.durations[lane] = route.durations.data();
    batch.coefficients[lane] = &eight[lane * coefficients.size()];
  }
  kernels.batch->batch[kind](batch);
  EXPECT_EQ(check.least[7], *std::ranges::min_element(route.durations));
  EXPECT_EQ(check.largest[7], *std::ranges::max_element(route.durations));
  EXPECT_EQ(check.plain, check.largest[7] <= kEvenRatio * check.least[7]);
  all.insert(all.end(), check.reach, check.reach + 8);
  all.insert(all.end(), eight.begin(), eight.end());

  std::vector<double> by_c(coefficients.size()), by_t(segments), by_w(4 * (segments + 1)), basis(8 * 16 * 8, 0.25);
  double excess[3];
  for (const size_t share : {4, 2, 1}) {
    excess[share / 2] = kernels.excess->excess({.coefficients = coefficients.data(),
                                                .durations = route.durations.data(),
                                                .segments = segments,
                                                .powers = static_cast<int>(powers),
                                                .basis = basis.data(),
                                                .samples = 8,
                                                .share = share,
                                                .squarings = 3,
                                                .inverse_speed = 0.1,
                                                .inverse_acceleration = 0.2,
                                                .weight = 0.01,
                                                .by_coefficient = by_c.data(),
                                                .by_duration = by_t.data()});
    all.push_back(excess[share / 2]);
    all.insert(all.end(), by_c.begin(), by_c.end());
  }
  // The same samples, differently added up.
  EXPECT_NEAR(excess[1] / excess[0], 1, 1e-12);
  EXPECT_NEAR(excess[2] / excess[0], 1, 1e-12);
  kernels.adjoint->adjoint[kind](
      {.route = arguments, .by_coefficient = by_c.data(), .by_duration = by_t.data(), .by_waypoint = by_w.data()});
  all.insert(all.end(), by_t.begin(), by_t.end());
  all.insert(all.end(), by_w.begin(), by_w.end());

  const size_t groups = (segments + 7) / 8;
  std::vector<double> hull(groups * 8 * (2 + kSpeedControls + kAccelerationControls));
  double* const controls = &hull[groups * 16];
  kernels.hull->hulls({.coefficients = coefficients.data(),
                       .durations = route.durations.data(),
                       .segments = segments,
                       .powers = static_cast<int>(powers),
                       .speed_bounds = hull.data(),
                       .acceleration_bounds = &hull[groups * 8],
                       .speed_controls = controls,
                       .acceleration_controls = controls + groups * 8 * kSpeedControls});
  all.insert(all.end(), hull.begin(), hull.end());
  return all;
}

TEST(PlanningKernels, InstructionSetsAgreeBitForBit) {
  for (int kind = 0; kind < kSplineKinds; ++kind) {
    for (const size_t segments : {2, 3, 4, 5, 10, 77}) {
      const Route route = RandomRoute(segments, segments, false);
      const std::vector<double> base = Results(kSse42, route, kind);
      const KernelIsa best = CurrentKernelIsa();
      for (const Kernels* other : {&kAvx2, &kAvx512}) {
        if (other == &kAvx2 && best < KernelIsa::kAvx2) continue;
        if (other == &kAvx512 && best < KernelIsa::kAvx512) continue;
        const std::vector<double> values = Results(*other, route, kind);
        ASSERT_EQ(values.size(), base.size());
        EXPECT_EQ(std::memcmp(values.data(), base.data(), values.size() * sizeof(double)), 0)
            << "kind " << kind << ", " << segments << " segments";
      }
    }
  }
}

}  // namespace
}  // namespace airsim360::internal

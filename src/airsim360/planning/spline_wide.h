// The same solution as the kernels, in wider arithmetic: for single segments and very uneven durations.
#pragma once

#include "airsim360/planning/minimum_snap.h"
#include "airsim360/planning/spline_kernel.h"

namespace airsim360::internal {

/// True if durations near each other differ so much that double precision would lose more than about four
/// digits: the elimination loses up to the fifth power of their ratio.
bool NeedsWideArithmetic(const double* durations, size_t segments);

/// Any number of segments; workspace is not used. 64 bits of mantissa for one segment, 113 bits else.
void SolveRouteWide(SplineKind kind, const RouteArguments& arguments);

}  // namespace airsim360::internal

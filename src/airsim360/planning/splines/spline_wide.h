// The same solution as the kernels, in wider arithmetic: for single segments and very uneven durations.
#pragma once

#include "airsim360/planning/splines/minimum_snap.h"
#include "airsim360/planning/splines/spline_kernel.h"

namespace airsim360::internal {

/// Solves again, in wide arithmetic, the neighbourhoods of uneven durations (kernels->any_uneven) of a route
/// whose coefficients are already there; all of a route of at most kFewSegments.
void RefineUneven(SplineKind kind, const CheckKernels& kernels, const RouteArguments& arguments);

/// Any number of segments; workspace is not used. 64 bits of mantissa for one segment, 113 bits else.
void SolveRouteWide(SplineKind kind, const RouteArguments& arguments);

}  // namespace airsim360::internal

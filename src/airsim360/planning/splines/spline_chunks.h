// Long routes as overlapping chunks in SIMD lanes, window after window, so that everything between input and
// output stays in the cache.
#pragma once

#include "airsim360/planning/splines/minimum_snap.h"
#include "airsim360/planning/splines/spline_kernel.h"

namespace airsim360::internal {

/// Shorter routes are faster as one piece.
constexpr size_t kLeastChunkedSegments = 2048;

/// Written segments of a chunk at most; eight chunks and their overlaps fit a cache of 1 MB.
constexpr size_t kChunkSegments = 192;

/// Knots by which the influence of what is beyond falls below half a unit in the last place: it decays by
/// 0.5353 per knot (the largest root of the Euler-Frobenius polynomial of degree 7; 0.43 for degree 5) at
/// even durations, and 0.5353^56 = 6e-16.
constexpr size_t kChunkOverlap = 56;

constexpr size_t ChunkWorkspace() {
  constexpr size_t kLane = kChunkSegments + 2 * kChunkOverlap;
  return BatchWorkspace(kLane) + 2 * (4 * (kLane + 1) + kLane) + 16;
}

/// The route that kernels of RouteArguments would find, up to rounding: at least kLeastChunkedSegments,
/// prescribed ends, a kind that has a kernel. False where chunks disagree at a seam, for influence does not
/// decay in units of durations that keep growing; then the coefficients are of no use. The workspace has
/// ChunkWorkspace() doubles.
[[nodiscard]] bool SolveRouteInChunks(SplineKind kind, const BatchKernels& kernels, const RouteArguments& route);

}  // namespace airsim360::internal

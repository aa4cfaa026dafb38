// The vectorised solvers behind minimum_snap.h, compiled once per instruction set. Plain arrays, no checks.
#pragma once

#include <cstddef>
#include <cstdint>

#include "airsim360/base/kernel_isa.h"

namespace airsim360::internal {

/// Index into kernel tables; the order of SplineKind.
constexpr int kSplineKinds = 3;

/// One route. Points and derivatives are padded to four lanes, x y z 0.
struct RouteArguments {
  const double* knots;      ///< [segments + 1][4]
  const double* durations;  ///< [segments]
  size_t segments;
  const double* start;  ///< [3][4]: v, a, jerk
  const double* end;
  bool free_start, free_end;  ///< the highest derivative is free there; the kernels want both alike
  double* workspace;          ///< RouteWorkspace(segments) doubles, 64-byte aligned
  double* coefficients;       ///< [segment][3][power]
};

constexpr size_t RouteWorkspace(size_t segments) { return segments * 40 + 256; }

/// What the kernels saw on the way, lane by lane.
struct BatchCheck {
  double least[8], largest[8];  ///< durations, but for NaN
  double reach[8];              ///< finite only if all numbers were (and all results are)
  bool plain;                   ///< all lanes are finite, even and within the range of durations
};

/// Eight routes of equally many segments, from rest to rest.
struct BatchArguments {
  const double* waypoints[8];  ///< [segments + 1][stride]
  size_t stride;               ///< 3 or 4 doubles from a waypoint to the next
  const double* durations[8];
  size_t segments;
  double* workspace;  ///< BatchWorkspace(segments) doubles, 64-byte aligned
  double* coefficients[8];
  BatchCheck* check;  ///< written; not by chunks
  /// Where the next eight routes' waypoints and durations are expected, one route behind the other, or 0:
  /// asked for in passing. Nothing need be there.
  uintptr_t next_waypoints, next_durations;
};

constexpr size_t BatchWorkspace(size_t segments) { return (segments + 1) * 28 * 8; }

/// Eight chunks of one long route whose ends are prescribed completely. Each has `overlap` segments before
/// and behind those that are written; there the lanes of the route's ends repeat the end's waypoint and
/// duration.
struct ChunkArguments {
  BatchArguments lanes;  ///< segments: with both overlaps; coefficients: of the first one written
  size_t overlap;
  bool has_start, has_end;    ///< lane 0 starts where the route does, lane 7 ends where it ends
  const double *start, *end;  ///< [3][4], as in RouteArguments
};

struct NumberCheck {
  bool valid;   ///< durations are positive and finite; points too where they are looked at
  bool uneven;  ///< CheckKernels::any_uneven
};

constexpr size_t kFewSegments = 5;

struct SplineKernels {
  void (*route[kSplineKinds])(const RouteArguments&);  ///< at least 2 segments
  /// kMinimumSnap of 2 to kFewSegments segments (index 0: 2) from rest to rest, with waypoints [segments +
  /// 1][3] and durations as they come: they are looked at and copied in passing, to knots [segments + 1][4]
  /// and durations_copy. Where numbers are not valid the coefficients are of no use; `uneven` says only that
  /// some duration is more than 8 times another.
  NumberCheck (*few[kFewSegments - 1])(const double* waypoints, const double* durations, double* knots, double* durations_copy,
                                       double* coefficients);
};

struct BatchKernels {
  void (*batch[kSplineKinds])(const BatchArguments&);
  void (*chunks[kSplineKinds])(const ChunkArguments&);  ///< none for the paper's quintic
};

/// Derivatives of a function of coefficients and durations, through the optimum.
struct AdjointArguments {
  RouteArguments route;          ///< solved: coefficients are read; any number of segments
  const double* by_coefficient;  ///< like route.coefficients
  double* by_duration;           ///< [segments]: in at fixed coefficients, out in total
  double* by_waypoint;           ///< [segments + 1][4], out
};

constexpr size_t AdjointWorkspace(size_t segments) { return segments * 38 * 4; }

struct AdjointKernels {
  void (*adjoint[kSplineKinds])(const AdjointArguments&);
};

/// Durations of a route that differ at most so much count as even, wherever they are.
constexpr double kEvenRatio = 8;
/// Powers of longer or shorter ones may leave the range of numbers: they count as uneven.
constexpr double kLongestDuration = 1e30, kShortestDuration = 1e-30;

struct CheckKernels {
  bool (*all_finite)(const double* x, size_t n);
  /// A duration is more than 16 times its neighbour, or more than 8 times both of the next two on one side:
  /// double precision would lose more than about five digits there.
  bool (*any_uneven)(const double* durations, size_t n);
  /// Points [n][3] to [n][4], the fourth zero; whether all are finite.
  bool (*pad_points)(const double* points, size_t n, double* out);
  /// n >= 1.
  NumberCheck (*copy_durations)(const double* durations, size_t n, double* out);
};

}  // namespace airsim360::internal

AIRSIM360_DECLARE_KERNEL(extern const SplineKernels kSplineKernels)
AIRSIM360_DECLARE_KERNEL(extern const BatchKernels kBatchKernels)
AIRSIM360_DECLARE_KERNEL(extern const AdjointKernels kAdjointKernels)
AIRSIM360_DECLARE_KERNEL(extern const CheckKernels kCheckKernels)

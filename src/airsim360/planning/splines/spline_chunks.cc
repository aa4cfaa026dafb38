#include "airsim360/planning/splines/spline_chunks.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

/// Segments first - overlap to first + count + overlap of a route; those it does not have repeat its ends.
struct PaddedPiece {
  double *knots, *durations;
};

void CopyPadded(const RouteArguments& route, size_t first, size_t count, PaddedPiece piece) {
  const auto clamp = [](size_t at, size_t limit) { return at < kChunkOverlap ? 0 : std::min(at - kChunkOverlap, limit); };
  for (size_t i = 0; i < count + 2 * kChunkOverlap; ++i) {
    piece.durations[i] = route.durations[clamp(first + i, route.segments - 1)];
  }
  for (size_t i = 0; i <= count + 2 * kChunkOverlap; ++i) {
    std::copy_n(route.knots + 4 * clamp(first + i, route.segments), 4, piece.knots + 4 * i);
  }
}

/// How far neighbouring chunks may disagree where they meet: the sum over derivatives, in units of the
/// shorter duration, over the largest term of the polynomials. A derivative is up to 210 times a term;
/// rounding alone reaches 1e-11.
constexpr double kSeamTolerance = 1e-10;

double LargestTerm(const double* c, size_t powers, double duration) {
  double largest = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    double power = duration;
    for (size_t k = 1; k < powers; ++k, power *= duration) {
      largest = std::max(largest, std::abs(c[axis * powers + k] * power));
    }
  }
  return largest;
}

/// Derivatives 1 to 3 at the end of a segment against those at the start of the next.
bool AgreesWithNext(const double* c, size_t powers, const double* durations) {
  const double* const next = c + 3 * powers;
  const double unit = std::min(durations[0], durations[1]);
  double difference = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    double sum[3] = {}, power = 1;
    for (size_t k = 1; k < powers; ++k, power *= durations[0]) {
      const double factor = static_cast<double>(k), term = c[axis * powers + k] * power * factor;
      sum[0] += term;
      sum[1] += term * (factor - 1);
      sum[2] += term * (factor - 1) * (factor - 2);
    }
    const double inverse = 1 / durations[0], *const there = next + axis * powers;
    difference += (std::abs(sum[0] - there[1]) + std::abs(sum[1] * inverse - 2 * there[2]) * unit +
                   std::abs(sum[2] * inverse * inverse - 6 * there[3]) * unit * unit) *
                  unit;
  }
  const double largest = std::max(LargestTerm(c, powers, durations[0]), LargestTerm(next, powers, durations[1]));
  return difference <= kSeamTolerance * largest;
}

}  // namespace

bool SolveRouteInChunks(SplineKind kind, const BatchKernels& kernels, const RouteArguments& route) {
  const size_t segments = route.segments, size = 3 * static_cast<size_t>(PowersOf(kind));
  const size_t windows = (segments + 8 * kChunkSegments - 1) / (8 * kChunkSegments), chunks = 8 * windows;
  const size_t count = (segments + chunks - 1) / chunks, lane_segments = count + 2 * kChunkOverlap;
  double* const padded = route.workspace + BatchWorkspace(lane_segments);
  const PaddedPiece head = {padded, padded + 4 * (lane_segments + 1)};
  const PaddedPiece tail = {head.durations + lane_segments, head.durations + 5 * lane_segments + 4};
  CopyPadded(route, 0, count, head);
  CopyPadded(route, segments - count, count, tail);

  ChunkArguments arguments = {};
  arguments.lanes.stride = 4;
  arguments.lanes.segments = lane_segments;
  arguments.lanes.workspace = route.workspace;
  arguments.overlap = kChunkOverlap;
  arguments.start = route.start;
  arguments.end = route.end;
  for (size_t chunk = 0; chunk < chunks; ++chunk) {
    // Spread evenly, so neighbours share a segment here and there and both write it.
    const size_t first = chunk * (segments - count) / (chunks - 1), lane = chunk % 8;
    const bool has_start = chunk == 0, has_end = chunk + 1 == chunks;
    const size_t before = has_start || has_end ? 0 : first - kChunkOverlap;
    arguments.lanes.waypoints[lane] = has_start ? head.knots : has_end ? tail.knots : route.knots + 4 * before;
    arguments.lanes.durations[lane] = has_start ? head.durations : has_end ? tail.durations : route.durations + before;
    arguments.lanes.coefficients[lane] = route.coefficients + first * size;
    if (lane < 7) continue;
    arguments.has_start = chunk == 7;
    arguments.has_end = has_end;
    kernels.chunks[static_cast<int>(kind)](arguments);
    for (size_t i = chunk == 7 ? 1 : chunk - 7; i <= chunk; ++i) {
      const size_t seam = i * (segments - count) / (chunks - 1);
      if (!AgreesWithNext(route.coefficients + (seam - 1) * size, size / 3, route.durations + seam - 1)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace airsim360::internal

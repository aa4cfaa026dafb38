// Records of single lanes turned into vectors (only for *_kernel.cc files): sixteen bytes of every lane at a
// time, turned round in registers instead of number by number through memory.
#pragma once

#include "airsim360/render/shading/shading_simd.h"
// After it, which silences GCC 12 about its own intrinsics.
#include <immintrin.h>

namespace airsim360::internal::AIRSIM360_ISA {

#define KERNEL static inline __attribute__((always_inline, unused))

using ureal = stdx::rebind_simd_t<uint32_t, real>;

struct real4 {
  real x, y, z, w;
};

// Row<j> holds the sixteen bytes of the lanes j, j + 4, j + 8, …; the rows of a 4 x 4 transpose in every
// quarter.
#if defined(__AVX512F__)
using LaneVector = __m512;
template <class At>
KERNEL LaneVector LaneRow(At at, int j) {
  const __m256 low =
      _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(at(j))), _mm_loadu_ps(at(j + 4)), 1);
  const __m256 high =
      _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(at(j + 8))), _mm_loadu_ps(at(j + 12)), 1);
  return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
}
KERNEL LaneVector PairLow(LaneVector a, LaneVector b) { return _mm512_unpacklo_ps(a, b); }
KERNEL LaneVector PairHigh(LaneVector a, LaneVector b) { return _mm512_unpackhi_ps(a, b); }
KERNEL LaneVector QuadLow(LaneVector a, LaneVector b) {
  return _mm512_castpd_ps(_mm512_unpacklo_pd(_mm512_castps_pd(a), _mm512_castps_pd(b)));
}
KERNEL LaneVector QuadHigh(LaneVector a, LaneVector b) {
  return _mm512_castpd_ps(_mm512_unpackhi_pd(_mm512_castps_pd(a), _mm512_castps_pd(b)));
}
#elif defined(__AVX__)
using LaneVector = __m256;
template <class At>
KERNEL LaneVector LaneRow(At at, int j) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(at(j))), _mm_loadu_ps(at(j + 4)), 1);
}
KERNEL LaneVector PairLow(LaneVector a, LaneVector b) { return _mm256_unpacklo_ps(a, b); }
KERNEL LaneVector PairHigh(LaneVector a, LaneVector b) { return _mm256_unpackhi_ps(a, b); }
KERNEL LaneVector QuadLow(LaneVector a, LaneVector b) {
  return _mm256_castpd_ps(_mm256_unpacklo_pd(_mm256_castps_pd(a), _mm256_castps_pd(b)));
}
KERNEL LaneVector QuadHigh(LaneVector a, LaneVector b) {
  return _mm256_castpd_ps(_mm256_unpackhi_pd(_mm256_castps_pd(a), _mm256_castps_pd(b)));
}
#else
using LaneVector = __m128;
template <class At>
KERNEL LaneVector LaneRow(At at, int j) {
  return _mm_loadu_ps(at(j));
}
KERNEL LaneVector PairLow(LaneVector a, LaneVector b) { return _mm_unpacklo_ps(a, b); }
KERNEL LaneVector PairHigh(LaneVector a, LaneVector b) { return _mm_unpackhi_ps(a, b); }
KERNEL LaneVector QuadLow(LaneVector a, LaneVector b) {
  return _mm_castpd_ps(_mm_unpacklo_pd(_mm_castps_pd(a), _mm_castps_pd(b)));
}
KERNEL LaneVector QuadHigh(LaneVector a, LaneVector b) {
  return _mm_castpd_ps(_mm_unpackhi_pd(_mm_castps_pd(a), _mm_castps_pd(b)));
}
#endif

/// The four floats at `at(lane)`, which is a const float* that needs no alignment.
template <class At>
KERNEL real4 GatherQuads(At at) {
  const LaneVector a = LaneRow(at, 0), b = LaneRow(at, 1), c = LaneRow(at, 2), d = LaneRow(at, 3);
  const LaneVector xy = PairLow(a, b), zw = PairHigh(a, b), xy2 = PairLow(c, d), zw2 = PairHigh(c, d);
  return {real(QuadLow(xy, xy2)), real(QuadHigh(xy, xy2)), real(QuadLow(zw, zw2)), real(QuadHigh(zw, zw2))};
}

/// The same into four rows of lanes one after another.
template <class At>
KERNEL void GatherRows(At at, void* rows) {
  const real4 q = GatherQuads(at);
  auto* out = static_cast<real*>(rows);
  out[0] = q.x, out[1] = q.y, out[2] = q.z, out[3] = q.w;
}

KERNEL real3 Rgb(real4 c) { return {c.x, c.y, c.z}; }
KERNEL ureal Bits(const uint32_t* lanes) { return ureal(lanes, stdx::vector_aligned); }
/// A number in [0, 1) of mixed bits.
KERNEL real HashLanes(ureal bits) {
  return to_real(stdx::static_simd_cast<ireal>((bits * 0x9e3779b1u) >> 8)) * 0x1p-24f;
}

}  // namespace airsim360::internal::AIRSIM360_ISA

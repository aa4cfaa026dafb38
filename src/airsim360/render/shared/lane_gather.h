// Records of single lanes turned into vectors (only for *_kernel.cc files): sixteen bytes of every lane at a
// time, turned round in registers instead of number by number through memory.
#pragma once

#include "airsim360/render/shared/shading_simd.h"
// After it, which silences GCC 12 about its own intrinsics.
#include <immintrin.h>

namespace airsim360::internal::AIRSIM360_ISA {

#define KERNEL static inline __attribute__((always_inline, unused))

struct real4 {
  real x, y, z, w;
};

// Row<j> holds the sixteen bytes of the lanes j, j + 4, j + 8, …; the rows of a 4 x 4 transpose in every
// quarter.
#if defined(__AVX512F__)
using LaneVector = __m512;
template <class At>
KERNEL LaneVector LaneRow(At at, int j) {
  const __m256 low = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(at(j))), _mm_loadu_ps(at(j + 4)), 1);
  const __m256 high = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(at(j + 8))), _mm_loadu_ps(at(j + 12)), 1);
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
KERNEL LaneVector QuadLow(LaneVector a, LaneVector b) { return _mm_castpd_ps(_mm_unpacklo_pd(_mm_castps_pd(a), _mm_castps_pd(b))); }
KERNEL LaneVector QuadHigh(LaneVector a, LaneVector b) { return _mm_castpd_ps(_mm_unpackhi_pd(_mm_castps_pd(a), _mm_castps_pd(b))); }
#endif

/// Rows j of quads of the lanes j, j + 4, … to columns, and back: its own inverse.
KERNEL real4 TurnQuads(LaneVector a, LaneVector b, LaneVector c, LaneVector d) {
  const LaneVector xy = PairLow(a, b), zw = PairHigh(a, b), xy2 = PairLow(c, d), zw2 = PairHigh(c, d);
  return {real(QuadLow(xy, xy2)), real(QuadHigh(xy, xy2)), real(QuadLow(zw, zw2)), real(QuadHigh(zw, zw2))};
}

/// The four floats at `at(lane)`, which is a const float* that needs no alignment.
template <class At>
KERNEL real4 GatherQuads(At at) {
  return TurnQuads(LaneRow(at, 0), LaneRow(at, 1), LaneRow(at, 2), LaneRow(at, 3));
}

/// The same into four rows of lanes one after another.
template <class At>
KERNEL void GatherRows(At at, void* rows) {
  const real4 q = GatherQuads(at);
  auto* out = static_cast<real*>(rows);
  out[0] = q.x, out[1] = q.y, out[2] = q.z, out[3] = q.w;
}

/// One word, of whatever type, in all lanes of a row.
KERNEL void SpreadWord(const float* word, void* row) {
  uint32_t bits;
  __builtin_memcpy(&bits, word, sizeof bits);
  ureal(bits).copy_to(static_cast<uint32_t*>(row), stdx::vector_aligned);
}

/// Makes `lanes`, an array in memory, stay there, so that its elements are read as plain integers: compilers
/// would otherwise take them out of the vector they come from, one shuffle each.
template <class T>
KERNEL void KeepInMemory(T& lanes) {
  asm volatile("" : "+m"(lanes));
}

/// base[index] of every lane.
KERNEL ireal GatherWords(const uint32_t* base, ireal index) {
#if defined(__AVX512F__)
  alignas(64) int32_t lanes[kLanes];
  index.copy_to(lanes, stdx::vector_aligned);
  _mm512_store_si512(lanes, _mm512_i32gather_epi32(_mm512_load_si512(lanes), base, 4));
  return ireal(lanes, stdx::vector_aligned);
#else
  alignas(64) int32_t at[kLanes], lanes[kLanes];
  index.copy_to(at, stdx::vector_aligned);
  for (int i = 0; i < kLanes; ++i) lanes[i] = static_cast<int32_t>(base[at[i]]);
  return ireal(lanes, stdx::vector_aligned);
#endif
}
// Not by GatherWords: floats that are read as words count as never read, and compilers drop what was stored there.
KERNEL real GatherFloats(const float* base, ireal index) {
#if defined(__AVX512F__)
  return real(_mm512_i32gather_ps(static_cast<__m512i>(index), base, 4));
#else
  alignas(64) int32_t at[kLanes];
  alignas(64) float lanes[kLanes];
  index.copy_to(at, stdx::vector_aligned);
  for (int i = 0; i < kLanes; ++i) lanes[i] = base[at[i]];
  return real(lanes, stdx::vector_aligned);
#endif
}
/// bases[lane][index] of every lane.
KERNEL ireal GatherWordsAt(const uint32_t* const* bases, ireal index) {
  alignas(64) int32_t at[kLanes], lanes[kLanes];
  index.copy_to(at, stdx::vector_aligned);
#if defined(__AVX512F__)
  const auto half = [&](int first) __attribute__((always_inline)) {
    const __m512i offset = _mm512_slli_epi64(_mm512_cvtepi32_epi64(_mm256_load_si256(reinterpret_cast<const __m256i*>(at + first))), 2);
    const __m512i address = _mm512_add_epi64(_mm512_loadu_si512(bases + first), offset);
    _mm256_store_si256(reinterpret_cast<__m256i*>(lanes + first), _mm512_i64gather_epi32(address, nullptr, 1));
  };
  half(0), half(8);
#else
  for (int i = 0; i < kLanes; ++i) lanes[i] = static_cast<int32_t>(bases[i][at[i]]);
#endif
  return ireal(lanes, stdx::vector_aligned);
}

KERNEL real3 Rgb(real4 c) { return {c.x, c.y, c.z}; }
KERNEL ureal Bits(const uint32_t* lanes) { return ureal(lanes, stdx::vector_aligned); }
/// A number in [0, 1) of mixed bits.
KERNEL real HashLanes(ureal bits) { return to_real(stdx::static_simd_cast<ireal>((bits * 0x9e3779b1u) >> 8)) * 0x1p-24f; }

}  // namespace airsim360::internal::AIRSIM360_ISA

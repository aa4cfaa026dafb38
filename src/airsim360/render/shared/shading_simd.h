// shading_shared.h as SIMD C++, in airsim360::internal::AIRSIM360_ISA: only for *_kernel.cc files (and their
// tests).
#pragma once

// GCC 12 takes the "undefined" operands of its own AVX-512 intrinsics for bugs of ours.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>

#include <experimental/simd>
#pragma GCC diagnostic pop

#include <cstdint>

#include "airsim360/render/shared/shading_data.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace stdx = std::experimental;

#define SHARED static inline __attribute__((always_inline, unused))
#define INOUT(T) T&
using real = stdx::native_simd<float>;
using ireal = stdx::rebind_simd_t<int32_t, real>;
using ureal = stdx::rebind_simd_t<uint32_t, real>;
using ufloat = float;
using mask_t = real::mask_type;
constexpr int kLanes = static_cast<int>(real::size());

/// Three lanes-wide numbers; ufloat3 is the same for all lanes.
struct real3 {
  real x, y, z;
};
struct ufloat3 {
  float x, y, z;
};
SHARED real3 operator+(real3 a, real3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
SHARED real3 operator-(real3 a, real3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
SHARED real3 operator-(real3 a) { return {-a.x, -a.y, -a.z}; }
SHARED real3 operator*(real3 a, real s) { return {a.x * s, a.y * s, a.z * s}; }
SHARED real3 operator*(real s, real3 a) { return a * s; }
SHARED real3 operator*(real3 a, real3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
SHARED real3 operator+(real3 a, ufloat3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
SHARED real3 operator+(ufloat3 a, real3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
SHARED real3 operator*(real3 a, ufloat3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
SHARED real3 operator*(ufloat3 a, real3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
SHARED real3 operator*(ufloat3 a, real s) { return {a.x * s, a.y * s, a.z * s}; }

#if defined(__AVX512F__)
// As `where` of libstdc++, which compiles a case for each lane of masks that are known beforehand: half of the compiler's time.
SHARED real sel(mask_t m, real a, real b) {
  return real(_mm512_mask_blend_ps(__builtin_bit_cast(__mmask16, m), static_cast<__m512>(b), static_cast<__m512>(a)));
}
#else
SHARED real sel(mask_t m, real a, real b) {
  stdx::where(m, b) = a;
  return b;
}
#endif
SHARED real3 sel3(mask_t m, real3 a, real3 b) { return {sel(m, a.x, b.x), sel(m, a.y, b.y), sel(m, a.z, b.z)}; }
SHARED bool any_lane(mask_t m) { return stdx::any_of(m); }
SHARED real3 make3(real x, real y, real z) { return {x, y, z}; }
// As b < a ? b : a and a < b ? b : a, one instruction each: x86 gives the second operand where neither is
// less, and where one is not a number.
#if defined(__AVX512F__)
SHARED real rmin(real a, real b) { return real(_mm512_min_ps(static_cast<__m512>(b), static_cast<__m512>(a))); }
SHARED real rmax(real a, real b) { return real(_mm512_max_ps(static_cast<__m512>(b), static_cast<__m512>(a))); }
#elif defined(__AVX__)
SHARED real rmin(real a, real b) { return real(_mm256_min_ps(static_cast<__m256>(b), static_cast<__m256>(a))); }
SHARED real rmax(real a, real b) { return real(_mm256_max_ps(static_cast<__m256>(b), static_cast<__m256>(a))); }
#else
SHARED real rmin(real a, real b) { return real(_mm_min_ps(static_cast<__m128>(b), static_cast<__m128>(a))); }
SHARED real rmax(real a, real b) { return real(_mm_max_ps(static_cast<__m128>(b), static_cast<__m128>(a))); }
#endif
SHARED real rroot(real a) { return stdx::sqrt(a); }
SHARED real rsqrt_exact(real a) { return 1.0f / stdx::sqrt(a); }
SHARED real rfloor(real a) { return stdx::floor(a); }
SHARED real rabs(real a) { return stdx::abs(a); }
SHARED ireal bits_of(real a) { return stdx::__proposed::simd_bit_cast<ireal>(a); }
SHARED real from_bits(ireal a) { return stdx::__proposed::simd_bit_cast<real>(a); }
SHARED ireal to_int(real a) { return stdx::static_simd_cast<ireal>(a); }
SHARED real to_real(ireal a) { return stdx::static_simd_cast<real>(a); }
SHARED real pow2_int(real i) { return from_bits((to_int(i) + 127) << 23); }
SHARED real exponent_of(real a) { return to_real((bits_of(a) >> 23) - 127); }
SHARED real mantissa_of(real a) { return from_bits((bits_of(a) & 0x007fffff) | 0x3f800000); }
// Tables by the low four or five bits of the exponent.
#define SHADE_TABLE16(name, ...) alignas(64) static constexpr float name[16] = {__VA_ARGS__};
#define SHADE_TABLE32(name, ...) alignas(64) static constexpr float name[32] = {__VA_ARGS__};
#if defined(__AVX512F__)
SHARED __m512i exponent_bits(real a) { return _mm512_srli_epi32(_mm512_castps_si512(static_cast<__m512>(a)), 23); }
SHARED real octave16(const float* table, real a) { return real(_mm512_permutexvar_ps(exponent_bits(a), _mm512_load_ps(table))); }
SHARED real octave32(const float* table, real a) {
  return real(_mm512_permutex2var_ps(_mm512_load_ps(table), exponent_bits(a), _mm512_load_ps(table + 16)));
}
#else
SHARED real table_lanes(const float* table, ireal index) {
  alignas(64) int32_t at[kLanes];
  alignas(64) float out[kLanes];
  index.copy_to(at, stdx::vector_aligned);
  for (int i = 0; i < kLanes; ++i) out[i] = table[at[i]];
  return real(out, stdx::vector_aligned);
}
SHARED real octave16(const float* table, real a) { return table_lanes(table, (bits_of(a) >> 23) & 15); }
SHARED real octave32(const float* table, real a) { return table_lanes(table, (bits_of(a) >> 23) & 31); }
#endif
SHARED real dot3(real3 a, real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
SHARED real dot3(real3 a, ufloat3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

SHARED real load(const float* p) { return real(p, stdx::vector_aligned); }
SHARED void store(float* p, real a) { a.copy_to(p, stdx::vector_aligned); }
SHARED real3 load3(const float* x, const float* y, const float* z) { return {load(x), load(y), load(z)}; }
SHARED void store3(float* x, float* y, float* z, real3 a) {
  store(x, a.x);
  store(y, a.y);
  store(z, a.z);
}
// Of one lane, and of all.
#define word uint32_t
#include "airsim360/render/shared/shading_hash.h"
#undef word
#define word ureal
#include "airsim360/render/shared/shading_hash.h"
#undef word
// Each uses what the one before defines.
// clang-format off
#include "airsim360/render/shared/shading_shared.h"
// clang-format off: each needs the words of those before it.
#include "airsim360/render/shared/shading_bsdf.h"
#include "airsim360/render/shared/shading_air.h"
#include "airsim360/render/shared/shading_air_view.h"
#include "airsim360/render/shared/shading_sky.h"
#include "airsim360/render/shared/shading_tone.h"
#include "airsim360/render/shared/shading_interior.h"
#include "airsim360/render/shared/shading_wet_snow.h"
#include "airsim360/render/shared/shading_moon.h"
#include "airsim360/render/shared/shading_ground.h"
// clang-format on
#undef SHARED
#undef INOUT
#undef SHADE_TABLE16
#undef SHADE_TABLE32

}  // namespace airsim360::internal::AIRSIM360_ISA

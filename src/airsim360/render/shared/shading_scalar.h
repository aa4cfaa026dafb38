// shading_shared.h as plain C++ floats, in airsim360::internal::scalar: tests, table baking, probe baking.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "airsim360/math/vector.h"
#include "airsim360/render/shared/shading_data.h"

namespace airsim360::internal::scalar {

using real = float;
using real3 = Vec3f;
using ufloat = float;
using ufloat3 = Vec3f;
using mask_t = bool;

#define SHARED static inline __attribute__((always_inline, unused))
#define INOUT(T) T&
SHARED real sel(mask_t m, real a, real b) { return m ? a : b; }
SHARED real3 sel3(mask_t m, real3 a, real3 b) { return m ? a : b; }
SHARED real3 make3(real x, real y, real z) { return {x, y, z}; }
SHARED real rmin(real a, real b) { return b < a ? b : a; }
SHARED real rmax(real a, real b) { return a < b ? b : a; }
SHARED real rsqrt_exact(real a) { return 1.0f / std::sqrt(a); }
SHARED real rroot(real a) { return std::sqrt(a); }
SHARED real rfloor(real a) { return std::floor(a); }
SHARED real rabs(real a) { return std::fabs(a); }
SHARED real pow2_int(real i) { return std::bit_cast<float>((static_cast<int32_t>(i) + 127) << 23); }
SHARED real exponent_of(real a) { return static_cast<float>((std::bit_cast<int32_t>(a) >> 23) - 127); }
SHARED real mantissa_of(real a) { return std::bit_cast<float>((std::bit_cast<int32_t>(a) & 0x007fffff) | 0x3f800000); }
// Tables by the low four or five bits of the exponent.
#define SHADE_TABLE16(name, ...) static constexpr float name[16] = {__VA_ARGS__};
#define SHADE_TABLE32(name, ...) static constexpr float name[32] = {__VA_ARGS__};
SHARED real octave16(const float* table, real a) { return table[(std::bit_cast<uint32_t>(a) >> 23) & 15]; }
SHARED real octave32(const float* table, real a) { return table[(std::bit_cast<uint32_t>(a) >> 23) & 31]; }
SHARED bool any_lane(mask_t m) { return m; }
SHARED real dot3(real3 a, real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
#define word uint32_t
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

}  // namespace airsim360::internal::scalar

namespace airsim360::internal {

/// As the structures of shading_data.h hold a vector.
inline void Put(float (&to)[3], Vec3f from) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

}  // namespace airsim360::internal

// The few operations that the equations need beside + - * /, for scalars and for SIMD lanes. Every one is
// exactly rounded or a selection, so that any number of lanes gives the same bits.
#pragma once

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#include <cmath>
#include <concepts>

#include "airsim360/math/vector.h"

#define AIRSIM360_LANES inline __attribute__((always_inline))

namespace airsim360::internal {

template <class V>
struct ScalarOfLanes {
  using type = typename V::value_type;
};
template <std::floating_point V>
struct ScalarOfLanes<V> {
  using type = V;
};
template <class V>
using ScalarOf = typename ScalarOfLanes<V>::type;

/// a where `first`, else b; Mask is bool, or the mask of std::experimental::simd.
template <class Mask, class V>
AIRSIM360_LANES V Select(Mask first, V a, V b) {
  if constexpr (std::floating_point<V>) {
    return first ? a : b;
#if defined(__AVX512F__)
  } else if constexpr (sizeof(Mask) == sizeof(__mmask16) && sizeof(V) == sizeof(__m512) && std::same_as<ScalarOf<V>, float>) {
    // `where` of libstdc++ compiles a case for each lane of masks that are known beforehand: a third of the compiler's time.
    return V(_mm512_mask_blend_ps(__builtin_bit_cast(__mmask16, first), static_cast<__m512>(b), static_cast<__m512>(a)));
#endif
  } else {
    where(first, b) = a;
    return b;
  }
}

template <class V>
AIRSIM360_LANES V SquareRoot(V x) {
  using std::sqrt;
  return sqrt(x);
}

/// A vector of scalars for lanes: every lane gets the same.
template <class V>
AIRSIM360_LANES Vec3<V> Broadcast(Vec3<ScalarOf<V>> a) {
  return {V(a.x), V(a.y), V(a.z)};
}

}  // namespace airsim360::internal

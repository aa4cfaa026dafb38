// Products and lengths of vectors in the plane.
#pragma once

#include <cmath>

#include "airsim360/math/vector.h"

namespace airsim360 {

template <class T>
constexpr T Dot(Vec2<T> a, Vec2<T> b) {
  return a.x * b.x + a.y * b.y;
}

/// Of the third axis: positive where b lies to the left of a.
template <class T>
constexpr T Cross(Vec2<T> a, Vec2<T> b) {
  return a.x * b.y - a.y * b.x;
}

template <class T>
T Norm(Vec2<T> a) {
  return std::sqrt(Dot(a, a));
}

}  // namespace airsim360

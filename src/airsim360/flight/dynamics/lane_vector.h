// Vec3 of SIMD lanes: as in math/vector.h, but without the comparison, which for lanes would be a mask (clang
// refuses its default).
#pragma once

#include <experimental/simd>

#include "airsim360/flight/dynamics/lane_math.h"

namespace airsim360 {

template <class T, class Abi>
struct Vec3<std::experimental::simd<T, Abi>> {
  using V = std::experimental::simd<T, Abi>;
  V x{}, y{}, z{};

  AIRSIM360_LANES V& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  AIRSIM360_LANES const V& operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  AIRSIM360_LANES Vec3& operator+=(const Vec3& b) { return *this = *this + b; }
  AIRSIM360_LANES Vec3& operator-=(const Vec3& b) { return *this = *this - b; }
  AIRSIM360_LANES friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  AIRSIM360_LANES friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  AIRSIM360_LANES friend Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  AIRSIM360_LANES friend Vec3 operator*(const Vec3& a, const V& s) { return {a.x * s, a.y * s, a.z * s}; }
  AIRSIM360_LANES friend Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
};

}  // namespace airsim360

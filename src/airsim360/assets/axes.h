// The only conversions between frame G of model files (glTF, OBJ: +Y up, +Z towards the viewer) and W (+Z
// up). x_W = x_G, y_W = -z_G, z_W = y_G: a rotation by +90 degrees about x. What faces +Z in G faces -Y in W.
#pragma once

#include "airsim360/math/transform.h"

namespace airsim360::internal {

/// Points and directions.
template <class T>
constexpr Vec3<T> FromG(Vec3<T> v_G) {
  return {v_G.x, -v_G.z, v_G.y};
}
template <class T>
constexpr Vec3<T> ToG(Vec3<T> v_W) {
  return {v_W.x, v_W.z, -v_W.y};
}

/// Linear maps: with R the rotation above, R A R^T.
template <class T>
constexpr Mat3<T> FromG(const Mat3<T>& A_G) {
  return Mat3<T>::FromColumns(FromG(A_G.column(0)), -FromG(A_G.column(2)), FromG(A_G.column(1)));
}
template <class T>
constexpr Mat3<T> ToG(const Mat3<T>& A_W) {
  return Mat3<T>::FromColumns(ToG(A_W.column(0)), ToG(A_W.column(2)), -ToG(A_W.column(1)));
}

/// Transforms of the glTF node hierarchy, in double until they are handed over.
struct TransformG {
  Mat3d A;
  Vec3d p;
  friend Vec3d operator*(const TransformG& X, Vec3d v) { return X.A * v + X.p; }
  friend TransformG operator*(const TransformG& a, const TransformG& b) { return {a.A * b.A, a * b.p}; }
};

/// The same map between the W versions of both its frames.
inline AffineTransform FromG(const TransformG& X) {
  const Mat3d A = FromG(X.A);
  AffineTransform out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out.A.m[i][j] = static_cast<float>(A.m[i][j]);
  }
  out.p = VecCast<float>(FromG(X.p));
  return out;
}

}  // namespace airsim360::internal

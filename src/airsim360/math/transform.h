// Rotations, rigid poses and affine instance transforms. X_AB is the pose of B in A: p_A = X_AB * p_B.
#pragma once

#include <array>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// 3x3 matrix, row-major: m[row][column].
template <class T>
struct Mat3 {
  std::array<std::array<T, 3>, 3> m{{{T(1), T(0), T(0)}, {T(0), T(1), T(0)}, {T(0), T(0), T(1)}}};

  static constexpr Mat3 FromColumns(Vec3<T> a, Vec3<T> b, Vec3<T> c) { return {{{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}}}}; }
  constexpr Vec3<T> column(int j) const { return {m[0][j], m[1][j], m[2][j]}; }
  constexpr Vec3<T> row(int i) const { return {m[i][0], m[i][1], m[i][2]}; }
  constexpr Mat3 transpose() const { return FromColumns(row(0), row(1), row(2)); }
  constexpr T determinant() const { return Dot(row(0), Cross(row(1), row(2))); }
  friend constexpr Vec3<T> operator*(const Mat3& a, Vec3<T> v) { return {Dot(a.row(0), v), Dot(a.row(1), v), Dot(a.row(2), v)}; }
  friend constexpr Mat3 operator*(const Mat3& a, const Mat3& b) { return FromColumns(a * b.column(0), a * b.column(1), a * b.column(2)); }
  friend constexpr bool operator==(const Mat3&, const Mat3&) = default;
};

using Mat3f = Mat3<float>;
using Mat3d = Mat3<double>;

/// Right-handed rotations by `angle` radians about the axes.
Mat3d RotationX(double angle);
Mat3d RotationY(double angle);
Mat3d RotationZ(double angle);

/// Unit Hamilton quaternion; (w, x, y, z) and its negative are the same rotation.
struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;
};

/// Rotation matrix of a unit quaternion.
Mat3d ToMatrix(const Quaternion& q);
/// Unit quaternion of a rotation matrix, with w >= 0 (Shepperd's method).
Quaternion ToQuaternion(const Mat3d& R);

/// Rigid pose: p_A = R * p_B + p.
struct RigidTransform {
  Mat3d R;
  Vec3d p;

  friend Vec3d operator*(const RigidTransform& X, Vec3d v) { return X.R * v + X.p; }
  friend RigidTransform operator*(const RigidTransform& a, const RigidTransform& b) { return {a.R * b.R, a * b.p}; }
  RigidTransform inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

/// Affine transform in single precision, for placing meshes: p_A = A * p_B + p. A may scale and mirror.
struct AffineTransform {
  Mat3f A;
  Vec3f p;

  friend Vec3f operator*(const AffineTransform& X, Vec3f v) { return X.A * v + X.p; }
  friend AffineTransform operator*(const AffineTransform& a, const AffineTransform& b) { return {a.A * b.A, a * b.p}; }
  friend bool operator==(const AffineTransform&, const AffineTransform&) = default;
};

/// Places an upright thing at `p`, turned by `yaw` (counter-clockwise seen from above) and scaled uniformly.
AffineTransform PlaceUpright(Vec3f p, float yaw = 0, float scale = 1);

/// Pose of a vehicle body (+X forward, +Y left, +Z up) in the world: R_WB = Rz(yaw) Ry(-pitch) Rx(roll).
/// Radians. yaw 0 faces +X and grows counter-clockwise seen from above; pitch is positive nose up; roll
/// positive right side down.
RigidTransform BodyPose(Vec3d p_WB, double yaw, double pitch, double roll);

/// Pose of a camera (+X right, +Y down, +Z forward) that looks along the body's forward axis, at the body's
/// origin.
RigidTransform CameraInBody();

}  // namespace airsim360

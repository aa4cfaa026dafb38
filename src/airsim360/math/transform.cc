#include "airsim360/math/transform.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace airsim360 {
namespace {

// cos and sin that are exact at multiples of a quarter turn, so that axis-aligned poses stay axis-aligned.
struct CosSin {
  double c, s;
};

CosSin ExactCosSin(double angle) {
  const double quarters = angle / (std::numbers::pi / 2);
  const double nearest = std::round(quarters);
  if (std::abs(quarters - nearest) < 1e-15 * std::max(1.0, std::abs(nearest))) {
    static constexpr CosSin kQuarter[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return kQuarter[static_cast<int>(nearest - 4 * std::floor(nearest / 4)) & 3];
  }
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

Mat3d RotationX(double angle) {
  const auto [c, s] = ExactCosSin(angle);
  return {{{{1, 0, 0}, {0, c, -s}, {0, s, c}}}};
}

Mat3d RotationY(double angle) {
  const auto [c, s] = ExactCosSin(angle);
  return {{{{c, 0, s}, {0, 1, 0}, {-s, 0, c}}}};
}

Mat3d RotationZ(double angle) {
  const auto [c, s] = ExactCosSin(angle);
  return {{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}}};
}

Mat3d ToMatrix(const Quaternion& q) {
  const auto [w, x, y, z] = q;
  return {{{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
            {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
            {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}}};
}

Quaternion ToQuaternion(const Mat3d& R) {
  // Shepperd (1978): divide by the largest of the four, so that no cancellation occurs.
  const auto& m = R.m;
  const double trace = m[0][0] + m[1][1] + m[2][2];
  Quaternion q;
  if (trace >= std::max({m[0][0], m[1][1], m[2][2]})) {
    q = {1 + trace, m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]};
  } else if (m[0][0] >= std::max(m[1][1], m[2][2])) {
    q = {m[2][1] - m[1][2], 1 + 2 * m[0][0] - trace, m[0][1] + m[1][0], m[0][2] + m[2][0]};
  } else if (m[1][1] >= m[2][2]) {
    q = {m[0][2] - m[2][0], m[0][1] + m[1][0], 1 + 2 * m[1][1] - trace, m[1][2] + m[2][1]};
  } else {
    q = {m[1][0] - m[0][1], m[0][2] + m[2][0], m[1][2] + m[2][1], 1 + 2 * m[2][2] - trace};
  }
  const double scale = (q.w < 0 ? -1 : 1) / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w * scale, q.x * scale, q.y * scale, q.z * scale};
}

AffineTransform PlaceUpright(Vec3f p, float yaw, float scale) {
  const float c = std::cos(yaw) * scale, s = std::sin(yaw) * scale;
  return {{{{{c, -s, 0}, {s, c, 0}, {0, 0, scale}}}}, p};
}

RigidTransform BodyPose(Vec3d p_WB, double yaw, double pitch, double roll) {
  return {RotationZ(yaw) * RotationY(-pitch) * RotationX(roll), p_WB};
}

RigidTransform CameraInBody() {
  // Columns are the camera's right, down and forward axes in the body frame.
  return {Mat3d::FromColumns({0, -1, 0}, {0, 0, -1}, {1, 0, 0}), {}};
}

}  // namespace airsim360

#include "airsim360/eval/sphere/panorama_ray.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"

namespace airsim360 {

Vec3d PanoramaRay(double x, double y, int width, int height) {
  const double theta = 2 * kPi * (x / width - 0.5), phi = kPi * (0.5 - y / height);
  return {std::cos(phi) * std::sin(theta), -std::sin(phi), std::cos(phi) * std::cos(theta)};
}

Vec2d PanoramaPlace(Vec3d direction, int width, int height) {
  const double theta = std::atan2(direction.x, direction.z), phi = std::asin(std::clamp(-direction.y / Norm(direction), -1.0, 1.0));
  return {(theta / (2 * kPi) + 0.5) * width, (0.5 - phi / kPi) * height};
}

Mat3d TurnedCamera(double yaw, double pitch, double roll) {
  const double cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch), cr = std::cos(roll), sr = std::sin(roll);
  return Mat3d::FromColumns({cy * cr + sy * sp * sr, cp * sr, -sy * cr + cy * sp * sr},
                            {-cy * sr + sy * sp * cr, cp * cr, sy * sr + cy * sp * cr}, {sy * cp, -sp, cy * cp});
}

}  // namespace airsim360

#include "airsim360/projection/camera.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/projection/calibrated_lens.h"
#include "airsim360/projection/fisheye_radius.h"

namespace airsim360 {
namespace {

// Position in [0, width] x [0, height], edges included so that rounding loses no ray.
bool Inside(Vec2d pixel, int width, int height) { return pixel.x >= 0 && pixel.x <= width && pixel.y >= 0 && pixel.y <= height; }

Vec3d Ray(const Equirectangular& c, Vec2d pixel) {
  const double theta = 2 * kPi * (pixel.x / c.width - 0.5), phi = kPi * (0.5 - pixel.y / c.height);
  const double cos_phi = std::cos(phi);
  return {cos_phi * std::sin(theta), -std::sin(phi), cos_phi * std::cos(theta)};
}

Vec3d Ray(const CubeFace& c, Vec2d pixel) {
  const Vec3d ray_F{2 * pixel.x / c.size - 1, 2 * pixel.y / c.size - 1, 1};
  return CubeFaceRotation(c.face) * Normalized(ray_F);
}

Vec3d Ray(const Pinhole& c, Vec2d pixel) { return Normalized(Vec3d{(pixel.x - c.cx) / c.fx, (pixel.y - c.cy) / c.fy, 1}); }

std::optional<Vec3d> Ray(const Fisheye& c, Vec2d pixel) {
  const double x = (pixel.x - c.cx) / c.fx, y = (pixel.y - c.cy) / c.fy;
  const double r = std::hypot(x, y);
  const auto theta = internal::ThetaOfRadius(c, r);
  if (!theta) return std::nullopt;
  const double s = r > 0 ? std::sin(*theta) / r : 1;
  return Vec3d{s * x, s * y, std::cos(*theta)};
}

std::optional<Vec2d> Pixel(const Equirectangular& c, Vec3d ray) {
  const double theta = std::atan2(ray.x, ray.z), phi = std::atan2(-ray.y, std::hypot(ray.x, ray.z));
  // theta = pi is the same meridian as -pi: column 0.
  const double x = c.width * (theta / (2 * kPi) + 0.5);
  return Vec2d{x >= c.width ? 0 : x, c.height * (0.5 - phi / kPi)};
}

std::optional<Vec2d> Pixel(const CubeFace& c, Vec3d ray) {
  const Vec3d ray_F = CubeFaceRotation(c.face).transpose() * ray;
  if (!(ray_F.z > 0) || std::abs(ray_F.x) > ray_F.z || std::abs(ray_F.y) > ray_F.z) return std::nullopt;
  return Vec2d{(ray_F.x / ray_F.z + 1) * c.size / 2, (ray_F.y / ray_F.z + 1) * c.size / 2};
}

std::optional<Vec2d> Pixel(const Pinhole& c, Vec3d ray) {
  if (!(ray.z > 0)) return std::nullopt;
  const Vec2d pixel{c.fx * ray.x / ray.z + c.cx, c.fy * ray.y / ray.z + c.cy};
  return Inside(pixel, c.width, c.height) ? std::optional(pixel) : std::nullopt;
}

std::optional<Vec2d> Pixel(const Fisheye& c, Vec3d ray) {
  const double across = std::hypot(ray.x, ray.y);
  const double theta = std::atan2(across, ray.z);
  if (!(theta <= c.max_theta * (1 + 1e-15))) return std::nullopt;
  // Straight back there is no direction to go from the centre; +x is as good as any.
  const double r = internal::RadiusOfTheta(c, theta);
  const Vec2d along = across > 0 ? Vec2d{ray.x / across, ray.y / across} : Vec2d{1, 0};
  const Vec2d pixel{c.fx * r * along.x + c.cx, c.fy * r * along.y + c.cy};
  return Inside(pixel, c.width, c.height) ? std::optional(pixel) : std::nullopt;
}

std::optional<Vec3d> Ray(const CalibratedLens& c, Vec2d pixel) { return internal::LensRay(c, pixel); }

std::optional<Vec2d> Pixel(const CalibratedLens& c, Vec3d ray) {
  const std::optional<Vec2d> pixel = internal::ProjectLens(c, ray);
  return pixel && Inside(*pixel, c.width, c.height) ? pixel : std::nullopt;
}

struct Size {
  int width, height;
};

Size Of(const CubeFace& c) { return {c.size, c.size}; }

template <class C>
Size Of(const C& c) {
  return {c.width, c.height};
}

Size SizeOf(const Camera& camera) {
  return std::visit([](const auto& c) { return Of(c); }, camera);
}

[[noreturn]] void ThrowBadCamera(const std::string& what) { throw InputError("camera: " + what); }

void Check(const Equirectangular& c) {
  if (c.width != 2 * int64_t{c.height}) {
    ThrowBadCamera("an equirectangular picture is twice as wide as high, not " + std::to_string(c.width) + "x" + std::to_string(c.height));
  }
}

void Check(const CubeFace&) {}

template <class C>
void CheckFocal(const C& c) {
  const bool finite = std::isfinite(c.fx) && std::isfinite(c.fy) && std::isfinite(c.cx) && std::isfinite(c.cy);
  if (!finite || c.fx <= 0 || c.fy <= 0) ThrowBadCamera("fx and fy must be positive, cx and cy finite");
}

void Check(const Pinhole& c) { CheckFocal(c); }

void Check(const CalibratedLens& c) {
  CheckFocal(c);
  internal::CheckLens(c);
}

void Check(const Fisheye& c) {
  CheckFocal(c);
  if (!(c.max_theta > 0 && c.max_theta <= kPi)) ThrowBadCamera("max_theta must be in (0, pi]");
  for (double k : c.k) {
    if (!std::isfinite(k)) ThrowBadCamera("fisheye coefficients must be finite");
  }
  if (!internal::RadiusGrows(c)) {
    ThrowBadCamera("the fisheye radius stops growing before max_theta = " + std::to_string(c.max_theta) +
                   "; lower max_theta or correct k1..k4");
  }
}

}  // namespace

Fisheye Fisheye::Equidistant(int width, int height, double fov) {
  if (!(fov > 0 && fov <= 2 * kPi)) ThrowBadCamera("fov must be in (0, 2 pi]");
  const double f = std::min(width, height) / fov;
  return {.width = width, .height = height, .fx = f, .fy = f, .cx = width / 2.0, .cy = height / 2.0, .k = {}, .max_theta = fov / 2};
}

int Width(const Camera& camera) { return SizeOf(camera).width; }
int Height(const Camera& camera) { return SizeOf(camera).height; }

std::optional<Vec3d> PixelToRay(const Camera& camera, Vec2d pixel) {
  return std::visit([&](const auto& c) -> std::optional<Vec3d> { return Ray(c, pixel); }, camera);
}

std::optional<Vec2d> RayToPixel(const Camera& camera, Vec3d ray) {
  return std::visit([&](const auto& c) { return Pixel(c, ray); }, camera);
}

void CheckCamera(const Camera& camera) {
  const auto [width, height] = SizeOf(camera);
  if (width < 1 || height < 1) {
    ThrowBadCamera("a picture of " + std::to_string(width) + "x" + std::to_string(height) + " pixels has no content");
  }
  std::visit([](const auto& c) { Check(c); }, camera);
}

Mat3d CubeFaceRotation(CubeFaceName face) {
  // Columns: right, down and forward of the face in C.
  static constexpr Vec3d kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};
  switch (face) {
    case CubeFaceName::kPosX:
      return Mat3d::FromColumns(-kZ, kY, kX);
    case CubeFaceName::kNegX:
      return Mat3d::FromColumns(kZ, kY, -kX);
    case CubeFaceName::kPosY:
      return Mat3d::FromColumns(kX, -kZ, kY);
    case CubeFaceName::kNegY:
      return Mat3d::FromColumns(kX, kZ, -kY);
    case CubeFaceName::kPosZ:
      return Mat3d::FromColumns(kX, kY, kZ);
    case CubeFaceName::kNegZ:
      return Mat3d::FromColumns(-kX, kY, -kZ);
  }
  throw InputError("camera: not a cube face");
}

CubePixel RayToCube(Vec3d ray, int size) {
  // The axis of largest magnitude; written out, because this is the inner loop of stitching.
  const double ax = std::abs(ray.x), ay = std::abs(ray.y), az = std::abs(ray.z);
  const double half = size / 2.0;
  const auto at = [&](CubeFaceName face, double right, double down, double forward) {
    return CubePixel{face, {(right / forward + 1) * half, (down / forward + 1) * half}};
  };
  if (az >= ax && az >= ay) {
    return ray.z > 0 ? at(CubeFaceName::kPosZ, ray.x, ray.y, az) : at(CubeFaceName::kNegZ, -ray.x, ray.y, az);
  }
  if (ax >= ay) {
    return ray.x > 0 ? at(CubeFaceName::kPosX, -ray.z, ray.y, ax) : at(CubeFaceName::kNegX, ray.z, ray.y, ax);
  }
  return ray.y > 0 ? at(CubeFaceName::kPosY, ray.x, -ray.z, ay) : at(CubeFaceName::kNegY, ray.x, ray.z, ay);
}

}  // namespace airsim360

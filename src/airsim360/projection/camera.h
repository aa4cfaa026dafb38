// Camera models: pixel <-> ray in the camera frame C (+X right, +Y down, +Z forward), in double precision.
// A pixel position is continuous, in pixels: the centre of the pixel in column i, row j is (i + 0.5, j +
// 0.5).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

#include "airsim360/math/transform.h"
#include "airsim360/math/vector.h"

namespace airsim360 {

/// Full sphere, width = 2 * height (COLMAP's EQUIRECTANGULAR): theta = 2 pi (x / W - 1/2), phi = pi (1/2 - y
/// / H), ray = (cos phi sin theta, -sin phi, cos phi cos theta).
struct Equirectangular {
  int width = 2048, height = 1024;
};

/// One face of a cube map: a 90 degree pinhole turned to face an axis of C. +z front, +x right, -z back, -x
/// left; the up face (-y) has the back at its top, the down face (+y) the front at its top, as when pitching
/// a camera up or down.
enum class CubeFaceName { kPosX, kNegX, kPosY, kNegY, kPosZ, kNegZ };
struct CubeFace {
  CubeFaceName face = CubeFaceName::kPosZ;
  int size = 512;
};

/// Pinhole: x = fx X / Z + cx, y = fy Y / Z + cy.
struct Pinhole {
  int width = 1024, height = 768;
  double fx = 512, fy = 512, cx = 512, cy = 384;
};

/// Fisheye with r = theta + k1 theta^3 + k2 theta^5 + k3 theta^7 + k4 theta^9 (Kannala-Brandt, OpenCV's
/// fisheye), theta the angle from +Z; all k = 0 is the equidistant fisheye. Pixels with theta > max_theta
/// have no ray.
struct Fisheye {
  int width = 1024, height = 1024;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  std::array<double, 4> k{};
  double max_theta = 0;  ///< radians, at most pi

  /// Equidistant fisheye that shows `fov` radians across the shorter side.
  static Fisheye Equidistant(int width, int height, double fov);
};

using Camera = std::variant<Equirectangular, CubeFace, Pinhole, Fisheye>;

int Width(const Camera& camera);
int Height(const Camera& camera);

/// Unit ray of C through a pixel position, or nullopt where the camera sees nothing (outside a fisheye's
/// circle).
std::optional<Vec3d> PixelToRay(const Camera& camera, Vec2d pixel);

/// Pixel position that sees the direction `ray` (any length > 0), or nullopt if the camera does not see it.
/// Equirectangular: x in [0, W); at the poles x is 0 or W / 2 by convention of atan2.
std::optional<Vec2d> RayToPixel(const Camera& camera, Vec3d ray);

/// Solid angle of the pixel in column i, row j, steradians: closed forms for equirectangular, cube and
/// pinhole, a line integral good to about 1e-12 for fisheye, where only the part of the pixel within
/// max_theta counts.
double SolidAngle(const Camera& camera, int i, int j);

/// InputError unless the camera makes sense: sides of at least one pixel, width = 2 height for
/// equirectangular, finite numbers, positive focal lengths, 0 < max_theta <= pi and a radius r that grows all
/// the way to max_theta. The functions above expect a camera that passes.
void CheckCamera(const Camera& camera);

/// "+x", "-x", "+y", "-y", "+z", "-z", in this order.
inline constexpr std::array<const char*, 6> kCubeFaceNames = {"+x", "-x", "+y", "-y", "+z", "-z"};

/// Rotation R_CF of a face's own pinhole frame F (right, down, forward) in C.
Mat3d CubeFaceRotation(CubeFaceName face);

/// The face that sees `ray` and where, for faces of `size` pixels. On an edge shared by faces: z before x
/// before y.
struct CubePixel {
  CubeFaceName face;
  Vec2d pixel;
};
CubePixel RayToCube(Vec3d ray, int size);

}  // namespace airsim360

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
  friend bool operator==(const Equirectangular&, const Equirectangular&) = default;
};

/// One face of a cube map: a 90 degree pinhole turned to face an axis of C. +z front, +x right, -z back, -x
/// left; the up face (-y) has the back at its top, the down face (+y) the front at its top, as when pitching
/// a camera up or down.
enum class CubeFaceName { kPosX, kNegX, kPosY, kNegY, kPosZ, kNegZ };
struct CubeFace {
  CubeFaceName face = CubeFaceName::kPosZ;
  int size = 512;
  friend bool operator==(const CubeFace&, const CubeFace&) = default;
};

/// Pinhole: x = fx X / Z + cx, y = fy Y / Z + cy.
struct Pinhole {
  int width = 1024, height = 768;
  double fx = 512, fy = 512, cx = 512, cy = 384;
  friend bool operator==(const Pinhole&, const Pinhole&) = default;
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
  friend bool operator==(const Fisheye&, const Fisheye&) = default;
};

/// Radius rho in a plane of what is theta from a lens's axis, before its distortion. h is CalibratedLens::shape.
enum class LensLaw {
  kPerspective,      ///< tan theta
  kEquidistant,      ///< theta (1 + h0 theta^2 + h1 theta^4 + … + h5 theta^12)
  kFieldOfView,      ///< atan(2 tan theta tan(h0 / 2)) / h0 (Devernay and Faugeras 2001)
  kUnifiedSphere,    ///< sin theta / (h0 + cos theta) (Mei and Rives 2007), h0 = xi
  kDoubleSphere,     ///< sin theta / (h1 d + (1 - h1)(h0 + cos theta)), d^2 = sin^2 theta + (h0 + cos theta)^2 (Usenko,
                     ///< Demmel and Cremers 2018), h0 = xi, h1 = alpha
  kExtendedUnified,  ///< sin theta / (h0 d + (1 - h0) cos theta), d^2 = h1 sin^2 theta + cos^2 theta (Khomutenko, Garcia
                     ///< and Martinet 2016), h0 = alpha, h1 = beta
  kAngleToRadius     ///< h0 theta + h1 theta^2 + … + h5 theta^6 (f-theta)
};

/// A lens as calibrations describe it: (u, v) = rho (cos psi, sin psi) of the law, psi the angle around the axis, then, with
/// q = u^2 + v^2 and OpenCV's k, p and s,
///   R  = (1 + radial0 q + radial1 q^2 + radial2 q^3 + radial3 q^4) / (1 + divisor0 q + divisor1 q^2 + divisor2 q^3)
///   u' = u R + 2 p1 u v + p2 (q + 2 u^2) + s1 q + s2 q^2
///   v' = v R + p1 (q + 2 v^2) + 2 p2 u v + s3 q + s4 q^2
/// x = fx u' + cx, y = fy v' + cy. Nothing beyond max_theta is seen. projection/camera_model_names.h makes one by its name.
struct CalibratedLens {
  LensLaw law = LensLaw::kPerspective;
  int width = 1024, height = 768;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  std::array<double, 6> shape{};
  std::array<double, 4> radial{};
  std::array<double, 3> divisor{};
  std::array<double, 2> tangential{};  ///< p1, p2
  std::array<double, 4> prism{};       ///< s1 … s4
  double max_theta = 0;                ///< radians, at most pi
  friend bool operator==(const CalibratedLens&, const CalibratedLens&) = default;
};

using Camera = std::variant<Equirectangular, CubeFace, Pinhole, Fisheye, CalibratedLens>;

int Width(const Camera& camera);
int Height(const Camera& camera);

/// Unit ray of C through a pixel position, or nullopt where the camera sees nothing (outside a fisheye's
/// circle).
std::optional<Vec3d> PixelToRay(const Camera& camera, Vec2d pixel);

/// Pixel position that sees the direction `ray` (any length > 0), or nullopt if the camera does not see it.
/// Equirectangular: x in [0, W); at the poles x is 0 or W / 2 by convention of atan2.
std::optional<Vec2d> RayToPixel(const Camera& camera, Vec3d ray);

/// Where the plane of the picture, continued beyond its borders, shows a direction; one beyond max_theta is taken to the
/// edge of the field.
Vec2d ProjectBeyond(const CalibratedLens& lens, Vec3d ray);

/// Solid angle of the pixel in column i, row j, steradians: closed forms for equirectangular, cube and
/// pinhole, a line integral good to about 1e-12 for fisheye, where only the part of the pixel within
/// max_theta counts; of a calibrated lens that of the two triangles between the rays of its corners, and where its
/// field ends so many of 64 parts of it as have a ray.
double SolidAngle(const Camera& camera, int i, int j);

/// InputError unless the camera makes sense: sides of at least one pixel, width = 2 height for
/// equirectangular, finite numbers, positive focal lengths, 0 < max_theta <= pi and a radius r that grows all
/// the way to max_theta without folding over. The functions above expect a camera that passes.
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

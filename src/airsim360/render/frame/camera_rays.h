// The rays of a camera's pixels in W, in a form that fills packets fast.
//
// Panoramas are rendered in canonical columns. The rotation of the camera is split as R_WC = R0 *
// Ry(column_shift * 2 pi / W): R0 depends only on the camera's vertical axis and on the angle left over by
// whole columns, both rounded to steps far below a float's resolution (2e-10), so that two poses that differ
// by a turn of k columns give the same R0, the same rays and the same packets, bit for bit. Canonical column
// c is image column (c - column_shift) mod W.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "airsim360/projection/camera.h"
#include "airsim360/render/frame/tile_size.h"

namespace airsim360::internal {

/// What packet-filling code needs; arrays go on to the next multiple of kTileSize with finite values.
struct RayField {
  int width, height;
  /// Equirectangular: direction = row_scale[r] * column[c] + row[r], in W.
  bool separable;
  const double *column_x, *column_y, *column_z;
  const double *row_scale, *row_x, *row_y, *row_z;
  /// Others: direction = R * ray[r * stride + c], rays in C; a pixel without a ray has has_ray = 0.
  const float *ray_x, *ray_y, *ray_z;
  const int32_t* has_ray;  // -1 or 0
  int stride;
  double R[9];
};

/// A point of a pixel relative to its centre, in pixels, and the sines and cosines of the angles that makes
/// in a panorama.
struct PixelOffset {
  double dx, dy;
  double sin_theta, cos_theta, sin_phi, cos_phi;
};

class CameraRays {
 public:
  /// Makes the tables of a camera and turns them to a rotation. Tables of cameras that are no panoramas are kept, up to
  /// 256 MiB (16 bytes a pixel): the cameras of a rig come round again. InputError for a camera without pixels.
  void Update(const Camera& camera, const Mat3d& R_WC);

  const RayField& field() const { return field_; }
  int column_shift() const { return column_shift_; }
  /// Angle between neighbouring pixels (pi / H of a panorama; at the image centre of the others), radians.
  double cone_angle() const { return cone_angle_; }
  /// Direction in W (unit to a float's precision) through a point of a canonical pixel; false where there is
  /// no ray.
  bool Direction(int column, int row, const PixelOffset& offset, Vec3d& direction_W) const;
  /// The offset (dx, dy) from a pixel's centre, |dx|, |dy| <= 0.5, for the current camera.
  PixelOffset MakeOffset(double dx, double dy) const;

 private:
  /// Rays of a camera that is no panorama.
  struct Table {
    Camera camera;
    std::vector<float> rays;  // x, y, z planes
    std::vector<int32_t> has_ray;
    double cone_angle = 0;
  };
  static std::shared_ptr<const Table> MakeTable(const Camera& camera);

  void MakeSeparable(const Equirectangular& camera);
  void UseTable(const Camera& camera);
  void TurnSeparable(const Mat3d& R_WC);

  Camera camera_ = Equirectangular{0, 0};
  RayField field_{};
  int column_shift_ = 0;
  double cone_angle_ = 0;
  Mat3d R0_;
  std::vector<double> sin_theta_, cos_theta_, sin_phi_, cos_phi_;
  std::vector<double> columns_, rows_;                // x, y, z planes; rows: scale, x, y, z
  std::vector<std::shared_ptr<const Table>> tables_;  // the one used last at the end
};

}  // namespace airsim360::internal

// The planes that the filter's kernels read and write: plain data only, because kernels are compiled once per
// instruction set.
#pragma once

#include <cstdint>

namespace airsim360::internal {

/// Rows of `stride` numbers, in canonical columns (see camera_rays.h). Column c + wrap repeats column c; the
/// kFilterPad columns after `wrap` are copies of the first, so that a vector may start at any column.
struct FilterPlanes {
  int width, height;
  int wrap;  ///< width of a panorama; others have empty columns up to it, wider than any step
  int stride;
  bool sphere;           ///< rows go on across the poles, half a turn away
  float cone_angle;      ///< radians a pixel
  float plane_slope;     ///< tolerance of the plane test: pixel widths a pixel of step
  uint32_t* id;          ///< of the surface; kNoSurface = none
  uint32_t* data_id[2];  ///< the same where there is light, else 0
  float* p[3];           ///< position from the camera, W axes, metres
  float* n[3];           ///< shading normal
  float* g[3];           ///< normal of the pixel's plane
  float* light[2][3];
  float* samples;
  float* window;    ///< variance of luminance among like neighbours; -1 = too few
  float* own;       ///< squared distance of a pixel's luminance beyond all its neighbours'
  float* loose;     ///< 1: no like neighbours (leaves); 0: a surface
  float* variance;  ///< of luminance, as an estimate of noise
};
inline constexpr uint32_t kNoSurface = 0xffffffffu;
inline constexpr int kFilterPad = 16;

/// One row of the images that the planes are filled from, in image columns; triples are interleaved.
struct FilterSource {
  const float* range;
  const uint32_t* entity;
  const float *normal, *geometric_normal;  ///< the second may be null
  const float* light;
  const uint8_t* samples;  ///< null = one each
  int column_shift;        ///< canonical column c is image column (c - column_shift) mod width
  /// Directions in W as in RayField: row_scale * column[c] + row; null = positions are filled in elsewhere.
  const double *column_x, *column_y, *column_z;
  double row_scale, row_x, row_y, row_z;
};

/// What the last frame of the same size saw.
struct FilterPast {
  static constexpr int kFloats = 12;
  const float* pixels;  ///< kFloats each: position, bits of the surface (0 = no light), normal, samples, light, 0
  int stride;           ///< pixels from row to row
  float R[9];           ///< row-major, W to the last frame's canonical axes
  float offset[3];      ///< camera now minus camera then, in W
  /// Pixel positions then of this row's points; null = a panorama, where the kernel finds them itself.
  const float *x, *y;
};

}  // namespace airsim360::internal

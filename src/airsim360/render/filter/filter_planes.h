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

/// Where the points of one row were in the last frame's picture (a panorama).
struct ReprojectedRow {
  float R[9];       ///< row-major, W to the last frame's canonical axes
  float offset[3];  ///< camera now minus camera then, in W
  float *x, *y;     ///< out: pixel position then, in canonical columns
};

}  // namespace airsim360::internal

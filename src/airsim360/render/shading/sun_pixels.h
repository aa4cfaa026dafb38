// What the sun does at the centres of pixels, so that further samples need not ask again.
#pragma once

#include <cstdint>

#include "airsim360/render/shading/shading_data.h"

namespace airsim360 {

/// The plane under a pixel's centre, and whether it sees the sun.
struct SunPixel {
  enum State : int16_t {
    kUnknown,  ///< no surface, one that faces away, or part of the light comes through
    kDark,
    kLit
  };
  int16_t nx, ny, nz;  ///< geometric normal towards the camera, of 32767
  int16_t state;
  float offset;  ///< of the plane from the camera along the normal, m
};

/// The pixels of a picture, and the one that each hit of a HitBatch belongs to.
struct SunNeighbours {
  const SunPixel* pixels;
  int width, height;
  bool wraps;  ///< columns
  const int *x, *y;
};

namespace internal {

/// `asked`: whether the sun can matter to each surface. Fills out[slot].
void KeepSun(const RaySet& rays, const SurfaceSet& s, const bool* asked, SunPixel* out);
/// What the nine pixels around a sample say of the sun on surface `i`: 1 or 0 where at least three of them
/// lie on its plane and all of those agree, else -1.
float GuessSun(const SunNeighbours& around, const RaySet& rays, const SurfaceSet& s, int i);

}  // namespace internal
}  // namespace airsim360

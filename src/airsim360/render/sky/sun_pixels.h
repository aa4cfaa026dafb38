// What sun and reflections do at the centres of pixels, so that further samples need not ask again.
#pragma once

#include <cstdint>

#include "airsim360/math/vector.h"
#include "airsim360/render/shared/shading_data.h"

namespace airsim360 {

/// The plane under a pixel's centre, and whether it sees the sun.
struct SunPixel {
  enum State : int16_t {
    kUnknown,  ///< no surface, one that faces away, or part of the light comes through
    kDark,
    kLit,
    kDarkLeaf,
    kLitLeaf
  };
  int16_t nx, ny, nz;  ///< geometric normal towards the camera, of 32767
  int16_t state;
  float offset;        ///< of the plane from the camera along the normal, m; of a leaf: its distance from the camera
  uint32_t reflected;  ///< radiance seen in a pane, packed by PackLight; 0 = no pane
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
/// lie on its plane and all of those agree. A leaf takes the answer of one of the leaves about as far away,
/// by chance (of the ray's key), where there are at least three: in a crown that is the same on average.
/// Else -1.
float GuessSun(const SunNeighbours& around, const RaySet& rays, const SurfaceSet& s, int i);

/// Adds what was traced to be seen in panes.
void KeepReflections(const RaySet& rays, const SurfaceSet& s, SunPixel* out);
/// Panes take the mean of what at least three of the pixels around see in the same plane, where
/// those are about as bright; they need no ray then
/// (mirror = 0, traced = 1).
void GuessReflections(const SunNeighbours& around, const RaySet& rays, SurfaceSet& s);

/// Three numbers >= 0 with nine bits each and one exponent (up to 65000, to within 1/512 of the largest);
/// never 0.
uint32_t PackLight(Vec3f light);
Vec3f UnpackLight(uint32_t packed);

}  // namespace internal
}  // namespace airsim360

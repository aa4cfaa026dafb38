// Which pixels a closed body would cover if nothing were in front of it: exact, by the rays through the pixel
// centres, as the renderer sends them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "airsim360/projection/camera.h"
#include "airsim360/sim/people/person_label.h"

namespace airsim360 {

/// Covered pixels of one body.
struct Silhouette {
  std::optional<PictureBox> box;  ///< tight; nullopt: no pixel
  int64_t pixels = 0;
  std::vector<uint8_t> mask;  ///< of the box, row by row; columns of a panorama go on across the seam
};

/// Directions of the pixels of one camera, worked out once for many silhouettes.
class PixelDirections {
 public:
  explicit PixelDirections(const Camera& camera);
  const Camera& camera() const { return camera_; }
  /// Unit ray of C through the centre of pixel (i, j); (0, 0, 0) where there is none.
  Vec3f At(int i, int j) const;

 private:
  Camera camera_;
  std::vector<Vec2f> columns_, rows_;  // panoramas: sine and cosine of longitudes and latitudes
};

/// Silhouette of triangles with corners `p_C` (in C, metres from the camera), `triangles` indices into it.
Silhouette FindSilhouette(const PixelDirections& directions, std::span<const Vec3f> p_C, std::span<const Vec3u> triangles);

}  // namespace airsim360

// What the last frame saw, for reuse where the same surface point is seen again.
#pragma once

#include <vector>

#include "airsim360/render/filter/filter_buffers.h"

namespace airsim360::internal {

class LightHistory {
 public:
  /// Mixes the history into light and samples of set 0 of the planes, then keeps a copy of them.
  void Accumulate(const FilterGuides& guides, FilterBuffers& buffers);

 private:
  struct Seen;
  void MixRow(const FilterGuides& guides, FilterBuffers& buffers, int y) const;
  void FindRow(const FilterGuides& guides, const FilterPlanes& planes, int y, float* x_px, float* y_px) const;
  Seen Look(const FilterPlanes& now, size_t i, float x_px, float y_px) const;
  void Keep(const FilterGuides& guides, const FilterBuffers& buffers);

  int width_ = 0, height_ = 0, wrap_ = 0;
  size_t stride_ = 0;
  bool sphere_ = false;
  Camera camera_;
  Mat3d R0_;  // canonical axes of that frame
  Vec3d p_;
  Vec3f offset_;  // camera now minus camera then, while accumulating
  std::vector<uint32_t> id_;
  std::vector<float> planes_;  // position, normal, light, samples
};

}  // namespace airsim360::internal

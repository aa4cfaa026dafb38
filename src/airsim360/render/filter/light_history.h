// What the last frame saw, for reuse where the same surface point is seen again.
#pragma once

#include "airsim360/base/table_vector.h"
#include "airsim360/render/filter/filter_buffers.h"

namespace airsim360::internal {

class LightHistory {
 public:
  /// Mixes the history into light and samples of set 0 of the planes, then keeps a copy of them. Set 1 serves
  /// as scratch.
  void Accumulate(const FilterGuides& guides, FilterBuffers& buffers);

 private:
  void Mix(const FilterGuides& guides, FilterBuffers& buffers) const;
  void Keep(const FilterGuides& guides, const FilterBuffers& buffers);
  void FindRow(const FilterPlanes& planes, int y, const float* offset, float* x_px, float* y_px) const;

  int width_ = 0, height_ = 0;
  int stride_ = 0;
  bool sphere_ = false;
  Camera camera_;
  Mat3d R0_;  // canonical axes of that frame
  Vec3d p_;
  TableVector<float> pixels_;  // see FilterPast
};

}  // namespace airsim360::internal

// What the sun sees, once for a whole scene: how far light that is reflected once must look.
#pragma once

#include <vector>

#include "airsim360/base/table_vector.h"
#include "airsim360/render/shared/shading_data.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// An orthographic depth map along the sun's direction over the detailed part of a scene (DetailBounds),
/// which tells for about a nanosecond whether a point is sunlit, to within a texel. Immutable; the same bytes
/// with any number of threads.
class SunMap {
 public:
  /// `size` texels a side, a multiple of 4, but none smaller than 5 cm.
  SunMap(const RayTracer& tracer, Vec3f to_sun, int size = 1024);

  SunMapView view() const;
  /// Whether the map says that the sun is seen from p (for tests: the kernel's formula).
  bool Sunlit(Vec3f p) const;
  float texel() const { return texel_; }

 private:
  void Bake(const RayTracer& tracer);

  int size_;
  float texel_;  ///< metres
  Vec3f right_, up_, to_sun_;
  float left_, bottom_, top_;  ///< edges along right_ and up_; height above everything
  TableVector<float> heights_;
};

}  // namespace airsim360::internal

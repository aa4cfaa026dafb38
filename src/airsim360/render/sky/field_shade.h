// How much of a low sun the clouds of a field leave each other.
#pragma once

#include <array>

#include "airsim360/math/vector.h"
#include "airsim360/render/sky/cloud_layer.h"

namespace airsim360::internal {

/// Mean share of the sun's direct light that the rest of a layer lets through to a point within it, over all points of an altitude:
/// of what lies further than `first` metres towards the sun, where a march from the point has ended. 1 once a ray leaves the layer
/// before that, as it does under a high sun. Immutable.
class FieldShade {
 public:
  FieldShade(const CloudLayer& layer, Vec3f to_sun, float first);
  float At(float altitude) const;

 private:
  static constexpr int kHeights = 9;  // from the lowest cloud to the highest

  float lowest_, per_metre_;
  std::array<float, kHeights> share_{};
};

}  // namespace airsim360::internal

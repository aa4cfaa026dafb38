// The trees of parks and woods: species with several individuals each, in three levels of detail.
#pragma once

#include <cstdint>
#include <string_view>

#include "airsim360/scene/model_source.h"

namespace airsim360::internal {

enum class ParkTree { kElm, kMaple, kWillow, kPine, kCork, kPoplar, kCount };

/// kFull: every leaf, 80,000 to 400,000 triangles. kMiddle: for 200 m and more. kFar: for 450 m and more,
/// 2,000 to 5,000 triangles.
enum class TreeDetail { kFull, kMiddle, kFar };

struct ParkTreeInfo {
  std::string_view name;
  std::string_view category;  ///< path in the semantic tree
  int individuals[3];         ///< by TreeDetail
};
const ParkTreeInfo& InfoOf(ParkTree species);

/// One individual; 0 of the elms is the large one that stands alone. Metres, standing on z = 0.
Model MakeParkTree(ParkTree species, TreeDetail detail, int individual, uint64_t seed);

/// Weeping willow: a dome of branches with curtains of hanging shoots. `detail` in (0, 1] as in Simplified.
Model GrowWillow(float height, float radius, float detail, uint64_t seed);
/// Pine, see conifers.cc; `needles` in (0, 1].
Model GrowPine(int individual, float detail, uint64_t seed);

}  // namespace airsim360::internal

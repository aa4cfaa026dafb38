// Worlds that the benches generate.
#pragma once

#include <memory>

#include "airsim360/scene/scene.h"

namespace airsim360::bench {

struct CityOptions {
  long triangles = 2'000'000;  ///< at least, in one mesh: half terrain, half towers, an entity for each tower
  int trees = 0;               ///< instances of a mesh of 5,000 triangles, no alpha
};
std::shared_ptr<const Scene> BuildCity(const CityOptions& options);

/// Trees of 1,200 triangles with alpha-tested leaf pictures over 300 x 300 m.
std::shared_ptr<const Scene> BuildForest(int trees);

}  // namespace airsim360::bench

// Windows for city models: plain walls of buildings get the facades that the buildings of maps have.
#pragma once

#include <cstdint>
#include <memory>

#include "airsim360/scene/scene.h"

namespace airsim360 {

/// The same scene, entities and ids as they are (balconies and the like follow them), with facades on the plain walls of its buildings (category
/// construction/building): on what is upright, at least 2.2 m long and 2.4 m high below the lowest of its upper edges,
/// and free of neighbours. Buildings that have windows or doors of their own stay as they are. Storeys are those that
/// need the least stretching; depth falls with the distance from the middle as in maps (docs/guide/maps.md).
std::shared_ptr<const Scene> WithFacades(std::shared_ptr<const Scene> scene, uint64_t seed);

}  // namespace airsim360

// What a world is besides surfaces and labels, as text inside the models that `world export` writes.
#pragma once

#include <string>

#include "airsim360/assets/imported.h"
#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// Sun, weather, viewpoint, light of closed rooms, credits, and the entities that no node shows. A sky picture
/// stays out. `seen[id]` is whether a node shows an entity.
std::string WriteWorld(const Scene& scene, const std::vector<bool>& seen);

/// The reverse. InputError, which `file` starts, for damage or a value out of its range.
WrittenWorld ReadWrittenWorld(const std::string& file, const std::string& text);

}  // namespace airsim360::internal

// Models of a world file, set into a built-in world.
#pragma once

#include "airsim360/scene/scene.h"
#include "airsim360/worlds/props/props.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360::internal {

/// Adds each as an entity of its own category, which may be one that the tree lacks so far.
void AddPlacedModels(SceneBuilder& builder, PropShelf& shelf, const std::vector<PlacedModel>& models);

}  // namespace airsim360::internal

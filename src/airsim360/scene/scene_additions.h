// Adding to a scene that is built: for what comes after the world, bodies and vehicles.
#pragma once

#include <memory>
#include <string>

#include "airsim360/scene/scene.h"

namespace airsim360 {

/// The scene to be changed: the given one where nobody else has it, else a copy.
std::shared_ptr<Scene> OwnScene(std::shared_ptr<const Scene> scene);

/// Adds an instance as an entity of its own after all others and returns the entity. `instance.entity` counts for nothing;
/// bounds are those of its mesh where it stands. The name must not be taken.
EntityId AddInstanceEntity(Scene& scene, std::string name, CategoryId category, Instance instance);

}  // namespace airsim360

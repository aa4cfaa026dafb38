// Which pieces of a scene's meshes each of its things is made of. For the .cc files of `vln`.
#pragma once

#include <vector>

#include "airsim360/trace/surface_entity.h"

namespace airsim360::internal {

struct EntityPart {
  uint32_t instance = 0, part = 0;  ///< indices of scene.instances and of the parts of its mesh
};

/// By entity; index 0 is what belongs to none.
inline std::vector<std::vector<EntityPart>> PartsByEntity(const Scene& scene) {
  std::vector<std::vector<EntityPart>> by_entity(scene.entities.size() + 1);
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const auto& parts = scene.meshes[instance.mesh].parts;
    for (uint32_t k = 0; k < parts.size(); ++k)
      by_entity[parts[k].entity != kNoEntity ? parts[k].entity : instance.entity].push_back({i, k});
  }
  return by_entity;
}

}  // namespace airsim360::internal

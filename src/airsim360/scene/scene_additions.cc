#include "airsim360/scene/scene_additions.h"

#include <utility>

namespace airsim360 {

// Made by SceneBuilder as a plain Scene, so it may be changed while nobody else looks.
std::shared_ptr<Scene> OwnScene(std::shared_ptr<const Scene> scene) {
  if (scene.use_count() == 1) return std::const_pointer_cast<Scene>(std::move(scene));
  return std::make_shared<Scene>(*scene);
}

EntityId AddInstanceEntity(Scene& scene, std::string name, CategoryId category, Instance instance) {
  instance.entity = static_cast<EntityId>(scene.entities.size() + 1);
  Box3f bounds;
  for (const Vec3f& p : scene.meshes[instance.mesh].positions) bounds.Add(instance.X_WM * p);
  scene.entities.push_back({instance.entity, std::move(name), category, bounds});
  scene.instances.push_back(instance);
  return instance.entity;
}

}  // namespace airsim360

// What of a scene has moved at one instant: the changing counterpart of the immutable Scene.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "airsim360/math/transform.h"
#include "airsim360/math/vector.h"
#include "airsim360/scene/mesh.h"

namespace airsim360 {

/// An instance that stands elsewhere than in Scene::instances.
struct MovedInstance {
  uint32_t instance = 0;  ///< index into Scene::instances
  AffineTransform X_WM;
  bool hidden = false;  ///< not in the world at this instant
};

/// A mesh whose vertices have moved (a skinned body). `positions` is as long as Mesh::positions; normals
/// follow from it.
struct DeformedMesh {
  MeshId mesh = 0;
  std::shared_ptr<const std::vector<Vec3f>> positions;
};

/// Immutable once shared; instances and meshes not named are as the Scene has them. Both lists are sorted and
/// hold each index once.
struct SceneState {
  int64_t t_ns = 0;
  std::vector<MovedInstance> moved;
  std::vector<DeformedMesh> deformed;
};

}  // namespace airsim360

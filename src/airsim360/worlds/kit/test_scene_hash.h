// Whether two worlds that tests build are the same.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "airsim360/base/hash.h"
#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// Of all that a scene shows: two scenes of one hash are the same.
inline std::string SceneHash(const Scene& scene) {
  std::vector<std::byte> bytes;
  const auto add = [&](const auto* data, size_t count) {
    const auto* p = reinterpret_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), p, p + count * sizeof(*data));
  };
  for (const Mesh& mesh : scene.meshes) {
    add(mesh.positions.data(), mesh.positions.size());
    add(mesh.normals.data(), mesh.normals.size());
    add(mesh.uvs.data(), mesh.uvs.size());
    add(mesh.triangles.data(), mesh.triangles.size());
    add(mesh.parts.data(), mesh.parts.size());
  }
  for (const Instance& instance : scene.instances) {
    add(&instance.mesh, 1);
    add(&instance.X_WM, 1);
    add(&instance.entity, 1);
    add(&instance.tint, 1);
  }
  for (const Entity& entity : scene.entities) {
    add(entity.name.data(), entity.name.size());
    add(&entity.category, 1);
    add(&entity.bounds, 1);
  }
  for (const Texture& texture : scene.textures) add(texture.levels[0].pixels().data(), texture.levels[0].size());
  return Sha256Hex(bytes);
}

}  // namespace airsim360::internal

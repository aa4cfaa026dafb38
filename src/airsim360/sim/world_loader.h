// A world by name or by file: built-in worlds, model files (.glb, .gltf, .obj), world YAML.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "airsim360/scene/scene.h"
#include "airsim360/sim/world_city.h"

namespace airsim360 {

struct WorldRequest {
  std::string world;  ///< name of a built-in world, or path to .glb/.gltf/.obj/.yaml
  uint64_t seed = 0;
  std::filesystem::path labels = {};  ///< label override file for imports, see docs/importing.md
  bool use_models = true;             ///< use sweethome3d-furniture where installed
  WorldAdditions additions = {};      ///< what a world file adds
};

/// InputError for an unknown name (naming the nearest), a missing or malformed file.
std::shared_ptr<const Scene> LoadWorld(const WorldRequest& request);

}  // namespace airsim360

// glTF 2.0 (.glb, .gltf) and Wavefront OBJ/MTL into a Scene. Files are untrusted: any damage is an InputError
// that names the file, the place in it and the value; sizes and depths are bounded; nothing crashes.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/scene/model_source.h"
#include "airsim360/scene/scene.h"

namespace airsim360 {

struct ImportOptions {
  /// YAML or JSON that overrides labels, see docs/worlds.md; empty = FILE.labels.yaml beside the model if it
  /// exists.
  std::filesystem::path labels;
};

/// Imports a model file as a world of its own under the default sky. Every node with a mesh (glTF) or
/// object/group (OBJ) is an entity; its category comes from the override file, else from keywords in the
/// node, mesh and material names, else "object".
std::shared_ptr<const Scene> ImportScene(const std::filesystem::path& file,
                                         const ImportOptions& options = {});

/// One model file as a single prop (all nodes merged), in metres and +Z up.
Model ImportModel(const std::filesystem::path& file);

/// The models of Debian's sweethome3d-furniture, read in place; null if the package is not installed. Names
/// are file stems of the catalogue ("poplar", "fordFocus"). Models come at their catalogue size.
std::unique_ptr<ModelSource> OpenSweetHomeModels(
    const std::filesystem::path& folder = "/usr/share/sweethome3d/furniture");

}  // namespace airsim360

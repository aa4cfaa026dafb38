// glTF 2.0: .gltf and .glb.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "airsim360/assets/imported.h"
#include "airsim360/assets/limits.h"

namespace airsim360::internal {

/// Reads a document from the bytes of its file; buffers and pictures beside it come from `load`. Meshes are
/// converted to W axes and are shared by the nodes that show them; the default scene is read, or all root
/// nodes if there is none. Points and lines are left out with a warning. Animated files are read in their
/// pose at rest (skins bound, morph targets at the weights of the mesh). InputError "file: /json/pointer:
/// what (value)", or "file:line:column" where the JSON text breaks.
ImportedFile ReadGltf(const std::string& file, std::span<const std::byte> bytes, const ResourceLoader& load,
                      const ImportLimits& limits = {});

}  // namespace airsim360::internal

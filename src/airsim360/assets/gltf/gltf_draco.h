// KHR_draco_mesh_compression.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "airsim360/assets/gltf/gltf_json_internal.h"
#include "airsim360/assets/limits.h"

namespace airsim360::internal {

/// A decoded primitive: triangles and the attributes asked for, as floats.
struct DracoMesh {
  uint32_t vertices = 0;
  std::vector<uint32_t> indices;
  std::map<std::string, std::vector<float>> attributes;  ///< by glTF name, components as asked
};

/// Decodes a Draco stream. `attributes` gives the extension's "attributes" object (name -> unique id),
/// `components` the floats wanted of each name; others are left out. Fails at `where` (InputError) if the
/// stream is damaged, claims more than the limits or than its bytes can hold.
DracoMesh DecodeDraco(std::span<const std::byte> stream, const JsonRef& where, const JsonRef& attributes,
                      const std::map<std::string, int>& components, const ImportLimits& limits);

}  // namespace airsim360::internal

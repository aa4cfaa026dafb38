// Wavefront MTL: what the file says, and which physical surface that most likely is.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "airsim360/assets/textures/texture_store.h"
#include "airsim360/scene/material.h"

namespace airsim360::internal {

/// One `newmtl` as written; colours are taken as linear light (Blender's exporter writes them so).
struct MtlMaterial {
  std::string name;
  Vec3f diffuse{0.8f, 0.8f, 0.8f}, specular{}, emission{};
  float shininess = 10;  ///< Ns, Blinn-Phong exponent
  float opacity = 1;     ///< d, or 1 - Tr
  int illumination = 2;
  float metallic = -1, roughness = -1;  ///< Pm, Pr of the PBR extension; -1 = not given
  float bump_scale = 1;
  std::string map_diffuse, map_opacity, map_emission, map_normal;
};

/// What a material belongs to; makes guesses better.
struct MtlContext {
  bool vehicle = false;
  bool plant = false;
};

/// All materials of an MTL file. InputError naming file:line for a damaged number or a property outside a
/// material.
std::vector<MtlMaterial> ParseMtl(const std::string& file, std::string_view text);

/// Metallic-roughness material with a surface kind chosen from opacity, highlight and name. Textures come
/// from `load`.
Material ToMaterial(const MtlMaterial& mtl, const MtlContext& context, TextureStore& textures, const ResourceLoader& load);

}  // namespace airsim360::internal

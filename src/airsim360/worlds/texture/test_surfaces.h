// Surfaces without their pictures, for tests of geometry: the material of a surface is its number.
#pragma once

#include "airsim360/worlds/texture/surfaces.h"

namespace airsim360::internal {

inline MaterialId TestMaterial(Surface surface) { return static_cast<MaterialId>(surface); }

/// Adds a plain material for every surface, in their order, to an empty builder.
inline Surfaces AddTestSurfaces(SceneBuilder& builder) {
  Surfaces surfaces;
  for (int i = 0; i < static_cast<int>(Surface::kCount); ++i) {
    Material material;
    material.name = "surface " + std::to_string(i);
    surfaces = surfaces.With(static_cast<Surface>(i), builder.AddMaterial(material));
  }
  return surfaces;
}

}  // namespace airsim360::internal

// The scene rewritten for shading: one cache line a triangle, an instance, a material.
#pragma once

#include <vector>

#include "airsim360/render/shading/shading_data.h"
#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// Octahedral packing of a unit vector, two times 16 bits (x low); the inverse is octahedral_decode.
uint32_t PackDirection(Vec3f d);

/// Immutable; refers to the texels of the scene, which must outlive it.
struct SurfaceTables {
  explicit SurfaceTables(const Scene& scene);

  std::vector<TriangleRecord> triangles;
  std::vector<InstanceRecord> instances;
  std::vector<MaterialRecord> materials;
  std::vector<PaneRecord> panes;
  std::vector<TextureRecord> textures;  ///< 0 is white, 1 the macro variation noise, then the scene's
  /// Per material: base colour including the mean of its texture; for light that bounces.
  std::vector<Vec3f> mean_colors;

 private:
  /// Panes of materials with rooms behind; `first` triangle of every mesh.
  void AddPanes(const Scene& scene, const std::vector<uint32_t>& first);

  std::vector<uint32_t> own_texels_;
};

}  // namespace airsim360::internal

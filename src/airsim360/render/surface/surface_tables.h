// The scene rewritten for shading: one cache line a triangle, an instance, a material.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "airsim360/base/table_vector.h"
#include "airsim360/render/shared/shading_data.h"
#include "airsim360/scene/scene.h"
#include "airsim360/scene/scene_state.h"

namespace airsim360::internal {

/// Octahedral packing of a unit vector, two times 16 bits (x low); the inverse is octahedral_decode.
uint32_t PackDirection(Vec3f d);
Vec3f UnpackDirection(uint32_t packed);
/// Unit geometric normal of a triangle's front in W.
Vec3f GeometricNormal(const InstanceRecord& instance, const TriangleRecord& triangle);

/// Refers to the texels of the scene, which must outlive it.
struct SurfaceTables {
  /// `lamps_on`: whether materials with `lamp` shine (Environment::lamps_on).
  explicit SurfaceTables(const Scene& scene, bool lamps_on = true);
  /// Follows what moves, as listed by RayTracer::moved and deformed; what was listed before and is no more is
  /// as built again. Vertex normals of a deformed mesh are the means of the faces around, weighted by area,
  /// over vertices that share place and normal in the mesh as built. Pointers to the elements stay valid.
  void Apply(const Scene& scene, std::span<const MovedInstance> moved, std::span<const DeformedMesh> deformed);

  /// What vertex colours do to the base colour of a triangle at barycentrics (u, v); white without them.
  Vec3f ColorAt(const InstanceRecord& instance, uint32_t triangle, float u, float v) const;
  /// Of the corners alike: for light that bounces.
  Vec3f MeanColor(const InstanceRecord& instance, uint32_t triangle) const { return ColorAt(instance, triangle, 1.0f / 3, 1.0f / 3); }

  TableVector<TriangleRecord> triangles;
  std::vector<InstanceRecord> instances;
  std::vector<MaterialRecord> materials;
  std::vector<PaneRecord> panes;
  std::vector<TriangleColors> colors;   ///< the first is white; empty where no mesh has any
  std::vector<TextureRecord> textures;  ///< 0 is white, 1 the macro variation noise, then the scene's
  /// Per material: base colour including the mean of its texture; for light that bounces.
  std::vector<Vec3f> mean_colors;
  /// Likewise emission; 0 where it is off.
  std::vector<Vec3f> mean_emissions;
  /// Instance::glow by instance; empty where all are white.
  std::vector<Vec3f> glows;
  Vec3f GlowOf(uint32_t instance) const { return glows.empty() ? Vec3f{1, 1, 1} : glows[instance]; }
  /// Axis in W, times sharpness, of the beam that a material throws; zero without one.
  Vec3f BeamOf(const InstanceRecord& instance, const MaterialRecord& material) const;

 private:
  void SetTriangles(const Scene& scene, MeshId id, const Mesh& shape);
  const std::vector<uint32_t>& Welds(const Mesh& mesh, MeshId id);
  /// Panes of materials with rooms behind.
  void AddPanes(const Scene& scene);
  /// Of all meshes that have vertex colours.
  void AddColors(const Scene& scene);
  InstanceRecord Place(const Instance& instance, const AffineTransform& X_WM, uint32_t index) const;

  std::vector<uint32_t> own_texels_;
  std::vector<uint32_t> first_;        // by mesh: its first triangle
  std::vector<uint32_t> first_color_;  // by mesh, see InstanceRecord
  std::vector<uint32_t> moved_;
  std::vector<MeshId> deformed_;
  std::map<MeshId, std::vector<uint32_t>> welds_;  // vertex -> the first one that moves as one with it
};

}  // namespace airsim360::internal

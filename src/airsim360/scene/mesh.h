// Triangle meshes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "airsim360/math/box.h"
#include "airsim360/math/vector.h"
#include "airsim360/scene/vertex_color.h"

namespace airsim360 {

using MeshId = uint32_t;
using MaterialId = uint32_t;
using EntityId = uint32_t;
inline constexpr EntityId kNoEntity = 0;

/// A run of triangles with one material. If `entity` is not kNoEntity it wins over the entity of the
/// instance: merged static geometry carries many entities in one mesh.
struct MeshPart {
  uint32_t first_triangle = 0;
  uint32_t triangle_count = 0;
  MaterialId material = 0;
  EntityId entity = kNoEntity;
};

/// Vertices in the mesh's own frame (metres, +Z up). `normals` and `uvs` are empty or as long as `positions`;
/// without normals the geometric normal of each triangle is used. Counter-clockwise triangles face their
/// viewer. uv (0, 0) is the top left corner of a texture, v grows downwards (glTF). `colors`, empty or as long,
/// multiply the material's base colour; their alpha multiplies its alpha where that is tested (AlphaMode::kMask).
struct Mesh {
  std::string name;
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;
  std::vector<Vec2f> uvs;
  std::vector<Vec3u> triangles;
  std::vector<MeshPart> parts;  ///< cover all triangles in order, without gap or overlap
  std::vector<VertexColor> colors = {};

  Box3f Bounds() const;
  /// Of the colours of a triangle's corners; white where there are none.
  Vec3f MeanColor(uint32_t triangle) const;
};

}  // namespace airsim360

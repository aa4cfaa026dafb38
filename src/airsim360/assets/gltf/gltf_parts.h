// The parts of the glTF reader, each in a file of its own.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/assets/axes.h"
#include "airsim360/assets/gltf/gltf_buffers.h"
#include "airsim360/assets/textures/texture_store.h"

namespace airsim360::internal {

/// Member `name` of the "extensions" of a value, if there is one.
std::optional<JsonRef> GltfExtension(const JsonRef& json, const char* name);

/// Which texture coordinates a material wants, and how they are moved (KHR_texture_transform of its main
/// texture).
struct UvUse {
  uint64_t set = 0;
  double offset[2] = {0, 0}, scale[2] = {1, 1}, rotation = 0;
  bool IsIdentity() const;
  /// Translation * rotation * scale, as in the extension's text: turning counter-clockwise with v downwards.
  Vec2f operator()(Vec2f uv) const;
};

struct GltfMaterial {
  Material material;
  UvUse uv;
  bool unlit = false;   ///< its colours have their light in them
  bool blends = false;  ///< BLEND, but opaque as far as the material says: vertex colours may cover less
};

/// Makes a material of mode BLEND that covers `alpha` at most, less than all, a pane of glass.
void MakePane(Material& material, double alpha);
inline constexpr double kOpaqueFrom = 0.95;  ///< alpha that still counts as all

/// The JSON text and the binary chunk of a file.
struct GltfContainer {
  std::string_view json;
  std::span<const std::byte> binary;
};
GltfContainer OpenGltfContainer(const std::string& file, std::span<const std::byte> bytes);

/// Reads one element of /materials.
class GltfMaterials {
 public:
  GltfMaterials(const JsonRef& root, GltfBuffers& buffers, TextureStore& textures, const ResourceLoader& load, Warnings& warnings)
      : root_(root), buffers_(buffers), textures_(textures), load_(load), warnings_(warnings) {}
  GltfMaterial Read(const JsonRef& json);

 private:
  TextureId ReadTexture(const JsonRef& info, bool srgb, UvUse* uv);
  void ReadMetallicRoughness(const JsonRef& json, GltfMaterial& out);
  void ReadSpecularGlossiness(const JsonRef& json, GltfMaterial& out);
  void ReadAlpha(const JsonRef& json, GltfMaterial& out);

  JsonRef root_;
  GltfBuffers& buffers_;
  TextureStore& textures_;
  const ResourceLoader& load_;
  Warnings& warnings_;
};

/// Vertices of one primitive in frame G.
struct GltfPrimitive {
  std::vector<Vec3f> positions, normals;
  std::vector<Vec2f> uvs;
  std::vector<float> joints, weights;  ///< four a vertex, or empty
  std::vector<VertexColor> colors;     ///< or empty
  std::vector<Vec3u> triangles;
};

/// Reads one primitive (triangles, strips, fans; plain or Draco); nullopt with a warning for points and
/// lines. `weights` are those of the mesh's morph targets.
std::optional<GltfPrimitive> ReadPrimitive(const JsonRef& json, uint64_t uv_set, const std::vector<double>& morph_weights,
                                           GltfBuffers& buffers, const ImportLimits& limits, Warnings& warnings);

/// InputError at `where` for a position that is not finite or beyond kMaxCoordinate.
void CheckPositions(const std::vector<Vec3f>& positions, const JsonRef& where);

/// A node of /nodes with its place in the hierarchy.
struct GltfNode {
  int64_t parent = -1;
  TransformG X_G;  ///< node to the root
  std::vector<uint32_t> children;
};

/// Reads elements of /meshes, each once; skinned ones anew for each node, bound at rest.
class GltfMeshes {
 public:
  GltfMeshes(const JsonRef& root, GltfBuffers& buffers, GltfMaterials& reader, const std::vector<GltfNode>& nodes,
             const ImportLimits& limits, Warnings& warnings)
      : root_(root), buffers_(buffers), reader_(reader), nodes_(nodes), limits_(limits), warnings_(warnings) {}

  /// Index in `meshes` of what a node shows; -1 if it shows nothing.
  int32_t MeshOf(const JsonRef& node);

  std::vector<Mesh> meshes;
  std::vector<Material> materials;
  std::vector<MaterialId> unlit;

 private:
  int32_t ReadMesh(const JsonRef& json, const std::optional<JsonRef>& node_weights, const std::vector<TransformG>* joints);
  void AppendPrimitive(const JsonRef& json, const std::vector<double>& weights, const std::vector<TransformG>* joints, Mesh& mesh);
  std::vector<TransformG> JointTransforms(const JsonRef& skin);
  void ApplySkin(const std::vector<TransformG>& joints, const JsonRef& where, GltfPrimitive& primitive);
  const GltfMaterial& MaterialAt(const JsonRef& primitive, MaterialId& id);
  MaterialId Covering(MaterialId material, const std::vector<VertexColor>& colors);

  JsonRef root_;
  GltfBuffers& buffers_;
  GltfMaterials& reader_;
  const std::vector<GltfNode>& nodes_;
  ImportLimits limits_;
  Warnings& warnings_;
  std::map<uint64_t, int32_t> mesh_ids_;
  std::map<uint64_t, std::pair<MaterialId, GltfMaterial>> material_ids_;
  std::map<std::pair<MaterialId, uint16_t>, MaterialId> covering_;
  uint64_t vertices_ = 0, triangles_ = 0;
};

/// All nodes, checked to be a forest: InputError for a cycle, a node with two parents or a hierarchy deeper
/// than allowed.
std::vector<GltfNode> ReadNodes(const JsonRef& root, const ImportLimits& limits);

/// Transforms of EXT_mesh_gpu_instancing of a node, relative to it.
std::vector<TransformG> ReadGpuInstances(const JsonRef& extension, GltfBuffers& buffers, const ImportLimits& limits);

/// Rotation of a quaternion in glTF's order (x, y, z, w), of any length but zero.
Mat3d RotationOf(double x, double y, double z, double w, const JsonRef& where);

}  // namespace airsim360::internal

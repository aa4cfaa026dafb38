// Meshes: primitives joined, skins bound, materials found.
#include <algorithm>
#include <cmath>
#include <utility>

#include "airsim360/assets/gltf/gltf_extras.h"
#include "airsim360/assets/gltf/gltf_parts.h"
#include "airsim360/assets/normals.h"

namespace airsim360::internal {

const GltfMaterial& GltfMeshes::MaterialAt(const JsonRef& primitive, MaterialId& id) {
  // Ids beyond all indices stand for "no material": grey, or white where the vertices bring the colour.
  constexpr uint64_t kGrey = UINT64_MAX, kWhite = kGrey - 1;
  const auto index = primitive.Find("material");
  const uint64_t key = index ? index->Uint() : primitive.At("attributes").Has("COLOR_0") ? kWhite : kGrey;
  auto it = material_ids_.find(key);
  if (it == material_ids_.end()) {
    GltfMaterial material;
    if (index) material = reader_.Read(buffers_.Element("materials", *index));
    if (key == kWhite) material.material.base_color = {1, 1, 1};
    it = material_ids_.emplace(key, std::pair(static_cast<MaterialId>(materials.size()), material)).first;
    materials.push_back(material.material);
    if (material.unlit) unlit.push_back(it->second.first);
  }
  id = it->second.first;
  return it->second.second;
}

// For a primitive of mode BLEND whose vertex colours cover less than all: cut out at one half, or a pane where
// they are see-through everywhere.
MaterialId GltfMeshes::Covering(MaterialId material, const std::vector<VertexColor>& colors) {
  const auto [low, high] = std::ranges::minmax(colors, {}, &VertexColor::a);
  const double alpha = materials[material].base_alpha * high.a / 65535.0;
  if (low.a == VertexColor().a) return material;
  const bool pane = alpha < kOpaqueFrom;
  const auto [it, is_new] = covering_.try_emplace({material, pane ? high.a : VertexColor().a}, static_cast<MaterialId>(materials.size()));
  if (is_new) {
    Material copy = materials[material];
    if (pane) {
      MakePane(copy, alpha);
    } else {
      copy.alpha_mode = AlphaMode::kMask;
    }
    materials.push_back(std::move(copy));
  }
  return it->second;
}

std::vector<TransformG> GltfMeshes::JointTransforms(const JsonRef& skin) {
  const JsonRef joints = skin.At("joints");
  std::vector<float> inverse;
  if (const auto index = skin.Find("inverseBindMatrices")) {
    inverse = buffers_.Floats(*index, 16);
    if (inverse.size() / 16 < joints.size())
      index->Fail(std::to_string(inverse.size() / 16) + " matrices for " + std::to_string(joints.size()) + " joints");
  }
  std::vector<TransformG> out;
  for (size_t i = 0; i < joints.size(); ++i) {
    const uint64_t node = joints[i].Uint();
    if (node >= nodes_.size()) joints[i].Fail("there are only " + std::to_string(nodes_.size()) + " nodes");
    TransformG X = nodes_[static_cast<size_t>(node)].X_G;
    if (!inverse.empty()) {
      const float* m = inverse.data() + 16 * i;
      X = X * TransformG{Mat3d::FromColumns({m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}), {m[12], m[13], m[14]}};
    }
    out.push_back(X);
  }
  return out;
}

void GltfMeshes::ApplySkin(const std::vector<TransformG>& joints, const JsonRef& where, GltfPrimitive& p) {
  if (p.joints.empty() || p.weights.empty()) return;
  for (size_t i = 0; i < p.positions.size(); ++i) {
    Vec3d position{}, normal{};
    double sum = 0;
    for (size_t k = 4 * i; k < 4 * i + 4; ++k) {
      const double w = p.weights[k];
      if (!(w > 0)) continue;
      if (!(p.joints[k] >= 0 && p.joints[k] < static_cast<float>(joints.size())))
        where.Fail("vertex " + std::to_string(i) + " hangs on a joint that is not there");
      const TransformG& X = joints[static_cast<size_t>(p.joints[k])];
      position += (X * VecCast<double>(p.positions[i])) * w;
      if (!p.normals.empty()) normal += (X.A * VecCast<double>(p.normals[i])) * w;
      sum += w;
    }
    if (sum <= 0) continue;
    p.positions[i] = VecCast<float>(position / sum);
    if (!p.normals.empty()) p.normals[i] = VecCast<float>(normal);
  }
}

void GltfMeshes::AppendPrimitive(const JsonRef& json, const std::vector<double>& weights, const std::vector<TransformG>* joints,
                                 Mesh& mesh) {
  MaterialId material_id = 0;
  const GltfMaterial& material = MaterialAt(json, material_id);
  std::optional<GltfPrimitive> primitive = ReadPrimitive(json, material.uv.set, weights, buffers_, limits_, warnings_);
  if (!primitive || primitive->triangles.empty()) return;
  if (material.blends && !primitive->colors.empty()) material_id = Covering(material_id, primitive->colors);
  if (joints) {
    ApplySkin(*joints, json, *primitive);
    CheckPositions(primitive->positions, json);
  }

  // Only the vertices that triangles use: exporters share one big list among many primitives.
  constexpr uint32_t kUnused = UINT32_MAX;
  const auto base = static_cast<uint32_t>(mesh.positions.size());
  std::vector<uint32_t> moved(primitive->positions.size(), kUnused);
  mesh.uvs.resize(primitive->uvs.empty() && mesh.uvs.empty() ? 0 : base);
  const bool uvs = !primitive->uvs.empty() || !mesh.uvs.empty();
  const bool colors = !primitive->colors.empty() || !mesh.colors.empty();
  mesh.colors.resize(colors ? base : 0);
  const auto vertex = [&](uint32_t i) {
    if (moved[i] != kUnused) return moved[i];
    moved[i] = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.push_back(FromG(primitive->positions[i]));
    mesh.normals.push_back(primitive->normals.empty() ? Vec3f{} : FromG(primitive->normals[i]));
    if (uvs) {
      const Vec2f uv = primitive->uvs.empty() ? Vec2f{} : primitive->uvs[i];
      const Vec2f moved_uv = material.uv.IsIdentity() ? uv : material.uv(uv);
      mesh.uvs.push_back(std::isfinite(moved_uv.x) && std::isfinite(moved_uv.y) ? moved_uv : Vec2f{});
    }
    if (colors) mesh.colors.push_back(primitive->colors.empty() ? VertexColor{} : primitive->colors[i]);
    return moved[i];
  };
  mesh.parts.push_back(
      {static_cast<uint32_t>(mesh.triangles.size()), static_cast<uint32_t>(primitive->triangles.size()), material_id, kNoEntity});
  for (const Vec3u& t : primitive->triangles) {
    const Vec3u triangle{vertex(t.x), vertex(t.y), vertex(t.z)};
    mesh.triangles.push_back(triangle);
  }
  if (uvs) mesh.uvs.resize(mesh.positions.size());

  vertices_ += mesh.positions.size() - base;
  triangles_ += primitive->triangles.size();
  if (vertices_ > limits_.max_vertices || triangles_ > limits_.max_triangles) json.Fail("the file has too many vertices or triangles");
}

int32_t GltfMeshes::ReadMesh(const JsonRef& json, const std::optional<JsonRef>& node_weights, const std::vector<TransformG>* joints) {
  Mesh mesh;
  mesh.name = CleanName(json.TextOr("name", ""));
  const JsonRef primitives = json.At("primitives");
  std::vector<double> weights;
  if (const auto list = node_weights ? node_weights : json.Find("weights")) weights = list->Numbers(list->size());
  for (size_t i = 0; i < primitives.size(); ++i) AppendPrimitive(primitives[i], weights, joints, mesh);
  if (mesh.triangles.empty()) return -1;
  const auto extras = json.Find("extras");
  if (extras && extras->IsObject() && extras->BoolOr(kExtraFlat, false))
    mesh.normals.clear();
  else
    FillMissingNormals(mesh);
  meshes.push_back(std::move(mesh));
  return static_cast<int32_t>(meshes.size() - 1);
}

int32_t GltfMeshes::MeshOf(const JsonRef& node) {
  const auto index = node.Find("mesh");
  if (!index) return -1;
  const JsonRef json = buffers_.Element("meshes", *index);
  const std::optional<JsonRef> weights = node.Find("weights");
  if (const auto skin = node.Find("skin")) {
    const std::vector<TransformG> joints = JointTransforms(buffers_.Element("skins", *skin));
    return ReadMesh(json, weights, &joints);
  }
  // Weights of its own make the node's mesh another one than that of the nodes beside it.
  if (weights) return ReadMesh(json, weights, nullptr);
  const auto known = mesh_ids_.find(index->Uint());
  if (known != mesh_ids_.end()) return known->second;
  return mesh_ids_[index->Uint()] = ReadMesh(json, weights, nullptr);
}

}  // namespace airsim360::internal

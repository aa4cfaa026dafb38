#include "airsim360/assets/merge.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "airsim360/assets/limits.h"
#include "airsim360/assets/normals.h"
#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

// Transposed inverse times the determinant: defined for every matrix.
Mat3f Cofactors(const Mat3f& A) {
  const Vec3f a = A.column(0), b = A.column(1), c = A.column(2);
  return Mat3f::FromColumns(Cross(b, c), Cross(c, a), Cross(a, b));
}

// Adds the vertices of `from` to `to`; uv, normals and colours are filled in where only one of both has them.
uint32_t AppendVertices(Mesh& to, const Mesh& from) {
  const auto base = static_cast<uint32_t>(to.positions.size());
  if (!from.uvs.empty() || !to.uvs.empty()) {
    to.uvs.resize(base);
    to.uvs.insert(to.uvs.end(), from.uvs.begin(), from.uvs.end());
  }
  if (!from.colors.empty() || !to.colors.empty()) {
    to.colors.resize(base);
    to.colors.insert(to.colors.end(), from.colors.begin(), from.colors.end());
  }
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
  if (!to.uvs.empty()) to.uvs.resize(to.positions.size());
  if (!to.colors.empty()) to.colors.resize(to.positions.size());
  return base;
}

void CheckInBounds(const Mesh& mesh, const std::string& file, const std::string& node) {
  for (Vec3f p : mesh.positions) {
    // Written so that NaN fails too.
    if (!(std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate && std::abs(p.z) <= kMaxCoordinate)) {
      throw InputError(file + ": node " + Quoted(node) + ": placed beyond 1e9 m or not finite");
    }
  }
}

}  // namespace

void TransformMesh(Mesh& mesh, const AffineTransform& X) {
  if (X == AffineTransform{}) return;
  const float sign = X.A.determinant() < 0 ? -1.0f : 1.0f;
  const Mat3f N = Cofactors(X.A);
  for (Vec3f& p : mesh.positions) p = X * p;
  for (Vec3f& n : mesh.normals) {
    const Vec3f moved = Normalized(N * n) * sign;
    n = moved == Vec3f{} ? Vec3f{0, 0, 1} : moved;
  }
  if (sign < 0) {
    for (Vec3u& t : mesh.triangles) std::swap(t.y, t.z);
  }
}

Model MergeNodes(ImportedFile file, const std::string& name, uint64_t max_triangles) {
  Model model;
  model.mesh.name = name;
  std::map<MaterialId, std::vector<Vec3u>> triangles;
  uint64_t count = 0;
  for (const ImportedNode& node : file.nodes) {
    if (node.mesh < 0) continue;
    Mesh mesh = file.meshes[static_cast<size_t>(node.mesh)];
    count += mesh.triangles.size();
    if (count > max_triangles) throw InputError(name + ": more than " + std::to_string(max_triangles) + " triangles as one model");
    if (mesh.normals.empty()) FillMissingNormals(mesh);
    TransformMesh(mesh, node.X_WM);
    CheckInBounds(mesh, name, node.name);
    const uint32_t base = AppendVertices(model.mesh, mesh);
    for (const MeshPart& part : mesh.parts) {
      std::vector<Vec3u>& group = triangles[part.material];
      for (uint32_t i = 0; i < part.triangle_count; ++i) {
        const Vec3u t = mesh.triangles[part.first_triangle + i];
        group.push_back({t.x + base, t.y + base, t.z + base});
      }
    }
  }
  for (const auto& [material, group] : triangles) {
    const auto first = static_cast<uint32_t>(model.mesh.triangles.size());
    model.mesh.parts.push_back({first, static_cast<uint32_t>(group.size()), material, kNoEntity});
    model.mesh.triangles.insert(model.mesh.triangles.end(), group.begin(), group.end());
  }
  model.materials = std::move(file.materials);
  model.textures = std::move(file.textures);
  return model;
}

void StandOnGround(Model& model) {
  const Box3f bounds = model.mesh.Bounds();
  if (bounds.empty()) return;
  TransformMesh(model.mesh, {{}, {-bounds.center().x, -bounds.center().y, -bounds.min.z}});
}

}  // namespace airsim360::internal

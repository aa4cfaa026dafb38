#include "airsim360/render/surface/bent_normals.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace airsim360::internal {

std::vector<uint32_t> WeldVertices(const Mesh& mesh) {
  const auto less = [](Vec3f a, Vec3f b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  const auto same_order = [&](uint32_t a, uint32_t b) {
    if (!(mesh.positions[a] == mesh.positions[b])) return less(mesh.positions[a], mesh.positions[b]);
    if (!(mesh.normals[a] == mesh.normals[b])) return less(mesh.normals[a], mesh.normals[b]);
    return a < b;
  };
  std::vector<uint32_t> order(mesh.positions.size()), weld(order.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), same_order);
  for (size_t k = 0; k < order.size(); ++k) {
    const bool joined =
        k > 0 && mesh.positions[order[k]] == mesh.positions[order[k - 1]] && mesh.normals[order[k]] == mesh.normals[order[k - 1]];
    weld[order[k]] = joined ? weld[order[k - 1]] : order[k];
  }
  return weld;
}

void BendNormals(const Mesh& mesh, std::span<const Vec3f> positions, std::span<const uint32_t> weld, std::span<Vec3f> normals) {
  std::fill(normals.begin(), normals.end(), Vec3f{});
  for (const Vec3u t : mesh.triangles) {
    const Vec3f p = positions[t.x];
    const Vec3f area = Cross(positions[t.y] - p, positions[t.z] - p);
    for (uint32_t v : {t.x, t.y, t.z}) normals[weld[v]] = normals[weld[v]] + area;
  }
  for (size_t v = 0; v < weld.size(); ++v) normals[v] = normals[weld[v]];
}

}  // namespace airsim360::internal

#include "airsim360/render/shading/probe_rays.h"

#include <algorithm>
#include <vector>

#include "airsim360/render/shading/shading_scalar.h"

namespace airsim360::internal {
namespace {

Vec3f UnpackDirection(uint32_t packed) {
  constexpr float scale = 2.0f / 65534.0f;
  return scalar::octahedral_decode(static_cast<float>(packed & 0xffff) * scale - 1,
                                   static_cast<float>(packed >> 16) * scale - 1);
}

float Percentile(std::vector<float>& values, double share) {
  const auto k = static_cast<size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<int64_t>(k), values.end());
  return values[k];
}

}  // namespace

Met ResolveMet(const SurfaceTables& tables, const SurfaceRef& ref, Vec3f point, Vec3f direction) {
  const InstanceRecord& instance = tables.instances[ref.instance];
  const TriangleRecord& triangle = tables.triangles[instance.first_triangle + ref.triangle];
  const uint32_t material = triangle.material & ~kMirroredUv;
  const Vec3f n = UnpackDirection(triangle.geometric_normal);
  const float* m = instance.normal_matrix;
  Vec3f normal = Normalized(Vec3f{m[0] * n.x + m[1] * n.y + m[2] * n.z, m[3] * n.x + m[4] * n.y + m[5] * n.z,
                                  m[6] * n.x + m[7] * n.y + m[8] * n.z});
  const bool back = Dot(normal, direction) > 0;
  if (back) normal = -normal;
  const auto kind = static_cast<SurfaceKind>(static_cast<int>(tables.materials[material].kind));
  const Vec3f tint{instance.tint[0], instance.tint[1], instance.tint[2]};
  return {point, normal, Min(tables.mean_colors[material] * tint, Vec3f{0.9f, 0.9f, 0.9f}), back,
          kind == SurfaceKind::kFoliage || kind == SurfaceKind::kGlass};
}

Box3f DetailBounds(const Scene& scene) {
  uint64_t total = 0;
  for (const Instance& instance : scene.instances) total += scene.meshes[instance.mesh].triangles.size();
  if (total == 0) return {};
  const uint64_t stride = std::max<uint64_t>(1, total / 200000);
  std::vector<float> axes[3];
  uint64_t skip = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (; skip < mesh.triangles.size(); skip += stride) {
      const Vec3f p = instance.X_WM * mesh.positions[mesh.triangles[skip].x];
      for (int k = 0; k < 3; ++k) axes[k].push_back(p[k]);
    }
    skip -= mesh.triangles.size();
  }
  Box3f box;
  box.Add(Vec3f{Percentile(axes[0], 0.01), Percentile(axes[1], 0.01), Percentile(axes[2], 0.002)});
  box.Add(Vec3f{Percentile(axes[0], 0.99), Percentile(axes[1], 0.99), Percentile(axes[2], 0.998)});
  const Vec3f margin = box.size() * 0.1f + Vec3f{4, 4, 1};
  return {Max(box.min - margin, scene.bounds.min), Min(box.max + margin, scene.bounds.max)};
}

}  // namespace airsim360::internal

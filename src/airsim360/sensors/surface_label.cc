#include "airsim360/sensors/surface_label.h"

#include <algorithm>

namespace airsim360 {

SurfaceLabel LabelOf(const RayTracer& tracer, const SurfaceRef& surface) {
  const Scene& scene = tracer.scene();
  const Instance& instance = scene.instances[surface.instance];
  const Mesh& mesh = scene.meshes[instance.mesh];
  const std::vector<MeshPart>& parts = mesh.parts;
  // Parts cover all triangles in order: the last one that begins at or before the triangle.
  const auto next = std::ranges::upper_bound(parts, surface.triangle, {}, &MeshPart::first_triangle);
  const MeshPart& part = *(next - 1);
  const EntityId entity = part.entity != kNoEntity ? part.entity : instance.entity;
  const Vec3f color = scene.materials[part.material].base_color * instance.tint * mesh.MeanColor(surface.triangle);
  return {entity, scene.entity(entity).category, std::clamp((color.x + color.y + color.z) / 3, 0.0f, 1.0f)};
}

}  // namespace airsim360

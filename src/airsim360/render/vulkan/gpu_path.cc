#include "airsim360/render/vulkan/gpu_path.h"

#include <algorithm>

#include "airsim360/render/lights/lamp_parts.h"
#include "airsim360/render/reference/path_rays.h"
#include "airsim360/render/shading/shader_impl.h"
#include "airsim360/render/vulkan/gpu_records.h"

namespace airsim360::internal {
namespace {

void Copy(Vec3f from, float* to) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }

std::vector<GpuLightNode> NodesOf(const LightTree& tree) {
  std::vector<GpuLightNode> nodes;
  for (const LightTree::Node& n : tree.nodes()) {
    GpuLightNode out{};
    const Vec3f size = n.bounds.box.size();
    Copy(n.bounds.box.center(), out.center);
    out.radius2 = 0.25f * Dot(size, size);
    out.power = n.bounds.power, out.spread = n.bounds.spread;
    Copy(n.bounds.axis, out.axis);
    out.second = n.second, out.parent = n.parent, out.lamp = n.lamp;
    nodes.push_back(out);
  }
  return nodes;
}

GpuLampPart PartOf(const Scene& scene, const SurfaceTables& tables, const Lamp& lamp, uint32_t triangle, float share) {
  const Instance& instance = scene.instances[lamp.instance];
  const LampTriangle placed = PlaceTriangle(scene.meshes[instance.mesh], triangle, instance.X_WM);
  GpuLampPart part{};
  for (int k = 0; k < 3; ++k) Copy(placed.corner[k], part.corner + 3 * k);
  Copy(placed.normal, part.normal);
  part.share = share;
  part.triangle = tables.instances[lamp.instance].first_triangle + triangle;
  return part;
}

void PutLamps(GpuArena& arena, const Shader::Impl& shader, const Scene& scene, GpuPath& out) {
  std::vector<GpuPathLamp> lamps;
  std::vector<GpuLampPart> parts;
  std::vector<uint32_t> lamp_of(1), first(scene.instances.size());
  const std::span<const Lamp> all = shader.lights.lamps();
  for (uint32_t i = 0; i < all.size(); ++i) {
    const auto triangles = shader.lights.TrianglesOf(i);
    const auto shares = shader.lights.SharesOf(i);
    GpuPathLamp lamp{static_cast<uint32_t>(parts.size()),
                     static_cast<uint32_t>(triangles.size()),
                     shader.lights.tree().leaf_of()[i],
                     all[i].area,
                     {},
                     {},
                     shader.tables.instances[all[i].instance].hash};
    Copy(shader.tables.GlowOf(all[i].instance), lamp.glow);
    Copy(all[i].beam, lamp.beam);
    lamps.push_back(lamp);
    uint32_t& begin = first[all[i].instance];
    if (begin == 0) {
      begin = static_cast<uint32_t>(lamp_of.size());
      lamp_of.resize(begin + scene.meshes[scene.instances[all[i].instance].mesh].triangles.size());
    }
    for (size_t k = 0; k < triangles.size(); ++k) {
      parts.push_back(PartOf(scene, shader.tables, all[i], triangles[k], shares[k]));
      lamp_of[begin + triangles[k]] = 1 + i;
    }
  }
  out.lamp_count = static_cast<uint32_t>(lamps.size());
  out.nodes = arena.Put(NodesOf(shader.lights.tree())).address;
  out.lamps = arena.Put(lamps).address;
  out.parts = arena.Put(parts).address;
  out.lamp_of = arena.Put(lamp_of).address;
  out.lamp_of_first = arena.Put(first).address;
}

}  // namespace

GpuPathTables::GpuPathTables(GpuDevice& device, const Shader& shader, const RayTracer& tracer) : arena_(device) {
  const Shader::Impl& impl = shader.impl();
  const PathScene scene(tracer, shader);
  GpuPath path{};
  path.has_sun = scene.lights.has_sun() ? 1 : 0;
  path.clear_panes = scene.clear_panes ? 1 : 0;
  Copy(scene.room_light, path.room_light);
  if (impl.sky) {
    path.has_sky = 1;
    path.sky_density = arena_.Put(impl.sky->sampler().density()).address;
    path.sky_cumulative = arena_.Put(impl.sky->sampler().cumulative()).address;
    path.sky_rows = arena_.Put(impl.sky->sampler().rows()).address;
  }
  if (scene.lights.has_lamps()) PutLamps(arena_, impl, tracer.scene(), path);
  record_ = arena_.Put(std::as_bytes(std::span<const GpuPath>(&path, 1)));
  arena_.EndUploads();
}

}  // namespace airsim360::internal

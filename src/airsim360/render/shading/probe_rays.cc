#include "airsim360/render/shading/probe_rays.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "airsim360/math/angles.h"
#include "airsim360/render/lights/clear_panes.h"
#include "airsim360/render/lights/lamp_grid.h"
#include "airsim360/render/shading/light_probes.h"
#include "airsim360/render/shared/shading_constants.h"

namespace airsim360::internal {
namespace {

float Percentile(std::vector<float>& values, double share) {
  const auto k = static_cast<size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<int64_t>(k), values.end());
  return values[k];
}

// Sixteen rays that may start anywhere, all lanes finite.
struct Packet {
  RayHit16 rays;
  alignas(64) int valid[16];

  Packet() : rays{}, valid{} {
    for (int i = 0; i < 16; ++i) rays.direction_z[i] = 1, rays.mask[i] = kMaskSolid;
  }
  void Set(int i, Vec3f p, Vec3f d, float t_near, float t_far) {
    rays.origin_x[i] = p.x, rays.origin_y[i] = p.y, rays.origin_z[i] = p.z;
    rays.direction_x[i] = d.x, rays.direction_y[i] = d.y, rays.direction_z[i] = d.z;
    rays.t_near[i] = t_near, rays.t_far[i] = t_far, rays.time[i] = 0, rays.mask[i] = kMaskSolid;
    rays.id[i] = rays.flags[i] = 0;
    rays.geometry[i] = rays.instance[i] = kMiss;
    valid[i] = -1;
  }
};

// What a probe ray met.
struct Met {
  Vec3f point, normal, albedo, emission;
  bool back, open;  //< seen from behind; foliage or glass, which has no inside
};

Met ResolveMet(const ProbeLight& world, const SurfaceRef& ref, Vec3f point, Vec3f direction) {
  const SurfaceTables& tables = world.tables;
  const InstanceRecord& instance = tables.instances[ref.instance];
  const TriangleRecord& triangle = tables.triangles[instance.first_triangle + ref.triangle];
  const uint32_t material = triangle.material & ~kMirroredUv;
  Vec3f normal = GeometricNormal(instance, triangle);
  const bool back = Dot(normal, direction) > 0;
  if (back) normal = -normal;
  const auto kind = static_cast<SurfaceKind>(static_cast<int>(tables.materials[material].kind));
  const Vec3f tint{instance.tint[0], instance.tint[1], instance.tint[2]};
  // Emission, unless the grid of lamps brings it.
  Vec3f emission = back ? Vec3f{} : tables.mean_emissions[material] * tables.GlowOf(ref.instance);
  if (emission != Vec3f{} && world.lamps != nullptr) {
    const uint32_t lamp = world.lights->LampOf(ref.instance, ref.triangle);
    if (lamp != LightTable::kNoLamp && world.lamps->Holds(lamp)) emission = {};
  }
  const Vec3f color = tables.mean_colors[material] * tint * tables.MeanColor(instance, ref.triangle);
  return {point,    normal, Min(color, Vec3f{kMostBounced, kMostBounced, kMostBounced}),
          emission, back,   kind == SurfaceKind::kFoliage || kind == SurfaceKind::kGlass};
}

// Light of the sky on a surface in a street, half of it hidden; and of ground like that of the scene.
Vec3f AmbientGuess(const Sky& sky, Vec3f n) {
  return sky.Irradiance(n) * 0.5f + sky.ground_radiance() * (kPiF * 0.5f * (0.5f - 0.5f * n.z));
}

}  // namespace

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

Box3f DetailAround(const Scene& scene, float reach) {
  const Box3f box = DetailBounds(scene);
  if (box.empty()) return box;
  const Vec3f at = scene.spawn.value_or((box.min + box.max) * 0.5f), far{reach, reach, INFINITY};
  const Box3f around{Max(box.min, at - far), Min(box.max, at + far)};
  return around.min.x < around.max.x && around.min.y < around.max.y ? around : box;
}

namespace {

/// What up to 16 points see along one direction, and how the sun comes to what they meet.
struct PacketView {
  Packet view, shadow;
  std::array<Met, 16> met;
  bool any_lit = false;
  alignas(64) bool occluded[16] = {};
  std::array<Vec3f, 16> sun_tint;
};

// Those that met something look for the sun, through panes.
void LookForSun(const ProbeLight& world, PacketView& v) {
  v.sun_tint.fill({1, 1, 1});
  if (!v.any_lit) return;
  world.tracer.Occluded16(v.shadow.valid, v.shadow.rays, v.occluded, false);
  if (!world.tracer.has_clear_panes()) return;
  for (int i = 0; i < 16; ++i) {
    if (v.occluded[i]) v.shadow.valid[i] = 0;
    if (v.shadow.valid[i] != 0) v.shadow.rays.t_far[i] = INFINITY;
  }
  DimByPanes(world.tracer, world.tables, v.shadow.valid, v.shadow.rays, v.sun_tint);
}

// Light of what point i has met.
void AddLightOf(const ProbeLight& world, const PacketView& v, size_t i, Seen& seen) {
  const Sky* sky = world.sky;
  const Vec3f interior = world.tracer.scene().interior_light;
  const Met& m = v.met[i];
  const Vec3f reflectance = m.albedo * ((seen.behind[i] ? 0.1f : 1.0f) / kPiF);
  Vec3f irradiance;
  if (v.shadow.valid[i] && !v.occluded[i])
    irradiance = sky->sun_irradiance() * v.sun_tint[i] * (Dot(m.normal, sky->to_sun()) * sky->CloudShadow(m.point));
  if (world.lamps) irradiance += world.lamps->NearIrradiance(m.point, m.normal);
  // Rooms that glow by themselves have their bounces in the glow.
  const bool glows = !sky && interior != Vec3f{};
  if (world.earlier && !glows) {
    const bool known = world.earlier->Covers(m.point);
    irradiance += known ? world.earlier->NearIrradiance(m.point, m.normal) : sky ? AmbientGuess(*sky, m.normal) : Vec3f{};
  }
  seen.light[i] = m.emission + reflectance * irradiance;
  if (sky && !world.earlier) seen.guess[i] = reflectance * AmbientGuess(*sky, m.normal);
  if (glows) {
    const float t = v.view.rays.t_far[i];
    seen.light[i] += interior * (kRoomNear + kRoomFar * t * t / (t * t + 0.5f));
  }
}

// Glass on the way of the view.
void DimSeen(const ProbeLight& world, std::span<const Vec3f> points, Vec3f direction, const Packet& view, Seen& seen) {
  std::array<Vec3f, 16> tint;
  tint.fill({1, 1, 1});
  Packet through;
  for (size_t i = 0; i < points.size(); ++i) through.Set(static_cast<int>(i), points[i], direction, 0, view.rays.t_far[i]);
  DimByPanes(world.tracer, world.tables, through.valid, through.rays, tint);
  for (size_t i = 0; i < points.size(); ++i) {
    seen.light[i] = seen.light[i] * tint[i];
    seen.guess[i] = seen.guess[i] * tint[i];
  }
}

}  // namespace

Seen LookAlong(const ProbeLight& world, std::span<const Vec3f> points, Vec3f direction) {
  const RayTracer& tracer = world.tracer;
  const Sky* sky = world.sky;
  PacketView v;
  for (size_t i = 0; i < points.size(); ++i) v.view.Set(static_cast<int>(i), points[i], direction, 0, INFINITY);
  tracer.Intersect16(v.view.valid, v.view.rays, false);

  Seen seen;
  for (size_t i = 0; i < points.size(); ++i) {
    const auto& rays = v.view.rays;
    seen.open[i] = rays.geometry[i] == kMiss;
    if (seen.open[i]) continue;
    const SurfaceRef ref = tracer.Resolve(rays.geometry[i], rays.instance[i], rays.primitive[i]);
    const Met& met = v.met[i] = ResolveMet(world, ref, points[i] + direction * rays.t_far[i], direction);
    seen.behind[i] = met.back && !met.open;
    if (sky == nullptr || sky->to_sun().z < 0 || Dot(met.normal, sky->to_sun()) <= 0) continue;
    v.shadow.Set(static_cast<int>(i), met.point + met.normal * 0.01f, sky->to_sun(), 0, INFINITY);
    v.any_lit = true;
  }
  LookForSun(world, v);
  for (size_t i = 0; i < points.size(); ++i) {
    if (seen.open[i])
      seen.light[i] = sky ? sky->blurred(0).At(direction) : tracer.scene().interior_light;
    else
      AddLightOf(world, v, i, seen);
  }
  if (tracer.has_clear_panes()) DimSeen(world, points, direction, v.view, seen);
  return seen;
}

}  // namespace airsim360::internal

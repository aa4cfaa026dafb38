#include "airsim360/render/shading/probe_rays.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "airsim360/render/shading/shading_scalar.h"

namespace airsim360::internal {
namespace {

constexpr float kPi = 3.14159265f;

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

// Sixteen rays that may start anywhere, all lanes finite.
struct Packet {
  RayHit16 rays;
  alignas(64) int valid[16];

  Packet() : rays{}, valid{} {
    for (int i = 0; i < 16; ++i) rays.direction_z[i] = 1, rays.mask[i] = UINT32_MAX;
  }
  void Set(int i, Vec3f p, Vec3f d, float t_near, float t_far) {
    rays.origin_x[i] = p.x, rays.origin_y[i] = p.y, rays.origin_z[i] = p.z;
    rays.direction_x[i] = d.x, rays.direction_y[i] = d.y, rays.direction_z[i] = d.z;
    rays.t_near[i] = t_near, rays.t_far[i] = t_far, rays.time[i] = 0, rays.mask[i] = UINT32_MAX;
    rays.id[i] = rays.flags[i] = 0;
    rays.geometry[i] = rays.instance[i] = kMiss;
    valid[i] = -1;
  }
};

// What a probe ray met.
struct Met {
  Vec3f point, normal, albedo;
  bool back, open;  //< seen from behind; foliage or glass, which has no inside
};

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

// Light of the sky on a surface in a street, half of it hidden; and of ground like that of the scene.
Vec3f AmbientGuess(const Sky& sky, Vec3f n) {
  return sky.Irradiance(n) * 0.5f + sky.ground_radiance() * (kPi * 0.5f * (0.5f - 0.5f * n.z));
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

Seen LookAlong(const RayTracer& tracer, const SurfaceTables& tables, const Sky* sky,
               std::span<const Vec3f> points, Vec3f direction) {
  Packet view;
  for (size_t i = 0; i < points.size(); ++i) view.Set(static_cast<int>(i), points[i], direction, 0, INFINITY);
  tracer.Intersect16(view.valid, view.rays, false);

  // Those that met something look for the sun.
  Packet shadow;
  std::array<Met, 16> met;
  bool any_lit = false;
  alignas(64) bool occluded[16] = {};
  Seen seen;
  for (size_t i = 0; i < points.size(); ++i) {
    seen.open[i] = view.rays.geometry[i] == kMiss;
    if (seen.open[i]) continue;
    const SurfaceRef ref =
        tracer.Resolve(view.rays.geometry[i], view.rays.instance[i], view.rays.primitive[i]);
    met[i] = ResolveMet(tables, ref, points[i] + direction * view.rays.t_far[i], direction);
    seen.behind[i] = met[i].back && !met[i].open;
    if (sky == nullptr || sky->to_sun().z < 0 || Dot(met[i].normal, sky->to_sun()) <= 0) continue;
    shadow.Set(static_cast<int>(i), met[i].point + met[i].normal * 0.01f, sky->to_sun(), 0, INFINITY);
    any_lit = true;
  }
  if (any_lit) tracer.Occluded16(shadow.valid, shadow.rays, occluded, false);

  const Vec3f interior = tracer.scene().interior_light;
  for (size_t i = 0; i < points.size(); ++i) {
    if (seen.open[i]) {
      seen.light[i] = sky ? sky->blurred(0).At(direction) : interior;
    } else if (sky) {
      const Vec3f reflectance = met[i].albedo * ((seen.behind[i] ? 0.1f : 1.0f) / kPi);
      seen.guess[i] = reflectance * AmbientGuess(*sky, met[i].normal);
      if (shadow.valid[i] && !occluded[i]) {
        seen.light[i] = reflectance * sky->sun_irradiance() *
                        (Dot(met[i].normal, sky->to_sun()) * sky->CloudShadow(met[i].point));
      }
    } else {
      const float t = view.rays.t_far[i];
      seen.light[i] = interior * (0.35f + 0.65f * t * t / (t * t + 0.5f));
    }
  }
  return seen;
}

}  // namespace airsim360::internal

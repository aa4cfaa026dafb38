#include "airsim360/render/lights/clear_panes.h"

#include <algorithm>
#include <cmath>

#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360::internal {
namespace {

constexpr int kMostClearPanes = 4;
constexpr float kGlassIndex = 1.5f;

// Calls keep(lane, material, normal, cosine) for each pane on the way of each ray, near ones first: the share that goes on, 0: the ray
// ends there.
template <class Keep>
void PassPanes(const RayTracer& tracer, const SurfaceTables& tables, const int* valid, RayHit16& rays, std::array<Vec3f, 16>& tint,
               const Keep& keep) {
  alignas(64) int active[16];
  float t_far[16];
  std::copy(valid, valid + 16, active);
  std::copy(rays.t_far, rays.t_far + 16, t_far);
  std::fill(rays.mask, rays.mask + 16, kMaskClearPanes);
  for (int pane = 0; pane < kMostClearPanes; ++pane) {
    tracer.IntersectClearPanes16(active, rays);
    bool any = false;
    for (int i = 0; i < 16; ++i) {
      if (active[i] == 0) continue;
      active[i] = rays.geometry[i] == kMiss ? 0 : -1;
      if (active[i] == 0) continue;
      any = true;
      const SurfaceRef ref = tracer.Resolve(rays.geometry[i], rays.instance[i], rays.primitive[i]);
      const InstanceRecord& instance = tables.instances[ref.instance];
      const TriangleRecord& triangle = tables.triangles[instance.first_triangle + ref.triangle];
      const MaterialRecord& material = tables.materials[triangle.material & ~kMirroredUv];

      const Vec3f normal = GeometricNormal(instance, triangle);
      const Vec3f d{rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]};
      const float cosine = std::min(1.0f, std::fabs(Dot(normal, d)) / std::max(Norm(d), 1e-20f));
      const float kept = keep(i, material, normal, cosine);
      if (kept == 0) {
        active[i] = 0;
        continue;
      }
      for (int c = 0; c < 3; ++c) tint[i][c] *= material.base[c] * instance.tint[c] * kept;
      if (instance.first_color != 0) tint[i] = tint[i] * tables.ColorAt(instance, ref.triangle, rays.u[i], rays.v[i]);
      rays.t_near[i] = rays.t_far[i] * (1 + 1e-5f) + 1e-4f;
      rays.t_far[i] = t_far[i];
      if (!(rays.t_near[i] < t_far[i])) active[i] = 0;
    }
    if (!any) return;
  }
}

}  // namespace

void DimByPanes(const RayTracer& tracer, const SurfaceTables& tables, const int* valid, RayHit16& rays, std::array<Vec3f, 16>& tint,
                bool veiled) {
  PassPanes(tracer, tables, valid, rays, tint, [veiled](int, const MaterialRecord& material, Vec3f, float cosine) {
    if (veiled) return material.transmission * (1 - scalar::bsdf_pane(cosine));
    // Two faces; light that bounces between them goes on.
    const float one = scalar::fresnel_dielectric(kGlassIndex, cosine);
    return material.transmission * (1 - one) / (1 + one);
  });
}

void TurnAtPanes(const RayTracer& tracer, const SurfaceTables& tables, const int* valid, RayHit16& rays, std::array<Vec3f, 16>& tint,
                 PaneTurns& turns) {
  std::fill(turns.at, turns.at + 16, INFINITY);
  PassPanes(tracer, tables, valid, rays, tint, [&](int i, const MaterialRecord& material, Vec3f normal, float cosine) {
    const float mirrored = scalar::bsdf_pane(cosine);
    if (turns.number[i] < mirrored) {
      turns.at[i] = rays.t_far[i], turns.normal[i] = normal;
      return 0.0f;
    }
    turns.number[i] = (turns.number[i] - mirrored) / (1 - mirrored);
    return material.transmission;
  });
}

}  // namespace airsim360::internal

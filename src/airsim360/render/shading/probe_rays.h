// What the baking of light probes asks of the scene.
#pragma once

#include "airsim360/render/shading/surface_tables.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// Sixteen rays that may start anywhere, all lanes finite.
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

/// What a probe ray met.
struct Met {
  Vec3f point, normal, albedo;
  bool back, open;  ///< seen from behind; foliage or glass, which has no inside
};

Met ResolveMet(const SurfaceTables& tables, const SurfaceRef& ref, Vec3f point, Vec3f direction);

/// Where the scene's detail is: all but the outermost hundredths of its triangles, each way, with a margin;
/// empty for an empty scene.
Box3f DetailBounds(const Scene& scene);

}  // namespace airsim360::internal

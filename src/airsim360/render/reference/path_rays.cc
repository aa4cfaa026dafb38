#include "airsim360/render/reference/path_rays.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "airsim360/render/shading/ray_queue.h"
#include "airsim360/render/shading/secondary_rays.h"

namespace airsim360::internal {
namespace {

// Rays `first` … of a set as a packet, each to its reach if there is one; lanes beyond it repeat the first.
void FillPacket(const RaySet& rays, int first, const float* reach, RayHit16& packet, int* valid) {
  for (int k = 0; k < 16; ++k) {
    const bool used = first + k < rays.count;
    const int i = used ? first + k : first;
    packet.origin_x[k] = rays.ox[i], packet.origin_y[k] = rays.oy[i], packet.origin_z[k] = rays.oz[i];
    packet.direction_x[k] = rays.dx[i], packet.direction_y[k] = rays.dy[i], packet.direction_z[k] = rays.dz[i];
    packet.t_near[k] = packet.time[k] = 0;
    packet.t_far[k] = reach != nullptr ? reach[i] : INFINITY;
    packet.mask[k] = UINT32_MAX;
    packet.id[k] = packet.flags[k] = 0;
    packet.geometry[k] = packet.instance[k] = kMiss;
    valid[k] = used ? -1 : 0;
  }
}

void CopyRay(const RaySet& from, int k, RaySet& to, int i) {
  to.ox[i] = from.ox[k], to.oy[i] = from.oy[k], to.oz[i] = from.oz[k];
  to.dx[i] = from.dx[k], to.dy[i] = from.dy[k], to.dz[i] = from.dz[k];
  to.width[i] = from.width[k];
  to.slot[i] = from.slot[k];
  to.key[i] = 0;
  // Of a ray that meets nothing.
  to.distance[i] = to.u[i] = to.v[i] = 0;
  to.instance[i] = to.triangle[i] = 0;
}

}  // namespace

PathScene::PathScene(const RayTracer& t, const Shader& shader)
    : tracer(t), view(shader.impl().view), kernels(shader.impl().kernels), lights(shader.impl()) {
  const Scene& scene = tracer.scene();
  if (!lights.has_sky()) room_light = scene.interior_light;
  for (const Material& m : scene.materials) clear_panes |= m.kind == SurfaceKind::kGlass && m.transmission > 0;
}

void TraceNearest(const RayTracer& tracer, const RaySet& rays, bool coherent, RaySet& hits, RaySet& misses, const float* reach) {
  hits.count = misses.count = 0;
  RayHit16 packet;
  alignas(64) int valid[16];
  for (int first = 0; first < rays.count; first += 16) {
    FillPacket(rays, first, reach, packet, valid);
    tracer.Intersect16(valid, packet, coherent);
    for (int k = 0; k < 16 && first + k < rays.count; ++k) {
      const bool miss = packet.geometry[k] == kMiss;
      RaySet& set = miss ? misses : hits;
      const int i = set.count++;
      CopyRay(rays, first + k, set, i);
      if (miss) continue;
      const SurfaceRef ref = tracer.Resolve(packet.geometry[k], packet.instance[k], packet.primitive[k]);
      set.distance[i] = packet.t_far[k];
      set.u[i] = packet.u[k], set.v[i] = packet.v[k];
      set.instance[i] = ref.instance, set.triangle[i] = ref.triangle;
    }
  }
}

void DropHidden(const RayTracer& tracer, ShadowRays& shadow) {
  RayHit16 packet;
  alignas(64) int valid[16];
  for (int first = 0; first < shadow.rays.count; first += 16) {
    bool occluded[16] = {};
    FillPacket(shadow.rays, first, shadow.reach, packet, valid);
    tracer.Occluded16(valid, packet, occluded, false);
    for (int k = 0; k < 16 && first + k < shadow.rays.count; ++k)
      if (occluded[k]) shadow.light[first + k] = {};
  }
}

void DimByPanes(const PathScene& scene, ShadowRays& shadow) {
  // Slots are indices into the shadow rays while these move on.
  RaySet rays = shadow.rays, hits, misses;
  std::iota(rays.slot, rays.slot + rays.count, 0u);
  SurfaceSet surfaces;
  ScatterSet passed;
  float reach[kBatch];
  std::copy_n(shadow.reach, rays.count, reach);
  for (int pane = 0; rays.count > 0; ++pane) {
    TraceNearest(scene.tracer, rays, false, hits, misses, reach);
    Pad(hits);
    rays.count = 0;
    if (hits.count == 0) return;
    scene.kernels.prepare(scene.view, hits, surfaces);
    scene.pass_straight(hits, surfaces, passed);
    for (int i = 0; i < hits.count; ++i) {
      Vec3f& light = shadow.light[hits.slot[i]];
      light = pane < kMostPanes ? light * Vec3f{passed.r[i], passed.g[i], passed.b[i]} : Vec3f{};
      if (!(light.x + light.y + light.z > 0)) continue;
      const int k = rays.count++;
      const Vec3f from = LeaveSurface(hits, surfaces, i, {hits.dx[i], hits.dy[i], hits.dz[i]});
      CopyRay(hits, i, rays, k);
      const Vec3f way = from - Vec3f{shadow.rays.ox[hits.slot[i]], shadow.rays.oy[hits.slot[i]], shadow.rays.oz[hits.slot[i]]};
      reach[k] = shadow.reach[hits.slot[i]] - Norm(way);
      rays.ox[k] = from.x, rays.oy[k] = from.y, rays.oz[k] = from.z;
    }
  }
}

float OffsetOf(const RaySet& rays, const SurfaceSet& s, int i) {
  // Above the rounding errors of hit points.
  return RayOffset({s.px[i], s.py[i], s.pz[i]}, rays.distance[i]);
}

Vec3f LeaveSurface(const RaySet& rays, const SurfaceSet& s, int i, Vec3f d) {
  const Vec3f p{s.px[i], s.py[i], s.pz[i]}, g{s.gx[i], s.gy[i], s.gz[i]};
  const float offset = OffsetOf(rays, s, i);
  return p + g * (Dot(g, d) < 0 ? -offset : offset);
}

}  // namespace airsim360::internal

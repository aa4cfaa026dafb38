#include "airsim360/render/shading/secondary_rays.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

// Offset of secondary rays: above the rounding errors of hit points.
float OffsetAt(Vec3f p, float distance) {
  return 1e-3f + 4e-6f * (std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z) + distance);
}

// Sixteen rays collected one by one, with the place where each answer goes.
struct RayQueue {
  RayHit16 rays{};
  alignas(64) int valid[16] = {};
  int lane[16] = {};
  int count = 0;

  void Add(Vec3f p, Vec3f d, int index, float reach = INFINITY) {
    const int i = count++;
    rays.origin_x[i] = p.x, rays.origin_y[i] = p.y, rays.origin_z[i] = p.z;
    rays.direction_x[i] = d.x, rays.direction_y[i] = d.y, rays.direction_z[i] = d.z;
    rays.t_near[i] = 0, rays.t_far[i] = reach, rays.mask[i] = UINT32_MAX;
    lane[i] = index;
  }
  // Marks the lanes in use; the others repeat the last ray.
  void Close() {
    for (int i = 0; i < 16; ++i) {
      valid[i] = i < count ? -1 : 0;
      if (i < count) continue;
      rays.origin_x[i] = rays.origin_x[0], rays.origin_y[i] = rays.origin_y[0],
      rays.origin_z[i] = rays.origin_z[0];
      rays.direction_x[i] = rays.direction_x[0], rays.direction_y[i] = rays.direction_y[0],
      rays.direction_z[i] = rays.direction_z[0];
      rays.t_near[i] = 0, rays.t_far[i] = INFINITY, rays.mask[i] = UINT32_MAX;
    }
  }
};

}  // namespace

void Pad(RaySet& set) {
  if (set.count == 0) return;
  const int from = set.count - 1;
  for (int i = set.count; i < kBatch && i % 16 != 0; ++i) {
    set.ox[i] = set.ox[from], set.oy[i] = set.oy[from], set.oz[i] = set.oz[from];
    set.dx[i] = set.dx[from], set.dy[i] = set.dy[from], set.dz[i] = set.dz[from];
    set.distance[i] = set.distance[from], set.width[i] = set.width[from];
    set.u[i] = set.u[from], set.v[i] = set.v[from];
    set.instance[i] = set.instance[from], set.triangle[i] = set.triangle[from], set.key[i] = set.key[from];
  }
}

void TraceSun(const RayTracer& tracer, const RaySet& rays, SurfaceSet& s) {
  RayQueue queue;
  const auto flush = [&] {
    bool occluded[16] = {};
    queue.Close();
    tracer.Occluded16(queue.valid, queue.rays, occluded,
                      false);  // faster so, and Embree 3.13 hung on coherent ones
    for (int i = 0; i < queue.count; ++i) s.sunlit[queue.lane[i]] = occluded[i] ? 0.0f : 1.0f;
    queue.count = 0;
  };
  for (int i = 0; i < rays.count; ++i) {
    if (s.sunlit[i] == 0) continue;
    const Vec3f p{s.px[i], s.py[i], s.pz[i]}, g{s.gx[i], s.gy[i], s.gz[i]}, l{s.lx[i], s.ly[i], s.lz[i]};
    const float side = Dot(g, l) < 0 ? -1.0f : 1.0f;
    queue.Add(p + g * (side * OffsetAt(p, rays.distance[i])), l, i);
    if (queue.count == 16) flush();
  }
  if (queue.count > 0) flush();
}

void TraceContact(const RayTracer& tracer, const RaySet& rays, SurfaceSet& s) {
  constexpr float kReach = 1.2f, kLeast = 0.25f, kFarthest = 40.0f;
  RayQueue queue;
  const auto flush = [&] {
    queue.Close();
    tracer.Intersect16(queue.valid, queue.rays, true);
    for (int i = 0; i < queue.count; ++i) {
      if (queue.rays.geometry[i] == kMiss) continue;
      const float t = std::min(1.0f, queue.rays.t_far[i] / kReach);
      s.contact[queue.lane[i]] = kLeast + (1 - kLeast) * t * t * (3 - 2 * t);
    }
    queue.count = 0;
  };
  for (int i = 0; i < rays.count; ++i) {
    if (s.gz[i] < 0.7f || rays.distance[i] > kFarthest || s.kind[i] != 0) continue;
    const Vec3f p{s.px[i], s.py[i], s.pz[i]}, g{s.gx[i], s.gy[i], s.gz[i]};
    queue.Add(p + g * OffsetAt(p, rays.distance[i]), {0.0123f, 0.0071f, 1}, i, kReach);
    if (queue.count == 16) flush();
  }
  if (queue.count > 0) flush();
}

void TraceReflections(const RayTracer& tracer, const RaySet& rays, const SurfaceSet& s, RaySet& hits,
                      RaySet& misses) {
  hits.count = misses.count = 0;
  RayQueue queue;
  const auto flush = [&] {
    queue.Close();
    tracer.Intersect16(queue.valid, queue.rays, false);
    for (int k = 0; k < queue.count; ++k) {
      const RayHit16& r = queue.rays;
      const int from = queue.lane[k];
      const bool miss = r.geometry[k] == kMiss;
      RaySet& set = miss ? misses : hits;
      const int i = set.count++;
      set.ox[i] = r.origin_x[k], set.oy[i] = r.origin_y[k], set.oz[i] = r.origin_z[k];
      set.dx[i] = r.direction_x[k], set.dy[i] = r.direction_y[k], set.dz[i] = r.direction_z[k];
      set.slot[i] = static_cast<uint32_t>(from);
      set.key[i] = 0;
      if (miss) continue;
      const SurfaceRef ref = tracer.Resolve(r.geometry[k], r.instance[k], r.primitive[k]);
      set.distance[i] = r.t_far[k];
      set.width[i] = rays.width[from] * (1 + r.t_far[k] / std::max(rays.distance[from], 0.01f));
      set.u[i] = r.u[k], set.v[i] = r.v[k];
      set.instance[i] = ref.instance, set.triangle[i] = ref.triangle;
    }
    queue.count = 0;
  };
  for (int i = 0; i < rays.count; ++i) {
    if (s.mirror[i] == 0) continue;
    const Vec3f p{s.px[i], s.py[i], s.pz[i]}, g{s.gx[i], s.gy[i], s.gz[i]};
    queue.Add(p + g * OffsetAt(p, rays.distance[i]), {s.rx[i], s.ry[i], s.rz[i]}, i);
    if (queue.count == 16) flush();
  }
  if (queue.count > 0) flush();
}

}  // namespace airsim360::internal

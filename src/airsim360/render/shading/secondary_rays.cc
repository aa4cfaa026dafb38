#include "airsim360/render/shading/secondary_rays.h"

#include <algorithm>
#include <cmath>

#include "airsim360/render/shading/ray_queue.h"

namespace airsim360::internal {
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
    queue.Add(p + g * (side * RayOffset(p, rays.distance[i])), l, i);
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
    queue.Add(p + g * RayOffset(p, rays.distance[i]), {0.0123f, 0.0071f, 1}, i, kReach);
    if (queue.count == 16) flush();
  }
  if (queue.count > 0) flush();
}

namespace {

// Sorts what the rays of a queue met into hits and misses.
void TakeHits(const RayTracer& tracer, const RaySet& from, RayQueue& queue, RaySet& hits, RaySet& misses) {
  queue.Close();
  tracer.Intersect16(queue.valid, queue.rays, false);
  for (int k = 0; k < queue.count; ++k) {
    const RayHit16& r = queue.rays;
    const int source = queue.lane[k];
    const bool miss = r.geometry[k] == kMiss;
    RaySet& set = miss ? misses : hits;
    const int i = set.count++;
    set.ox[i] = r.origin_x[k], set.oy[i] = r.origin_y[k], set.oz[i] = r.origin_z[k];
    set.dx[i] = r.direction_x[k], set.dy[i] = r.direction_y[k], set.dz[i] = r.direction_z[k];
    set.slot[i] = static_cast<uint32_t>(source);
    set.key[i] = 0;
    if (miss) continue;
    const SurfaceRef ref = tracer.Resolve(r.geometry[k], r.instance[k], r.primitive[k]);
    set.distance[i] = r.t_far[k];
    set.width[i] = from.width[source] * (1 + r.t_far[k] / std::max(from.distance[source], 0.01f));
    set.u[i] = r.u[k], set.v[i] = r.v[k];
    set.instance[i] = ref.instance, set.triangle[i] = ref.triangle;
  }
  queue.count = 0;
}

}  // namespace

void TraceReflections(const RayTracer& tracer, const RaySet& rays, const SurfaceSet& s, RaySet& hits,
                      RaySet& misses) {
  hits.count = misses.count = 0;
  RayQueue queue;
  for (int i = 0; i < rays.count; ++i) {
    if (s.mirror[i] == 0) continue;
    const Vec3f p{s.px[i], s.py[i], s.pz[i]}, g{s.gx[i], s.gy[i], s.gz[i]};
    queue.Add(p + g * RayOffset(p, rays.distance[i]), {s.rx[i], s.ry[i], s.rz[i]}, i);
    if (queue.count == 16) TakeHits(tracer, rays, queue, hits, misses);
  }
  if (queue.count > 0) TakeHits(tracer, rays, queue, hits, misses);
}

void TraceClear(const RayTracer& tracer, const RaySet& rays, const SurfaceSet& s, RaySet& hits,
                RaySet& misses) {
  constexpr float kGlass = 2;  // SurfaceKind
  hits.count = misses.count = 0;
  RayQueue queue;
  for (int i = 0; i < rays.count; ++i) {
    if (s.kind[i] != kGlass || s.transmission[i] <= 0) continue;
    const Vec3f p{s.px[i], s.py[i], s.pz[i]}, g{s.gx[i], s.gy[i], s.gz[i]};
    queue.Add(p - g * RayOffset(p, rays.distance[i]), {rays.dx[i], rays.dy[i], rays.dz[i]}, i);
    if (queue.count == 16) TakeHits(tracer, rays, queue, hits, misses);
  }
  if (queue.count > 0) TakeHits(tracer, rays, queue, hits, misses);
}

}  // namespace airsim360::internal

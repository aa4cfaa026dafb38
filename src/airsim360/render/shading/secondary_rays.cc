#include "airsim360/render/shading/secondary_rays.h"

#include <algorithm>
#include <cmath>

#include "airsim360/render/lights/clear_panes.h"
#include "airsim360/render/shading/ray_queue.h"
#include "airsim360/render/shared/shading_kernels.h"

namespace airsim360::internal {

void SeenShare(const RayTracer& tracer, const SurfaceTables& tables, RayQueue& queue, float* share) {
  bool occluded[16] = {};
  float reach[16];
  std::copy(queue.rays.t_far, queue.rays.t_far + 16, reach);
  queue.Close();
  // Faster without COHERENT, and Embree 3.13 hung on coherent ones.
  tracer.Occluded16(queue.valid, queue.rays, occluded, false);
  for (int i = 0; i < queue.count; ++i) share[i] = occluded[i] ? 0.0f : 1.0f;
  if (!tracer.has_clear_panes()) return;
  for (int i = 0; i < queue.count; ++i) {
    queue.valid[i] = occluded[i] ? 0 : -1;
    queue.rays.t_far[i] = reach[i];
  }
  std::array<Vec3f, 16> tint;
  tint.fill({1, 1, 1});
  DimByPanes(tracer, tables, queue.valid, queue.rays, tint);
  for (int i = 0; i < queue.count; ++i) share[i] *= (tint[i].x + tint[i].y + tint[i].z) / 3;
}

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

namespace {

// Whether the sixteen (or the rest, of `count`) from `first` on are all 0.
bool NoneSet(const float* flags, int first, int count) {
  int set = 0;
  if (first + 16 <= count) {
    for (int k = first; k < first + 16; ++k) set |= flags[k] != 0 ? 1 : 0;
  } else {
    for (int k = first; k < count; ++k) set |= flags[k] != 0 ? 1 : 0;
  }
  return set == 0;
}

// The first vector with a flag; `count` or more if there is none.
int FirstSet(const float* flags, int count) {
  int i = 0;
  while (i < count && NoneSet(flags, i, count)) i += 16;
  return i;
}

// Rays of directions (x, y, z)[16] from sixteen surfaces from `first` on; the same numbers as one by one.
void AddSixteen(const RaySet& rays, const SurfaceSet& s, int first, const float* x, const float* y, const float* z, float reach,
                RayQueue& queue) {
  static const auto lift = AIRSIM360_SELECT_KERNEL(LiftRays);
  lift(rays, s, first, x, y, z, queue.rays);
  queue.Fill(first, reach);
}

}  // namespace

void TraceSun(const RayTracer& tracer, const SurfaceTables& tables, const RaySet& rays, SurfaceSet& s) {
  static const auto ask = AIRSIM360_SELECT_KERNEL(AskSun);
  RayQueue queue(kMaskSolid), whole(kMaskSolid);
  const auto flush = [&] {
    float share[16];
    SeenShare(tracer, tables, queue, share);
    for (int i = 0; i < queue.count; ++i) s.sunlit[queue.lane[i]] = share[i];
    queue.count = 0;
  };
  for (int first = 0; first < rays.count; first += 16) {
    const uint32_t asked = ask(s, first) & Existing(first, rays.count);
    if (asked == 0xffffu) {
      // Sixteen surfaces that all ask make a packet at once.
      AddSixteen(rays, s, first, s.lx + first, s.ly + first, s.lz + first, INFINITY, whole);
      SeenShare(tracer, tables, whole, s.sunlit + first);
      continue;
    }
    ForLanes(asked, [&](int lane) {
      const int i = first + lane;
      const Vec3f p{s.px[i], s.py[i], s.pz[i]}, g{s.gx[i], s.gy[i], s.gz[i]}, l{s.lx[i], s.ly[i], s.lz[i]};
      const float side = Dot(g, l) < 0 ? -1.0f : 1.0f;
      queue.Add(p + g * (side * RayOffset(p, rays.distance[i])), l, i);
      if (queue.count == 16) flush();
    });
  }
  if (queue.count > 0) flush();
}

void TraceContact(const RayTracer& tracer, const RaySet& rays, SurfaceSet& s) {
  static const auto ask = AIRSIM360_SELECT_KERNEL(AskContact);
  RayQueue queue, whole;
  const auto flush = [&](RayQueue& full) {
    full.Close();
    tracer.Intersect16(full.valid, full.rays, true);
    for (int i = 0; i < full.count; ++i) {
      if (full.rays.geometry[i] == kMiss) continue;
      s.contact[full.lane[i]] = scalar::contact_share(full.rays.t_far[i], kContactReach);
    }
    full.count = 0;
  };
  constexpr Vec3f kUp{kContactX, kContactY, 1};
  float up[3][16];
  for (int k = 0; k < 16; ++k) up[0][k] = kUp.x, up[1][k] = kUp.y, up[2][k] = kUp.z;
  for (int first = 0; first < rays.count; first += 16) {
    const uint32_t asked = ask(rays, s, first, kContactFarthest) & Existing(first, rays.count);
    if (asked == 0xffffu) {
      AddSixteen(rays, s, first, up[0], up[1], up[2], kContactReach, whole);
      flush(whole);
      continue;
    }
    ForLanes(asked, [&](int lane) {
      const int i = first + lane;
      const Vec3f p{s.px[i], s.py[i], s.pz[i]}, g{s.gx[i], s.gy[i], s.gz[i]};
      queue.Add(p + g * RayOffset(p, rays.distance[i]), kUp, i, kContactReach);
      if (queue.count == 16) flush(queue);
    });
  }
  if (queue.count > 0) flush(queue);
}

void TraceLamps(const RayTracer& tracer, const SurfaceTables& tables, const RaySet& rays, const LampRays& wanted, int count,
                SurfaceSet& s) {
  RayQueue queue(kMaskSolid);
  const LampRays::Ray* asked[16];
  const auto learn = [&](int i, const LampRays::Ray& ray, float seen) {
    const float more = (seen - ray.guess) * ray.share;
    s.lamp_r[i] += ray.front[0] * more, s.lamp_g[i] += ray.front[1] * more, s.lamp_b[i] += ray.front[2] * more;
    s.lamp_back_r[i] += ray.back[0] * more, s.lamp_back_g[i] += ray.back[1] * more;
    s.lamp_back_b[i] += ray.back[2] * more;
    s.lamp_shine_r[i] += ray.shine[0] * more, s.lamp_shine_g[i] += ray.shine[1] * more;
    s.lamp_shine_b[i] += ray.shine[2] * more;
  };
  const auto flush = [&] {
    float share[16];
    SeenShare(tracer, tables, queue, share);
    for (int i = 0; i < queue.count; ++i) learn(queue.lane[i], *asked[i], share[i]);
    queue.count = 0;
  };
  for (int k = 0; k < count; ++k) {
    for (int i = 0; i < rays.count; ++i) {
      const LampRays::Ray& ray = wanted.ray[k][i];
      if (ray.share == 0) continue;
      const Vec3f p{s.px[i], s.py[i], s.pz[i]}, g{s.gx[i], s.gy[i], s.gz[i]}, d{ray.dx, ray.dy, ray.dz};
      const float offset = RayOffset(p, rays.distance[i]);
      if (ray.distance <= offset) {
        learn(i, ray, 1);
        continue;
      }
      asked[queue.count] = &ray;
      queue.Add(p + g * (Dot(g, d) < 0 ? -offset : offset), d, i, ray.distance);
      if (queue.count == 16) flush();
    }
  }
  if (queue.count > 0) flush();
}

namespace {

void FindTint(const RayTracer& tracer, const RayQueue& queue, PaneTint& panes) {
  std::array<Vec3f, 16> tint;
  tint.fill({1, 1, 1});
  if (tracer.has_clear_panes()) {
    RayHit16 rays = queue.rays;
    DimByPanes(tracer, panes.tables, queue.valid, rays, tint);
  }
  for (int k = 0; k < queue.count; ++k) panes.of[static_cast<size_t>(queue.lane[k])] = tint[static_cast<size_t>(k)];
}

// Sorts what the rays of a queue met into hits and misses.
void TakeHits(const RayTracer& tracer, const RaySet& from, PaneTint* panes, RayQueue& queue, RaySet& hits, RaySet& misses) {
  queue.Close();
  tracer.Intersect16(queue.valid, queue.rays, false);
  if (panes != nullptr) FindTint(tracer, queue, *panes);
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
    set.width[i] = from.width[source] * (1 + r.t_far[k] / std::max(from.distance[source], kLeastRange));
    set.u[i] = r.u[k], set.v[i] = r.v[k];
    set.instance[i] = ref.instance, set.triangle[i] = ref.triangle;
  }
  queue.count = 0;
}

}  // namespace

void TraceReflections(const RayTracer& tracer, const RaySet& rays, const SurfaceSet& s, PaneTint* panes, RaySet& hits, RaySet& misses) {
  hits.count = misses.count = 0;
  const int first = FirstSet(s.mirror, rays.count);
  if (first >= rays.count) return;
  RayQueue queue(panes != nullptr ? kMaskSolid : kMaskAll);
  for (int i = first; i < rays.count; ++i) {
    if (i % 16 == 0 && NoneSet(s.mirror, i, rays.count)) {
      i += 15;
      continue;
    }
    if (s.mirror[i] == 0) continue;
    const Vec3f p{s.px[i], s.py[i], s.pz[i]}, g{s.gx[i], s.gy[i], s.gz[i]};
    queue.Add(p + g * RayOffset(p, rays.distance[i]), {s.rx[i], s.ry[i], s.rz[i]}, i);
    if (queue.count == 16) TakeHits(tracer, rays, panes, queue, hits, misses);
  }
  if (queue.count > 0) TakeHits(tracer, rays, panes, queue, hits, misses);
}

void TraceClear(const RayTracer& tracer, const RaySet& rays, const SurfaceSet& s, PaneTint* panes, RaySet& hits, RaySet& misses) {
  hits.count = misses.count = 0;
  const int first = FirstSet(s.transmission, rays.count);
  if (first >= rays.count) return;
  RayQueue queue(panes != nullptr ? kMaskSolid : kMaskAll);
  for (int i = first; i < rays.count; ++i) {
    if (i % 16 == 0 && NoneSet(s.transmission, i, rays.count)) {
      i += 15;
      continue;
    }
    if (s.kind[i] != kGlass || s.transmission[i] <= 0) continue;
    const Vec3f p{s.px[i], s.py[i], s.pz[i]}, g{s.gx[i], s.gy[i], s.gz[i]};
    queue.Add(p - g * RayOffset(p, rays.distance[i]), {rays.dx[i], rays.dy[i], rays.dz[i]}, i);
    if (queue.count == 16) TakeHits(tracer, rays, panes, queue, hits, misses);
  }
  if (queue.count > 0) TakeHits(tracer, rays, panes, queue, hits, misses);
}

}  // namespace airsim360::internal

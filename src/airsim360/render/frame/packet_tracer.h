// Tracing a packet of camera rays, with the kernels this machine runs.
#pragma once

#include <limits>

#include "airsim360/render/frame/tile_kernel.h"

namespace airsim360::internal {

/// The kernels of tile_kernel.h for this machine.
struct TileKernels {
  decltype(&isa_sse42::InitPacket) init = AIRSIM360_SELECT_KERNEL(InitPacket);
  decltype(&isa_sse42::FillPacket) fill = AIRSIM360_SELECT_KERNEL(FillPacket);
  decltype(&isa_sse42::ResolvePacket) resolve = AIRSIM360_SELECT_KERNEL(ResolvePacket);
  decltype(&isa_sse42::AppendHits) append_hits = AIRSIM360_SELECT_KERNEL(AppendHits);
  decltype(&isa_sse42::PrefetchTile) prefetch = AIRSIM360_SELECT_KERNEL(PrefetchTile);
  decltype(&isa_sse42::StoreLabels) store_labels = AIRSIM360_SELECT_KERNEL(StoreLabels);
  decltype(&isa_sse42::StoreColors) store_colors = AIRSIM360_SELECT_KERNEL(StoreColors);
  decltype(&isa_sse42::MarkEdges) mark_edges = AIRSIM360_SELECT_KERNEL(MarkEdges);
};

/// Nearest hits of the valid lanes. In a scene without a sky (a closed room) a ray that meets nothing has
/// slipped through a seam between meshes: such rays are turned by 1e-6, then 1e-5, 1e-4 rad until they hit.
inline void TracePacket(const RayTracer& tracer, bool has_sky, const int* valid, RayHit16& rays) {
  tracer.Intersect16(valid, rays, true);
  if (has_sky) return;
  alignas(64) int again[16];
  float nudge = 1e-6f;
  for (int attempt = 0; attempt < 3; ++attempt, nudge *= -10) {
    bool any = false;
    for (int i = 0; i < 16; ++i) {
      again[i] = rays.geometry[i] == kMiss ? valid[i] : 0;
      any |= again[i] != 0;
    }
    if (!any) return;
    for (int i = 0; i < 16; ++i) {
      if (again[i] == 0) continue;
      rays.direction_x[i] += nudge;
      rays.direction_y[i] += 0.7f * nudge;
      rays.direction_z[i] -= 0.4f * nudge;
      rays.t_far[i] = std::numeric_limits<float>::infinity();
    }
    tracer.Intersect16(again, rays, false);
  }
}

/// TracePacket of the first `lanes` rays (1 to 16), to any distance; `valid` is set. The other lanes repeat
/// the first, for packets must be finite.
inline void TraceLanes(const RayTracer& tracer, bool has_sky, int lanes, int* valid, RayHit16& rays) {
  for (int i = 0; i < 16; ++i) {
    valid[i] = i < lanes ? -1 : 0;
    rays.t_far[i] = std::numeric_limits<float>::infinity();
    if (i < lanes) continue;
    rays.direction_x[i] = rays.direction_x[0];
    rays.direction_y[i] = rays.direction_y[0];
    rays.direction_z[i] = rays.direction_z[0];
  }
  TracePacket(tracer, has_sky, valid, rays);
}

}  // namespace airsim360::internal

// The rays that surfaces send: to the sun, upwards, along reflections. All trace sixteen at a time.
#pragma once

#include <array>
#include <bit>

#include "airsim360/render/shading/ray_queue.h"
#include "airsim360/render/shared/shading_data.h"
#include "airsim360/render/surface/surface_tables.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// Share of light that gets to each ray's origin: 0 behind something solid, less than 1 behind clear panes
/// (their colour is averaged).
void SeenShare(const RayTracer& tracer, const SurfaceTables& tables, RayQueue& queue, float* share);
/// The bits of those of the sixteen surfaces from `first` on that exist.
inline uint32_t Existing(int first, int count) { return count - first >= 16 ? 0xffffu : (1u << (count - first)) - 1; }
/// Calls `each` for the lanes of `bits`.
template <class Each>
void ForLanes(uint32_t bits, Each each) {
  for (; bits != 0; bits &= bits - 1) each(std::countr_zero(bits));
}
/// Repeats the last ray of a set up to a full vector, so that kernels read sane values.
void Pad(RaySet& set);
/// Turns `sunlit` from "may matter" to "is seen": 1, less behind clear panes.
void TraceSun(const RayTracer& tracer, const SurfaceTables& tables, const RaySet& rays, SurfaceSet& s);
/// Ground close under something (a car, a bench) gets less light than the probes, metres apart, can tell: one
/// ray upwards sets `contact`.
void TraceContact(const RayTracer& tracer, const RaySet& rays, SurfaceSet& s);
/// Traces the rays of LightByLamps and corrects lamp_* by what they find.
void TraceLamps(const RayTracer& tracer, const SurfaceTables& tables, const RaySet& rays, const LampRays& wanted, int count, SurfaceSet& s);
/// What clear panes on the way of secondary rays do. In rooms they let light through: windows are bright in mirrors.
struct PaneTint {
  const SurfaceTables& tables;
  std::array<Vec3f, kBatch> of{};  ///< by surface: share of light that gets through
};
/// Follows the reflections of panes, water and mirrors: what they meet, and those that meet nothing; `slot`
/// is the index of the surface. panes == nullptr: clear panes are met as surfaces.
void TraceReflections(const RayTracer& tracer, const RaySet& rays, const SurfaceSet& s, PaneTint* panes, RaySet& hits, RaySet& misses);
/// Follows the view through clear panes (glass with transmission), one each, to what stands behind.
void TraceClear(const RayTracer& tracer, const RaySet& rays, const SurfaceSet& s, PaneTint* panes, RaySet& hits, RaySet& misses);

}  // namespace airsim360::internal

// What clear panes take from light on its way.
#pragma once

#include <array>

#include "airsim360/render/surface/surface_tables.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// Multiplies `tint` of the lanes with valid[i] == -1 by what the panes between t_near and t_far let through:
/// base colour times transmission times what their two faces do not reflect. `rays` are as before their
/// query (t_far positive) and are overwritten. At most four panes count.
/// `veiled`: and times what the veil of dirt on them leaves, as in `reference`.
void DimByPanes(const RayTracer& tracer, const SurfaceTables& tables, const int* valid, RayHit16& rays, std::array<Vec3f, 16>& tint,
                bool veiled = false);

/// Rays that panes turn back by chance, as often as they mirror light.
struct PaneTurns {
  float number[16];  ///< of each ray, in [0, 1): the lower, the sooner it is turned; used up
  float at[16];      ///< distance of the pane that turns the ray; INFINITY: none does
  Vec3f normal[16];  ///< of that pane, to either side
};
/// As DimByPanes, with what panes mirror as `reference` has it. The tint is of rays that go on and holds what the body of a pane takes.
void TurnAtPanes(const RayTracer& tracer, const SurfaceTables& tables, const int* valid, RayHit16& rays, std::array<Vec3f, 16>& tint,
                 PaneTurns& turns);

}  // namespace airsim360::internal

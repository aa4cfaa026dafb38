// What clear panes take from light on its way.
#pragma once

#include <array>

#include "airsim360/render/surface/surface_tables.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// Multiplies `tint` of the lanes with valid[i] == -1 by what the panes between t_near and t_far let through:
/// base colour times transmission times what their two faces do not reflect. `rays` are as before their
/// query (t_far positive) and are overwritten. At most four panes count.
void DimByPanes(const RayTracer& tracer, const SurfaceTables& tables, const int* valid, RayHit16& rays, std::array<Vec3f, 16>& tint);

}  // namespace airsim360::internal

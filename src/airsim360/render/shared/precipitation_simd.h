// shading_precipitation.h as SIMD C++, with a RoofMap's view for the roofs (only for *_kernel.cc files and their tests).
#pragma once

#include "airsim360/render/shared/lane_gather.h"

namespace airsim360::internal::AIRSIM360_ISA {

#define SHARED static inline __attribute__((always_inline, unused))
#define ROOFS_ARGUMENT const RoofView &roofs,
#define ROOFS roofs,
#define ROOFS_TEXELS_PER_METRE roofs.cells_per_metre
SHARED mask_t roof_hides(const RoofView& map, real3 p) {
  if (map.heights == nullptr) return mask_t(false);
  const real shift = p.z * map.lean, last = real(static_cast<float>(map.size - 1)), zero = real(0.0f);
  const real column = (p.x - shift - map.origin_x) * map.cells_per_metre, row = (p.y - map.origin_y) * map.cells_per_metre;
  const mask_t inside = (column > 0.0f) && (column < last) && (row > 0.0f) && (row < last);
  const ireal at = to_int(rmin(last, rmax(zero, row))) * map.size + to_int(rmin(last, rmax(zero, column)));
  return inside && (p.z < GatherFloats(map.heights, at));
}
#include "airsim360/render/shared/shading_precipitation.h"
#undef SHARED
#undef ROOFS_ARGUMENT
#undef ROOFS
#undef ROOFS_TEXELS_PER_METRE

}  // namespace airsim360::internal::AIRSIM360_ISA

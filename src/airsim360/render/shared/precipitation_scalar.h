// shading_precipitation.h as plain C++ floats, with a RoofMap's view for the roofs.
#pragma once

#include <algorithm>

#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360::internal::scalar {

#define SHARED static inline __attribute__((always_inline, unused))
#define ROOFS_ARGUMENT const RoofView &roofs,
#define ROOFS roofs,
#define ROOFS_TEXELS_PER_METRE roofs.cells_per_metre
SHARED bool roof_hides(const RoofView& map, Vec3f p) {
  if (map.heights == nullptr) return false;
  const float shift = p.z * map.lean;
  const float column = (p.x - shift - map.origin_x) * map.cells_per_metre, row = (p.y - map.origin_y) * map.cells_per_metre;
  const auto last = static_cast<float>(map.size - 1);
  if (!(column > 0 && column < last && row > 0 && row < last)) return false;
  return p.z < map.heights[static_cast<int32_t>(row) * map.size + static_cast<int32_t>(column)];
}
#include "airsim360/render/shared/shading_precipitation.h"
#undef SHARED
#undef ROOFS_ARGUMENT
#undef ROOFS
#undef ROOFS_TEXELS_PER_METRE

}  // namespace airsim360::internal::scalar

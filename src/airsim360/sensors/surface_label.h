// What a ray sensor learns of the surface it meets.
#pragma once

#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

struct SurfaceLabel {
  EntityId entity = kNoEntity;
  CategoryId category = kVoid;
  float reflectance = 0;  ///< 0 … 1: mean of the base colour (without its texture) times the instance's tint
};

/// Label of a hit of `tracer`.
SurfaceLabel LabelOf(const RayTracer& tracer, const SurfaceRef& surface);

}  // namespace airsim360

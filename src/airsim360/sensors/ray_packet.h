// Sixteen rays of a ray sensor at a time.
#pragma once

#include <cstddef>
#include <span>

#include "airsim360/sensors/surface_label.h"

namespace airsim360 {

/// One ray in W; the direction has unit length.
struct SensorRay {
  Vec3f origin, direction;
};

/// What one ray met: range 0 = nothing within reach.
struct SensorHit {
  float range = 0;   ///< metres along the ray
  float cosine = 0;  ///< between ray and surface normal, 0 … 1
  SurfaceLabel label;
};

/// Traces up to 16 rays as one packet, from `near` to `far` metres. `through_panes`: clear glass is not seen.
/// Every lane gives what the same ray gives in any other packet.
void TraceRays(const RayTracer& tracer, std::span<const SensorRay> rays, float near, float far, bool through_panes,
               std::span<SensorHit> hits);

}  // namespace airsim360

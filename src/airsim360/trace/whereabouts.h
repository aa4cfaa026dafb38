// Whether a place can be looked around from: in the open, inside something solid, or outside of a closed scene.
#pragma once

#include <cstdint>

#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

struct Whereabouts {
  enum class Kind {
    kOpen,
    kInside,  ///< nearly all that is above are backs of surfaces: within a solid, or below the ground
    kOutside  ///< rays leave a scene that has no sky
  };
  Kind kind = Kind::kOpen;
  SurfaceRef surface = {};  ///< kInside: the nearest back that is seen upward, of what is around
};

/// Tells from rays in 256 directions which sides of surfaces they meet. The front of a triangle
/// is where its vertices run counter-clockwise; models that are wound at random are `kOpen`.
Whereabouts FindWhereabouts(const RayTracer& tracer, Vec3d p_W);

}  // namespace airsim360

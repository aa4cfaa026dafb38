// What planning knows of a world: how far the nearest surface is.
#pragma once

#include "airsim360/math/vector.h"

namespace airsim360 {

/// Distances to the surfaces of a world. Implementations are immutable and may be asked by several threads.
class ClearanceQuery {
 public:
  virtual ~ClearanceQuery() = default;
  /// Metres from p (in W) to the nearest surface, at most `max_distance`; exact but for rounding, so that it
  /// changes by at most the distance between two points.
  virtual double Clearance(Vec3d p_W, double max_distance) const = 0;
};

}  // namespace airsim360

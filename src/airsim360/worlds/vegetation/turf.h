// Turf: blades of grass in tufts, as they grow, mown or not.
#pragma once

#include <functional>

#include "airsim360/worlds/vegetation/plant_mesh.h"

namespace airsim360::internal {

/// Lengths in metres.
struct Turf {
  float low, high;        ///< heights that blades grow to
  float mown = 0;         ///< the mower's height; 0 = never mown
  float width = 0.0034f;  ///< of a blade at its foot, on average
  float straw = 0.06f;    ///< share of dry blades
};

/// `count` blades in tufts whose middles `place` draws; a blade is `shorter(p)` times its height. Places are in the layer's
/// coordinates, on the ground.
void AddTurf(PlantLayer& layer, const Turf& turf, int count, const std::function<Vec3f()>& place,
             const std::function<float(Vec3f)>& shorter, RngStream& random);

}  // namespace airsim360::internal

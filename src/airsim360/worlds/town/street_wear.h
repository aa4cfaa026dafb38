// What years leave on carriageways and pavements: repairs, trenches, seams, sealed cracks, oil, tyre marks, silt and litter.
#pragma once

#include <functional>

#include "airsim360/base/random.h"
#include "airsim360/worlds/town/ground.h"
#include "airsim360/worlds/town/street_markings.h"

namespace airsim360::internal {

/// Wear of a stretch: part of the entity that was laid last (the road).
void LayWear(Ground& ground, const StreetStretch& street, RngStream& rng);
/// Wear of a crossing, draped over its fan; part of the entity that was laid last.
void LayJunctionWear(Ground& ground, const Fan& fan, RngStream& rng);

/// A point of a pavement at (s along, d from the kerb), metres.
using PavementPoint = std::function<Vec3f(float s, float d, float lift)>;
/// Litter, stains and replaced slabs between s0 and s1, d0 and d1; part of the entity that was laid last, whose surface is
/// `slabs`.
void LayPavementWear(Ground& ground, const PavementPoint& at, float s0, float s1, float d0, float d1, Surface slabs, RngStream& rng);

}  // namespace airsim360::internal

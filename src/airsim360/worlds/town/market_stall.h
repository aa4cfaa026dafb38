// The counter of a market stall with crates of fruit.
#pragma once

#include "airsim360/scene/scene.h"
#include "airsim360/worlds/texture/surfaces.h"

namespace airsim360::internal {

/// A counter of 2.6 x 0.9 m, front towards -Y, with eight tilted crates; `variant` chooses the goods.
MeshId AddStallMesh(SceneBuilder& builder, const Surfaces& surfaces, uint32_t variant);

}  // namespace airsim360::internal

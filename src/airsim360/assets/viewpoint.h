// A first point to look from.
#pragma once

#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// In a place (wider than 20 m): at eye height above the lowest open ground near its middle. Before a single
/// thing: off its front (-Y) at a distance where all of it is seen. Deterministic.
Vec3f ChooseViewpoint(const std::vector<Mesh>& meshes, const std::vector<Instance>& instances, const Box3f& bounds);

}  // namespace airsim360::internal

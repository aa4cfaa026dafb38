// What turns on a bicycle of traffic: both wheels, the cranks and the pedals, cut from its mesh.
#pragma once

#include <array>
#include <optional>

#include "airsim360/scene/scene.h"
#include "airsim360/sim/traffic/traffic.h"
#include "airsim360/traffic/pedalling.h"
#include "airsim360/worlds/props/bicycle.h"

namespace airsim360::internal {

/// A bicycle as meshes: what stays together, then what turns (BicyclePart).
struct BicycleMeshes {
  MeshId frame = 0;
  std::array<MeshId, kBicycleParts> part{};
  const BicycleMeasures* measures = nullptr;
};

/// Which of kBicycleMeasures a mesh has; null: a bicycle made elsewhere.
const BicycleMeasures* MeasuresOf(const Mesh& bicycle);

/// Cuts a mesh into what hangs together and takes what lies around the hubs and the bracket of one of kBicycleMeasures. Adds new meshes
/// to the scene, without the stand; nullopt where there are no such wheels, cranks and pedals: a bicycle made elsewhere.
std::optional<BicycleMeshes> AddBicycleMeshes(MeshId bicycle, Scene& scene);

/// Where a part of a mesh has come to, in the axes of the mesh. `pitch`: how far the toes of this side point down, radians; pedals keep to
/// the soles.
AffineTransform PlaceOfPart(const BicycleMeasures& measures, BicyclePart part, const Cycling& cycling, double pitch);

}  // namespace airsim360::internal

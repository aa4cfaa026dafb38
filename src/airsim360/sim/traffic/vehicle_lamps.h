// Brake lamps and direction indicators of vehicles that drive: lit glasses over those of their models, which the scene holds as
// instances and an instant shows or hides.
#pragma once

#include <optional>

#include "airsim360/sim/traffic/traffic.h"

namespace airsim360::internal {

/// Lit glasses of one model of a vehicle; nullopt: it has no lamps.
struct LampMeshes {
  std::optional<MeshId> brake, left, right;
};

/// Adds them to the scene: where a mesh has head and tail lamps (materials that shine as beams), a copy of their glasses a few
/// millimetres farther out. Brake lamps are red at the tail; indicators amber at nose and tail of one side. They burn by day, too.
/// `scale`: metres a unit of the mesh.
LampMeshes AddLampMeshes(MeshId vehicle, float scale, Scene& scene);

/// Adds an instance for each lamp, of the entity of the vehicle. They begin as points below the ground, so that nothing is lit
/// by them where they were made.
VehicleLamps AddLamps(const LampMeshes& meshes, EntityId entity, Scene& scene);

/// Whether an indicator of a vehicle is lit at t_ns while it blinks: 90 times a minute (60 to 120 in UN Regulation 48), each
/// vehicle with its own beat.
bool BlinksAt(size_t vehicle, int64_t t_ns);

}  // namespace airsim360::internal

// What is added to a world's scene before it is served: bodies of the drones, and bodies and objects held ready
// for simAddVehicle and simSpawnObject. A scene never changes; what is not in use is hidden.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "airsim360/rpc/settings/settings.h"
#include "airsim360/sim/drone_bodies.h"

namespace airsim360 {

/// A kind of thing that simSpawnObject can make. The model has no textures.
struct SpawnAsset {
  std::string name, category;  ///< path in the semantic tree
  Model model;
};
/// Shapes under the names that AirSim's Blocks environment has: Cube, Sphere, Cylinder, Cone; 1 m each.
std::vector<SpawnAsset> ShapeAssets();

/// One kind with its copies.
struct SpawnStock {
  std::string asset;
  std::vector<DroneBodyRef> copies;
};

struct SceneExtras {
  /// Of the drones of the settings in the order of their names, then those held ready.
  std::vector<DroneBodyRef> drones;
  std::vector<SpawnStock> stock;
};

inline constexpr size_t kSpareDrones = 32;
/// Objects of an asset that can be in the world at a time: obstacle courses are made of cubes.
size_t CopiesOf(const SpawnAsset& asset);

/// All of them, the drones first, to be added to a scene.
std::vector<DroneBodySpec> ExtraBodies(const Scene& scene, const AirSimSettings& settings, const std::vector<SpawnAsset>& assets);
/// What became of the bodies of ExtraBodies.
SceneExtras SortExtras(std::span<const DroneBodyRef> bodies, const std::vector<SpawnAsset>& assets);

}  // namespace airsim360

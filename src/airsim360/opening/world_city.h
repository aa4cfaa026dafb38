// What a world file says about a built-in world beyond its name: the city's measures, models of the user's
// own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "airsim360/base/config.h"
#include "airsim360/base/disk_cache.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {

/// An entry of `props:`.
struct PropFile {
  std::string model;                        ///< .glb, .gltf or .obj, relative to the world file
  std::string label = "object", name = {};  ///< category path; name of the entity, empty = the file's stem
  double x = 0, y = 0, z = 0;               ///< metres in W
  double yaw_deg = 0, scale = 1;
};

struct WorldAdditions {
  CityOptions city;
  TownSpec town;
  BuildingSpec building;
  std::vector<PropFile> props;

  /// Whether nothing is said of the city, of the town, or of the building.
  bool no_city() const;
  bool no_town() const;
  bool no_building() const;
  /// Names the fields `city:`, `town:`, `building:` and `props:`.
  void Visit(ConfigVisitor& v);
  /// Paths of the models start at `folder`; checks names and labels. InputError naming `file`.
  void Resolve(const std::filesystem::path& file);
  void AddTo(CacheKey& key) const;
  /// Reads the models. InputError naming the model's file.
  std::vector<PlacedModel> LoadModels() const;
};

}  // namespace airsim360

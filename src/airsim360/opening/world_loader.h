// A world by name or by file: built-in worlds, model files (assets/importing/import.h), maps (.osm, .osm.pbf, …), world YAML.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "airsim360/assets/importing/placement.h"
#include "airsim360/opening/world_city.h"
#include "airsim360/scene/scene.h"
#include "airsim360/worlds/osm/osm_world.h"

namespace airsim360 {

struct WorldRequest {
  std::string world;  ///< name of a built-in world, or path to .glb/.gltf/.obj/.osm/.osm.pbf/.yaml
  uint64_t seed = 0;
  std::filesystem::path labels = {};   ///< label file, over that of a world .yaml; see docs/guide/labels.md
  bool use_models = true;              ///< use sweethome3d-furniture where installed
  std::filesystem::path heights = {};  ///< of the ground of maps: a GeoTIFF, read through GDAL's gdalwarp
  bool fill = true;                    ///< maps: add by rule what they seldom hold, see docs/guide/maps.md
  ModelPlacement placement = {};       ///< models: units, up axis, ground, place
  std::optional<MapCut> cut = {};      ///< maps: only this piece
  WorldAdditions additions = {};       ///< what a world file adds
};

/// InputError for an unknown name (naming the nearest), a missing or malformed file.
std::shared_ptr<const Scene> LoadWorld(const WorldRequest& request);

/// A map (.osm, .osm.pbf, …), built anew, with what became of it; LoadWorld finds it in the disk cache then.
std::shared_ptr<const Scene> LoadMap(const WorldRequest& request, OsmReport* report);

/// Where the world's origin lies on the Earth (altitude 0), read without building it; nullopt for worlds that are no
/// maps.
std::optional<GeoPoint> OriginOfWorld(const WorldRequest& request);

/// Rooms and doors of a building, found without building it; nullopt for worlds that are no buildings.
std::optional<BuildingRooms> RoomsOf(const WorldRequest& request);

}  // namespace airsim360

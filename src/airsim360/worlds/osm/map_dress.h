// What a drawn town gives to the builders of maps beyond its map: surfaces and walls of its own, how full its streets
// are, what is built at the end.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/worlds/building/massing.h"
#include "airsim360/worlds/texture/surfaces.h"

namespace airsim360::internal {

struct OsmScene;
struct OsmBuilding;
struct Neighbours;

/// A wall of a building:material that real maps do not know.
struct MapWall {
  FacadeStyle style;
  MaterialId material;
  float mean;  ///< albedo of its picture, for walls with a colour of their own
};

struct MapDress {
  double trees = 1, traffic = 1;      ///< share of what is put along streets by rule: 0 … 1.6
  const char* lamp = "street_light";  ///< kind of prop along streets; nullptr: none
  bool yard_trees = true, yard_cars = true;
  bool town_around = true;  ///< the town goes on beyond the map where it is dense; else open country
  std::map<std::string, MapWall, std::less<>> walls;
  /// Before anything is built: may change surfaces and fill `walls`.
  std::function<void(SceneBuilder&, Surfaces&, MapDress&)> paint;
  /// After everything is built.
  std::function<void(OsmScene&, const std::vector<OsmBuilding>&, const Neighbours&)> finish;

  const MapWall* FindWall(std::string_view material) const {
    const auto it = walls.find(material);
    return it == walls.end() ? nullptr : &it->second;
  }
};

}  // namespace airsim360::internal

// The built-in worlds, each a pure function of (name, seed, options).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/scene/building_rooms.h"
#include "airsim360/scene/model_source.h"
#include "airsim360/scene/scene.h"
#include "airsim360/worlds/building_spec.h"
#include "airsim360/worlds/town_spec.h"

namespace airsim360 {

struct WorldInfo {
  std::string name;
  std::string setting;                  ///< "outdoor" or "indoor"
  double area_m2 = 0;                   ///< ground that can be reached
  std::vector<std::string> categories;  ///< paths of the categories present
  std::string description;
};

/// All built-in worlds, by name.
const std::vector<WorldInfo>& ListWorlds();

/// The time that new_york_city shows; the world new_york_city_1950s is the same city of the second.
enum class CityStyle { kPresent, k1950s };
inline constexpr const char* kCityStyles[] = {"present", "1950s"};

/// What a world file may change about new_york_city, or new_york_city_1950s.
struct CityOptions {
  CityStyle style = CityStyle::kPresent;  ///< new_york_city_1950s shows the 1950s in any case
  double height = 1;                      ///< of towers: 0.3 … 2.5
  double traffic = 1;                     ///< cars in lanes and bays: 0 … 1.6
  double trees = 1;                       ///< street trees: 0 … 1.6
  double furniture = 1;                   ///< things on the pavements: 0 … 2
  bool billboards = true;                 ///< beside those that instructions name
  std::vector<std::string> styles;        ///< facade styles of lots that are not hand-set; empty = all
};
/// Names of the facade styles, as CityOptions::styles has them.
const std::vector<std::string>& FacadeStyleNames();

/// A model of the user's own, to stand in a built-in outdoor world.
struct PlacedModel {
  std::string name, category;  ///< of its entity; a category path, of the tree or a new one
  Model model;
  Vec3f p_W;
  float yaw = 0, scale = 1;
};

struct WorldOptions {
  uint64_t seed = 0;
  const ModelSource* models = nullptr;  ///< used where it has a model; every prop has a procedural fallback
  CityOptions city = {};
  std::vector<PlacedModel> props = {};
  TownSpec town = {};          ///< of the world "town" alone
  BuildingSpec building = {};  ///< of the world "building" alone
};

/// Rooms and doors of a building by the name of its world, without building it; nullopt for worlds that are none.
std::optional<BuildingRooms> RoomsOfWorld(std::string_view name, const WorldOptions& options);

/// Builds a world; InputError naming the nearest if there is no such world.
std::shared_ptr<const Scene> BuildWorld(std::string_view name, const WorldOptions& options);

}  // namespace airsim360

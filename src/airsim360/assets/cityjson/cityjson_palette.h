// What the objects and surfaces of CityJSON are here, and what they are made of.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/assets/gltf/gltf_json_internal.h"
#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// A type of object.
struct CityType {
  std::string_view type, category;
  Vec3f colour;  ///< linear albedo where the file tells none
};

/// A surface that is an entity of its own.
struct CitySurface {
  std::string_view type, suffix, category;  ///< category "": that of the object
  Vec3f colour;
};

/// "object" for extensions ("+Shed") and types of later versions.
const CityType& CityTypeOf(std::string_view type);
/// Null for surfaces that are of their object (walls, ground …).
const CitySurface* CitySurfaceOf(std::string_view type);

/// The materials of a world: those of the file (colours; no pictures), else one a kind of surface.
class CityPalette {
 public:
  /// The member "appearance" of a file.
  void Read(JsonRef appearance);
  /// Which of them the surfaces of a geometry have: one for all, or nested as its boundaries.
  struct Choice {
    std::optional<JsonRef> one, nested;
  };
  Choice ChoiceOf(const JsonRef& geometry) const;
  /// `colour`: an index into the file's materials, or null.
  MaterialId Get(const std::string& type, const CitySurface* surface, const std::optional<JsonRef>& colour);
  std::vector<Material> Take() { return std::move(materials_); }

 private:
  std::string theme_;
  std::vector<Material> colours_, materials_;
  std::map<std::string, MaterialId> ids_;
};

}  // namespace airsim360::internal

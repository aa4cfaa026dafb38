// The props of a world: each kind is one file in props/, procedural, with an optional ready-made model that replaces it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/math/transform.h"
#include "airsim360/scene/model_source.h"
#include "airsim360/scene/scene.h"

namespace airsim360 {

/// How one kind of prop is made. Models stand on z = 0, centred on the z axis, front towards -Y, metres.
struct PropKind {
  std::string_view name;         ///< "bench_wood"
  std::string_view category;     ///< path in the semantic tree
  std::string_view library_model;  ///< name to ask the ModelSource for; "" = always procedural
  int variants = 1;              ///< different individuals
  Model (*make)(uint64_t seed);  ///< procedural individual
  float footprint_radius = 0.5f;  ///< metres of ground it needs free of other props
};

/// All kinds, by name: one row per file in props/ and vegetation/.
const std::vector<PropKind>& PropKinds();
/// A kind by name; InputError naming the nearest.
const PropKind& FindPropKind(std::string_view name);

/// Adds props to a scene: each (kind, variant) is loaded once and instanced.
class PropShelf {
 public:
  PropShelf(SceneBuilder& builder, const ModelSource* models, uint64_t seed);
  /// Places one prop as an entity of its own and returns it. `variant` is taken modulo the kind's variants.
  EntityId Place(std::string_view kind, Vec3f p_W, float yaw = 0, uint32_t variant = 0, float scale = 1,
                 Vec3f tint = {1, 1, 1});
  /// Adds an instance of a kind to an existing entity (grass tufts of one lawn, say).
  void PlaceAs(EntityId entity, std::string_view kind, const AffineTransform& X_WM, uint32_t variant = 0, Vec3f tint = {1, 1, 1});

 private:
  MeshId Get(const PropKind& kind, uint32_t variant);

  SceneBuilder& builder_;
  const ModelSource* models_;
  uint64_t seed_;
  std::map<std::pair<std::string_view, uint32_t>, MeshId> meshes_;
};

}  // namespace airsim360

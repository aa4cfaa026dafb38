// Ready-made models by name (furniture, cars, plants): worlds ask, whoever has a library answers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/scene/material.h"
#include "airsim360/scene/mesh.h"

namespace airsim360 {

/// One model in metres, +Z up, standing on z = 0, centred on the z axis, its front towards -Y. Parts refer to
/// `materials` by index, materials to `textures` by index.
struct Model {
  Mesh mesh;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::string attribution;  ///< title, author, licence
};

/// Users plug in libraries of models here.
class ModelSource {
 public:
  virtual ~ModelSource() = default;
  /// The model called `name`, or nullopt if this library does not have it (callers then use a procedural
  /// one).
  virtual std::optional<Model> Load(std::string_view name) const = 0;
};

}  // namespace airsim360

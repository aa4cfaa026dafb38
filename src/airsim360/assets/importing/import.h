// glTF 2.0 (.glb, .gltf), Wavefront OBJ/MTL and CityJSON (.city.json, .json, .jsonl) into a Scene; formats of other
// programs through those (convert_model.h). Files are untrusted: any damage is an InputError
// that names the file, the place in it and the value; sizes and depths are bounded; nothing crashes.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "airsim360/assets/importing/placement.h"
#include "airsim360/scene/model_source.h"
#include "airsim360/scene/scene.h"

namespace airsim360 {

struct ImportOptions {
  /// YAML or JSON that overrides labels, see docs/guide/labels.md; empty = NAME.labels.yaml (.yml, .json) beside
  /// the model NAME.glb if there is one.
  std::filesystem::path labels = {};
  ModelPlacement placement = {};
};

/// Imports a model file as a world of its own under the default sky: exactly what it holds; a ground is added
/// where the placement asks for one. Every node with a mesh (glTF) or object/group (OBJ) is an entity; its category comes from the label
/// file, else from keywords in the node, mesh, parents', material and file names, else "object". Sets a
/// viewpoint. InputError if there is nothing to see.
std::shared_ptr<const Scene> ImportScene(const std::filesystem::path& file, const ImportOptions& options = {});

/// The scene with the categories and names that a label file gives its entities by their names: for worlds that
/// are not imported models. Patterns are held against the whole name ('/' is a character like any other);
/// `keywords`, `default` and `merge` do not count. A rule that matches nothing is a warning. An empty path changes
/// nothing. InputError as ParseLabelRules.
std::shared_ptr<const Scene> Relabelled(std::shared_ptr<const Scene> scene, const std::filesystem::path& labels);

/// Categories of entities that differ from those of their scene.
struct EntityLabels {
  SemanticTree tree;                  ///< with paths of its own
  std::vector<CategoryId> of_entity;  ///< by id; kVoid = as in the scene
  CategoryId Of(EntityId entity, CategoryId otherwise) const {
    return entity < of_entity.size() && of_entity[entity] != kVoid ? of_entity[entity] : otherwise;
  }
};
/// A pattern as in a label file, held against the whole name, and the category path of what matches it.
struct LabelPattern {
  std::string pattern, category;
};
/// `over` (null: none) changed by patterns, the first that matches an entity counts. Adds to `changed` how many
/// entities match any, to `unused` (where given) the patterns that match none. InputError for a malformed path.
EntityLabels LabelEntities(const Scene& scene, const EntityLabels* over, std::span<const LabelPattern> patterns, size_t& changed,
                           std::vector<std::string>* unused = nullptr);

/// One model file as a single prop (all nodes merged), in metres, +Z up, standing on z = 0 and centred on the
/// z axis.
Model ImportModel(const std::filesystem::path& file);

/// Where Debian installs them.
inline constexpr const char* kSweetHomeFolder = "/usr/share/sweethome3d/furniture";

/// The models of Debian's sweethome3d-furniture, read in place; null if the package is not installed. Names
/// are file stems of the catalogue ("poplar", "fordFocus"), or "library/stem" where several libraries share
/// one ("Scopia/bench"). Models come at their catalogue size. Each call reads its model anew; calls from
/// several threads are fine.
std::unique_ptr<ModelSource> OpenSweetHomeModels(const std::filesystem::path& folder = kSweetHomeFolder);

}  // namespace airsim360

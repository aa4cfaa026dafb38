// The tree of categories: the same path has the same id in every world and every version (append only).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace airsim360 {

using CategoryId = uint16_t;
inline constexpr CategoryId kVoid = 0;             ///< never written by our worlds
inline constexpr CategoryId kFirstCustomId = 256;  ///< built-in ids are below

/// One node of the tree, leaf or inner. External ids are -1 where there is no counterpart.
struct Category {
  CategoryId id = kVoid;
  std::string path = {};      ///< "vegetation/tree/conifer/pine"
  CategoryId parent = kVoid;  ///< kVoid for roots
  bool thing = true;          ///< countable thing (COCO sense), else stuff
  int ade20k = -1;            ///< SceneParse-150, 0-based
  int cityscapes = -1;        ///< label id 0..33
  int coco = -1;              ///< COCO panoptic category id
};

/// Built-in categories plus the custom ones of a world. Value type.
class SemanticTree {
 public:
  /// The built-in tree.
  SemanticTree();
  /// Id of a path; nullopt if it is not in the tree.
  std::optional<CategoryId> Find(std::string_view path) const;
  /// Id of a path; InputError naming the nearest valid path if it is not in the tree.
  CategoryId At(std::string_view path) const;
  /// Category of an id; InputError if unknown.
  const Category& operator[](CategoryId id) const;
  /// Adds a path (and missing ancestors) unless present; returns its id: a hash of the path, or the next free
  /// id where an earlier path has that one. External ids are those of the nearest ancestor that has one.
  /// InputError if ids run out; for paths not of [a-z0-9_]/…, at most 8 parts, 200 characters.
  CategoryId Add(std::string_view path, bool thing = true);
  /// Gives custom categories the ids that they have if added in order of path: they follow from the set of
  /// paths then, not from who came first. Returns the new ids of those that changed, by the old ones.
  std::map<CategoryId, CategoryId> SettleIds();
  /// All categories, by id.
  const std::map<CategoryId, Category>& categories() const { return categories_; }

 private:
  CategoryId FreeId(std::string_view path) const;

  std::map<CategoryId, Category> categories_;
  std::map<std::string, CategoryId, std::less<>> ids_;
};

}  // namespace airsim360

// The classes of the AirSim360 paper's scenes by its own spellings (table "list of semantic categories for each scene").
#pragma once

#include <map>
#include <string>
#include <vector>

#include "airsim360/dataset/export/native_dataset.h"

namespace airsim360::internal {

/// A class list as the official release has it: names in the order of their ids, from 1.
struct SceneClasses {
  std::string record;                   ///< X of X_record.csv: "CityPark"
  std::string list;                     ///< X of semantic_lists_X.txt: "citypark"
  std::vector<std::string> names;       ///< 25, 29, 20 and 25 of the paper's scenes
  std::map<CategoryId, uint8_t> id_of;  ///< categories of the dataset that are of a class; all others are 0

  uint8_t IdOf(CategoryId category) const;
};

/// Those of a world. A category is of the class of its nearest ancestor (or itself) that the paper names; where there
/// is none, parts of the ground (markings, kerbs, lawns) are of the surface that they belong to. Worlds that the paper
/// does not have: their own categories, by path. InputError for more than 255 of them.
SceneClasses ClassesOf(const std::string& world, const NativeDataset& data);

}  // namespace airsim360::internal

// Class lists of indoor data sets, by categories of the tree.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace airsim360::internal {

enum class IndoorList {
  kNyu40,       ///< the 40 classes that ScanNet's label images hold, 1 … 40
  kMpcat40,     ///< Matterport3D's 40 categories, 1 … 40
  kStanford13,  ///< the 13 classes of 2D-3D-S in alphabetical order, 1 … 13
};

/// Names of the classes; names[i] has id i + 1.
std::span<const char* const> IndoorNames(IndoorList list);
/// Id of a category's class: that of its nearest ancestor (or itself) that has one; -1 = none.
int IndoorId(IndoorList list, std::string_view path);

}  // namespace airsim360::internal

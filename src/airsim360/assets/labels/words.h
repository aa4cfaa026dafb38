// Words of the names that people give to nodes, meshes and materials.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360::internal {

/// Lower-case words of a name, split at case changes, digits and anything that is not a letter, with plurals
/// cut to the singular: "streetLamps_03" -> street lamp; "HTMLTree" -> html tree.
std::vector<std::string> SplitWords(std::string_view name);

/// Any of `wanted` among `words`.
bool HasWord(const std::vector<std::string>& words, std::initializer_list<std::string_view> wanted);

}  // namespace airsim360::internal

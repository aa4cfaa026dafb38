// Whether a world can be opened, without opening it.
#pragma once

#include <string>
#include <vector>

namespace airsim360 {

/// Names of the built-in worlds.
std::vector<std::string> WorldNames();

/// Whether a built-in world has this name, or a file this path.
bool WorldExists(const std::string& name_or_file);

}  // namespace airsim360

// Whether a world can be opened, without opening it.
#pragma once

#include <string>

namespace airsim360 {

/// Whether a built-in world has this name, or a file this path.
bool WorldExists(const std::string& name_or_file);

}  // namespace airsim360

#include "airsim360/opening/world_exists.h"

#include <algorithm>
#include <filesystem>

#include "airsim360/worlds/worlds.h"

namespace airsim360 {

bool WorldExists(const std::string& name_or_file) {
  std::error_code error;
  if (std::filesystem::exists(name_or_file, error)) return true;
  return std::ranges::any_of(ListWorlds(), [&](const WorldInfo& info) { return info.name == name_or_file; });
}

}  // namespace airsim360

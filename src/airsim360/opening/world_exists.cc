#include "airsim360/opening/world_exists.h"

#include <algorithm>
#include <filesystem>

#include "airsim360/worlds/worlds.h"

namespace airsim360 {

std::vector<std::string> WorldNames() {
  std::vector<std::string> names;
  for (const WorldInfo& info : ListWorlds()) names.push_back(info.name);
  return names;
}

bool WorldExists(const std::string& name_or_file) {
  std::error_code error;
  if (std::filesystem::exists(name_or_file, error)) return true;
  return std::ranges::count(WorldNames(), name_or_file) > 0;
}

}  // namespace airsim360

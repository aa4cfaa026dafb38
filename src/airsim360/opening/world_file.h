// What a world YAML puts into a world after it is built.
#pragma once

#include <filesystem>
#include <vector>

#include "airsim360/worlds/furnishings/placed_lamps.h"

namespace airsim360 {

/// `lamps:` of a world YAML. Reads the whole file as LoadWorld does, without building anything; InputError as LoadWorld.
std::vector<PlacedLamp> LampsOfWorldFile(const std::filesystem::path& file);

}  // namespace airsim360

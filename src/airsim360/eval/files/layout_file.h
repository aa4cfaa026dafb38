// Corners of rooms as HorizonNet's files hold them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "airsim360/eval/layout/layout_metrics.h"

namespace airsim360 {

/// .txt: lines "x y" in pixels, in turn a ceiling corner and the floor corner below it; .json: {"uv": [[u, v], …]} in the same order, shares of width and height.
/// InputError naming the file and line.
RoomLayout ReadLayoutFile(const std::filesystem::path& path, int width, int height);
RoomLayout ParseLayoutFile(std::string_view text, const std::string& name, bool json, int width, int height);

}  // namespace airsim360

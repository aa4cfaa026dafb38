// Route files: CSV with a header that names the columns.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "airsim360/sim/route.h"

namespace airsim360 {

/// Columns x, y, z (metres, W), and optionally yaw_deg (counter-clockwise from east) and t (seconds, strictly
/// increasing), in any order. Without a header line the columns are x,y,z. Empty lines and lines that start
/// with '#' are skipped. InputError "name:line:column: …" for anything else, for numbers that are not finite
/// and for an empty file.
std::vector<Waypoint> ParseRouteCsv(std::string_view text, std::string_view name);
std::vector<Waypoint> ReadRouteCsv(const std::filesystem::path& path);

}  // namespace airsim360

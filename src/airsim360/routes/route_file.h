// Route files: CSV with a header that names the columns, YAML, GPX and KML.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/math/geodesy.h"
#include "airsim360/routes/route.h"

namespace airsim360 {

/// Columns x, y, z (metres, W), and optionally yaw_deg (counter-clockwise from east) and t (seconds, strictly
/// increasing), in any order. Without a header line the columns are x,y,z (three), x,y,z,t (four). Empty
/// lines and lines that start with '#' are skipped. InputError "name:line:column: …" for anything else, for
/// numbers that are not finite and for an empty file.
std::vector<Waypoint> ParseRouteCsv(std::string_view text, std::string_view name);

/// `waypoints:` with an entry `{x: 1, y: 2, z: 3}` each, yaw_deg and t as in CSV. Errors likewise.
std::vector<Waypoint> ParseRouteYaml(std::string_view text, std::string_view name);

/// The points of a GPX file (wpt, rtept, trkpt with ele) or the coordinates of a KML file, in file order.
/// Around `origin`; without one the first point is x = y = 0, and heights are those of the file. Errors
/// likewise; documents with a DOCTYPE are refused.
std::vector<Waypoint> ParseRouteXml(std::string_view text, std::string_view name, const std::optional<GeoPoint>& origin = std::nullopt);

/// Message for a waypoint whose time is not after that of the one before.
std::string TimeDoesNotGrow(double before, double t);

/// By the extension: .yaml, .yml, .json, .gpx, .kml; anything else is CSV. Files up to 64 MiB.
std::vector<Waypoint> ReadRouteFile(const std::filesystem::path& path, const std::optional<GeoPoint>& origin = std::nullopt);

}  // namespace airsim360

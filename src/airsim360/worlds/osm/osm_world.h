// A world from an OpenStreetMap extract.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "airsim360/math/geodesy.h"
#include "airsim360/scene/model_source.h"
#include "airsim360/scene/scene.h"
#include "airsim360/worlds/osm/data/map_cut.h"

namespace airsim360 {

/// Heights of the ground on a regular grid of degrees (north up), metres over any common level.
struct HeightGrid {
  int columns = 0, rows = 0;
  double longitude_west = 0, latitude_north = 0;  ///< outer corner of the first cell
  double cell_lon = 0, cell_lat = 0;              ///< degrees a cell, both positive
  std::vector<float> heights;                     ///< row by row from the north; NaN = unknown
};

struct OsmOptions {
  uint64_t seed = 0;
  const ModelSource* models = nullptr;  ///< as WorldOptions::models
  /// Heights of the ground in an area (the map and a kilometre around it); empty = flat. Cells that are unknown
  /// take the heights around them.
  std::function<HeightGrid(const GeoBox&)> heights = {};
  std::optional<MapCut> cut = {};  ///< only this piece of the map
  bool fill = true;                ///< add what maps seldom hold, by rule: parked cars, and lamps or trees where the map has none
};

/// What the import made of one building.
struct OsmBuildingReport {
  std::string id;  ///< "way/123"
  EntityId entity = kNoEntity;
  double height = 0;   ///< metres over the ground, roof included
  const char* source;  ///< "tag", "levels" or "guess"
  double area = 0;     ///< of the outline, m^2; 0 = the file lacks its shape
  bool part = false;   ///< a building:part outside all buildings
};

/// Figures of an import.
struct OsmReport {
  GeoPoint origin;              ///< of W; the altitude is that of the ground there in the file of heights, 0 without one
  double width = 0, depth = 0;  ///< metres, of the extract
  std::vector<OsmBuildingReport> buildings;
};

/// Is this the name of an OpenStreetMap file: .osm, .osm.pbf, .pbf, .osm.gz, .osm.bz2?
bool IsOsmFile(const std::filesystem::path& file);

/// The world of an extract: W at its middle (east, north, up). Every building, road segment, junction, area,
/// tree, lamp, bench … is an entity whose name begins with its OSM id, as "way/123 Town Hall" or
/// "way/123/roof". A function of the file, the options and nothing else. InputError naming the file (and
/// line:column) for damage, an empty extract, or one beyond the limits of osm_data.h.
std::shared_ptr<const Scene> BuildOsmWorld(const std::filesystem::path& file, const OsmOptions& options, OsmReport* report = nullptr);
/// Where W of that world would lie, as OsmReport::origin but without heights, without building it.
GeoPoint OriginOfOsmWorld(const std::filesystem::path& file, const std::optional<MapCut>& cut);
/// The same of bytes in memory; `name` tells the format by its ending.
std::shared_ptr<const Scene> BuildOsmWorld(const std::string& name, std::span<const std::byte> bytes, const OsmOptions& options,
                                           OsmReport* report = nullptr);

}  // namespace airsim360

// Which piece of a map becomes a world.
#pragma once

#include <optional>
#include <string>

namespace airsim360 {

/// A piece of the Earth between meridians and parallels, degrees.
struct GeoBox {
  double west = 0, south = 0, east = 0, north = 0;
  bool Contains(double latitude, double longitude) const {
    return latitude >= south && latitude <= north && longitude >= west && longitude <= east;
  }
};

/// "60.1,24.9,60.2,25 (south,west,north,east)"
std::string DescribeBox(const GeoBox& box);

struct MapCut {
  std::string text;  ///< as the user said it, for messages and keys: "--bbox 60.1,24.9,60.2,25"
  GeoBox box;
  std::optional<GeoBox> otherwise = {};  ///< the same numbers as west,south,east,north; counts where `box` holds nothing
};

/// "SOUTH,WEST,NORTH,EAST" in degrees, also in OpenStreetMap's order WEST,SOUTH,EAST,NORTH: the one that meets the map
/// counts. InputError naming `flag` and what is wrong.
MapCut CutByBox(const std::string& flag, const std::string& text);

/// A square of `radius` metres (10 … 30000) to each side of "LATITUDE,LONGITUDE". InputError naming the flags.
MapCut CutAround(const std::string& flag, const std::string& text, const std::string& radius_flag, double radius);

/// The cut that the settings `bbox`, or `centre` and `radius`, ask for ("" and 0: not given); `prefix` stands before
/// their names in messages. InputError for both, or for one of the pair alone.
std::optional<MapCut> MapCutOf(const std::string& prefix, const std::string& bbox, const std::string& centre, double radius);

}  // namespace airsim360

#include "airsim360/worlds/osm/data/map_cut.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/math/geodesy.h"

namespace airsim360 {
namespace {

constexpr double kHighestLatitude = 85;  // degrees of latitude that worlds reach

// Numbers between commas; empty if anything else is there.
std::vector<double> NumbersOf(const std::string& text) {
  std::vector<double> values;
  const char *p = text.data(), *const end = p + text.size();
  while (true) {
    while (p < end && *p == ' ') ++p;
    double value = 0;
    const auto [stop, error] = std::from_chars(p, end, value);
    if (error != std::errc() || !std::isfinite(value)) return {};
    values.push_back(value);
    p = stop;
    while (p < end && *p == ' ') ++p;
    if (p == end) return values;
    if (*p++ != ',') return {};
  }
}

// What is wrong with a box, "" = nothing.
std::string FaultOf(const GeoBox& box) {
  char text[160] = "";
  if (std::abs(box.south) > kHighestLatitude || std::abs(box.north) > kHighestLatitude)
    std::snprintf(text, sizeof(text), "latitudes %g and %g are not within %g south and north", box.south, box.north, kHighestLatitude);
  else if (std::abs(box.west) > 180 || std::abs(box.east) > 180)
    std::snprintf(text, sizeof(text), "longitudes %g and %g are not in -180 … 180", box.west, box.east);
  else if (!(box.south < box.north))
    std::snprintf(text, sizeof(text), "south %g is not below north %g", box.south, box.north);
  else if (!(box.west < box.east))
    std::snprintf(text, sizeof(text), "west %g is not left of east %g", box.west, box.east);
  return text;
}

}  // namespace

std::string DescribeBox(const GeoBox& box) {
  char text[160];
  std::snprintf(text, sizeof(text), "%.7g,%.7g,%.7g,%.7g (south,west,north,east)", box.south, box.west, box.north, box.east);
  return text;
}

MapCut CutByBox(const std::string& flag, const std::string& text) {
  const std::vector<double> v = NumbersOf(text);
  if (v.size() != 4)
    throw InputError(flag + ": '" + text + "' is not SOUTH,WEST,NORTH,EAST in degrees, for example 60.165,24.93,60.175,24.95");
  MapCut cut{flag + " " + text, {.west = v[1], .south = v[0], .east = v[3], .north = v[2]}};
  const GeoBox osm{.west = v[0], .south = v[1], .east = v[2], .north = v[3]};
  const std::string fault = FaultOf(cut.box);
  if (FaultOf(osm).empty()) {
    if (fault.empty())
      cut.otherwise = osm;
    else
      cut.box = osm;
  } else if (!fault.empty()) {
    throw InputError(flag + ": '" + text + "' as SOUTH,WEST,NORTH,EAST: " + fault);
  }
  return cut;
}

MapCut CutAround(const std::string& flag, const std::string& text, const std::string& radius_flag, double radius) {
  const std::vector<double> v = NumbersOf(text);
  if (v.size() != 2) throw InputError(flag + ": '" + text + "' is not LATITUDE,LONGITUDE in degrees, for example 60.1708,24.9375");
  if (std::abs(v[0]) > kHighestLatitude || std::abs(v[1]) > 180)
    throw InputError(flag + ": '" + text +
                     "' is not LATITUDE,LONGITUDE: latitudes are within 85 south and north, longitudes in -180 … 180");
  char number[32];
  std::snprintf(number, sizeof(number), "%g", radius);
  if (!(radius >= 10 && radius <= 30000)) throw InputError(radius_flag + ": " + number + " is not in 10 … 30000 metres");
  const GeoFrame frame({v[0], v[1], 0});
  const GeoPoint low = frame.ToGeodetic({-radius, -radius, 0}), high = frame.ToGeodetic({radius, radius, 0});
  return {flag + " " + text + " " + radius_flag + " " + number,
          {.west = low.longitude_deg, .south = low.latitude_deg, .east = high.longitude_deg, .north = high.latitude_deg}};
}

std::optional<MapCut> MapCutOf(const std::string& prefix, const std::string& bbox, const std::string& centre, double radius) {
  if (!bbox.empty() && (!centre.empty() || radius != 0))
    throw InputError(prefix + "bbox: it cuts the map as " + prefix + "centre and " + prefix + "radius do; give one or the other");
  if (!bbox.empty()) return CutByBox(prefix + "bbox", bbox);
  if (!centre.empty() && radius == 0) throw InputError(prefix + "centre: " + prefix + "radius is missing, metres to each side");
  if (!centre.empty()) return CutAround(prefix + "centre", centre, prefix + "radius", radius);
  if (radius != 0) throw InputError(prefix + "radius: " + prefix + "centre is missing, LATITUDE,LONGITUDE in degrees");
  return std::nullopt;
}

}  // namespace airsim360

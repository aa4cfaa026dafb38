// Heights of the ground from a GeoTIFF, by way of GDAL's program gdalwarp (Debian's gdal-bin), a process of its
// own: nothing of GDAL is linked.
#pragma once

#include <filesystem>

#include "airsim360/worlds/osm_world.h"

namespace airsim360 {

/// The first band, brought to degrees of WGS 84. InputError for a file that is none or has no place on the Earth,
/// or more than 2^26 cells; RuntimeError where gdalwarp is not installed.
HeightGrid ReadHeights(const std::filesystem::path& file);

}  // namespace airsim360

// Heights of the ground from a GeoTIFF, by way of GDAL's programs gdalinfo and gdalwarp (Debian's gdal-bin),
// processes of their own: nothing of GDAL is linked.
#pragma once

#include <filesystem>

#include "airsim360/worlds/osm/osm_world.h"

namespace airsim360 {

/// The first band within `area`, metres (its scale, offset and feet are heeded), on a grid of degrees of WGS 84:
/// the file's own cells where it has degrees, else smaller cells (a quarter or half of the size), so that little is smoothed. Cells that
/// the file leaves unknown stay NaN. InputError for a file that is no GeoTIFF of heights (pictures, several bands),
/// has no place on the Earth, does not reach the area, knows no height in it, or gives more than 2^26 cells there;
/// RuntimeError where gdal-bin is not installed.
HeightGrid ReadHeights(const std::filesystem::path& file, const GeoBox& area);

}  // namespace airsim360

// Arrays in HDF5 files. One of two sources stands behind it (module.cmake): builds without the library refuse such files.
#pragma once

#include <filesystem>
#include <string>

#include "airsim360/eval/files/number_array.h"

namespace airsim360 {

/// A dataset of an HDF5 file: `key`, or where that is "" the one named depth, range or data, else the only one. Integers and floats; the filters
/// gzip, shuffle and LZF. InputError also where this build has no HDF5 library.
NumberArray ReadHdf5(const std::filesystem::path& path, const std::string& key);

}  // namespace airsim360

// One picture of floats as an HDF5 file ("HDF5 File Format Specification", version 1.x files: superblock 0).
#pragma once

#include <string>

#include "airsim360/base/file.h"
#include "airsim360/image/image.h"

namespace airsim360::internal {

/// A file whose root group holds one dataset `name` of height x width little-endian float32, in chunks of rows with the
/// filters shuffle and gzip. Any HDF5 library reads it; a library of ours would bring 12 packages for this one use.
Bytes EncodeHdf5(const Image<float>& picture, const std::string& name);

}  // namespace airsim360::internal

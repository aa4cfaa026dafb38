// Builds without an HDF5 library.
#include "airsim360/base/error.h"
#include "airsim360/eval/files/hdf5_file.h"

namespace airsim360 {

NumberArray ReadHdf5(const std::filesystem::path& path, const std::string&) {
  throw InputError(path.string() + ": this build reads no HDF5 files; install libhdf5-dev and build again, or convert it to .npy");
}

}  // namespace airsim360

// Pictures of numbers and of labels.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace airsim360 {

struct NumberPicture {
  int width = 0, height = 0, channels = 1;
  std::vector<double> values;  ///< row by row, the channels of a pixel together
};
struct LabelPicture {
  int width = 0, height = 0;
  std::vector<uint32_t> ids;  ///< row by row
};

struct DepthFileOptions {
  double png_scale = 0.001;  ///< metres a unit of 16-bit PNGs
  std::string h5_key;        ///< dataset of HDF5 files; "" as ReadHdf5 chooses
};
/// .npy, .exr (of one channel, or with one named range, depth, Z or Y and no X), .h5/.hdf5, 16-bit gray .png. InputError naming the file, and the kinds that are known.
NumberPicture ReadDepthPicture(const std::filesystem::path& path, const DepthFileOptions& options);

/// .npy of integers; .png of gray, with a palette, or with ids in the alpha channel (omni360's). InputError naming the file.
LabelPicture ReadLabelPicture(const std::filesystem::path& path);
/// PNG whose pixels are id = R + 256 G + 65536 B, or .npy of integers.
LabelPicture ReadIdPicture(const std::filesystem::path& path);

/// Flow in pixels (dx, dy): .flo (Middlebury), .npy of (H, W, 2) or (2, H, W), .exr with channels dx and dy, 16-bit RGB .png (KITTI: (value -
/// 32768) / 64, blue = valid). Pixels without flow are NaN: where KITTI's are not valid, Middlebury's are beyond 1e9, and, with `visible`,
/// where an EXR's channel `occluded` is not 0.
NumberPicture ReadFlowPicture(const std::filesystem::path& path, bool visible);

}  // namespace airsim360

// Pictures of numbers and of labels, one file or whole folders, prediction beside truth.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
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
/// .npy, .exr (channel Y, else R, else the first), .h5/.hdf5, 16-bit gray .png. InputError naming the file, and the kinds that are known.
NumberPicture ReadDepthPicture(const std::filesystem::path& path, const DepthFileOptions& options);

/// .npy of integers, gray or palette .png. InputError naming the file.
LabelPicture ReadLabelPicture(const std::filesystem::path& path);
/// PNG whose pixels are id = R + 256 G + 65536 B, or .npy of integers.
LabelPicture ReadIdPicture(const std::filesystem::path& path);

/// Flow in pixels (dx, dy): .flo (Middlebury), .npy of (H, W, 2) or (2, H, W), .exr with channels dx and dy, 16-bit RGB .png (KITTI: (value -
/// 32768) / 64, blue = valid). Pixels without flow are NaN: where KITTI's are not valid, Middlebury's are beyond 1e9, and, with `visible`,
/// where an EXR's channel `occluded` is not 0.
NumberPicture ReadFlowPicture(const std::filesystem::path& path, bool visible);

struct FilePair {
  std::string name;  ///< what both have in common
  std::filesystem::path prediction, truth;
};
struct FilePairs {
  std::vector<FilePair> pairs;  ///< sorted by name
  std::vector<std::string> notes;
};
/// Two files, or the files of two folders that have the same path below them up to the ending (one of `endings`, lower case with the dot). A
/// folder that is a dataset of ours stands for its folder `product`. InputError where a truth has no prediction, naming the first and
/// their number; predictions without truths are left out and noted.
FilePairs PairFiles(const std::filesystem::path& prediction, const std::filesystem::path& truth, const std::vector<std::string>& endings,
                    const std::string& product);

}  // namespace airsim360

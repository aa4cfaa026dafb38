// A dataset in the formats that other tools read. The table of formats is in export.cc, one file a format beside it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace airsim360 {

struct ExportOptions {
  int64_t shard_bytes = 1'000'000'000;  ///< of a tar file of `webdataset`, at most (one sample may be more)
  int64_t points = 200'000;             ///< of `colmap` and `nerfstudio`: 3-D points of the whole dataset, at most
};

/// What an export did.
struct ExportResult {
  int64_t frames = 0, files = 0, bytes = 0;
  std::string notes = "{}";  ///< JSON object of the format, such as the unmapped share of pixels
};

/// One row of the table of formats.
struct ExportFormatInfo {
  const char* name;
  const char* help;  ///< one line
};
std::span<const ExportFormatInfo> ExportFormats();

/// Writes `dataset` in the format `format` to the folder `out`, which must not exist or be empty. The bytes depend on the
/// dataset and the options alone, not on threads. The dataset is read frame by frame and not changed. Nothing stands at
/// `out` before all of it does. InputError for an unknown format (naming the nearest), a dataset that is not finished, has
/// not what the format needs (naming the flag that collects it) or is damaged; RuntimeError if writing fails.
ExportResult ExportDataset(const std::filesystem::path& dataset, const std::string& format, const std::filesystem::path& out,
                           const ExportOptions& options = {});

}  // namespace airsim360

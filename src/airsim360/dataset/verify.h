// Checking a dataset against its own checksums and labels.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace airsim360 {

/// One thing found.
struct Finding {
  enum class Kind { kDamaged, kMissing, kExtra, kLabels } kind;
  std::string path;  ///< relative to the dataset
  std::string detail;
};
inline constexpr const char* kFindingNames[] = {"damaged", "missing", "extra", "labels"};

struct VerifyResult {
  int64_t files = 0, frames = 0;  ///< checked
  bool complete = false;          ///< false: the collection was interrupted and can be run again
  std::vector<Finding> findings;  ///< by path
  /// Number of findings that make the dataset unfit: all but extra files.
  int64_t Damages() const;
};

/// Path -> SHA-256.
using Checksums = std::map<std::string, std::string>;
/// What SHA256SUMS of a finished dataset names; a line that cannot be read is a finding.
Checksums ReadChecksums(const std::filesystem::path& folder, std::vector<Finding>& findings);

/// Re-hashes every file, compares the entity ids of the pictures with panoptic.json both ways, and lists
/// files that do not belong. InputError if `folder` is not a dataset.
VerifyResult VerifyDataset(const std::filesystem::path& folder);

}  // namespace airsim360

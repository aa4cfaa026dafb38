// Reading single entries of a zip file.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "airsim360/base/file.h"

namespace airsim360::internal {

/// An open zip file. Not for several threads at once.
class ZipArchive {
 public:
  /// InputError if it cannot be opened.
  explicit ZipArchive(const std::filesystem::path& path);
  /// The entry, its name compared without case; nullopt if there is none. InputError if damaged or over 1
  /// GiB.
  std::optional<Bytes> Read(const std::string& entry) const;

 private:
  std::string name_;
  std::shared_ptr<void> zip_;
};

}  // namespace airsim360::internal

// A dataset's folder while it is written: who may write, what is already there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace airsim360 {

inline constexpr char kMetaName[] = "meta.json";
inline constexpr char kChecksumsName[] = "SHA256SUMS";

/// Holds the folder for one writer and the processes that it starts; nothing is left behind when all have ended in
/// any way.
class FolderLock {
 public:
  /// RuntimeError if others hold it for longer than a killed run takes to end (2 s).
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int fd_;
};

/// Creates the folder if needed. InputError if it holds something that is not this dataset (naming the first
/// difference of the parameters); a finished dataset that has lost its meta.json is known by SHA256SUMS. `meta` is the meta.json wanted; `what` and `name` are for what is described in
/// another file of that form.
void CheckFolder(const std::filesystem::path& folder, const std::string& meta, const std::string& what = "dataset",
                 const char* name = kMetaName);

/// Removes files that an interrupted run left under temporary names.
void RemoveTemporaryFiles(const std::filesystem::path& folder);

/// Relative paths of all files below a folder, '/' separated, sorted.
std::vector<std::string> ListFiles(const std::filesystem::path& folder);

}  // namespace airsim360

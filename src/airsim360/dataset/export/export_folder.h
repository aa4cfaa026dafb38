// Where an export is written: a temporary folder that becomes the target in one rename.
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "airsim360/base/file.h"
#include "airsim360/dataset/folder.h"

namespace airsim360 {

/// Different files may be written from several threads.
class ExportFolder {
 public:
  /// InputError if `target` exists and is not an empty folder; RuntimeError if nothing can be written beside it, or another
  /// process exports to it.
  explicit ExportFolder(std::filesystem::path target);
  /// Removes what was written unless it was committed.
  ~ExportFolder();
  ExportFolder(const ExportFolder&) = delete;
  ExportFolder& operator=(const ExportFolder&) = delete;

  /// A new file of that relative path; folders are made. RuntimeError naming path and reason (disk full).
  void Write(const std::string& path, std::span<const std::byte> bytes);
  void Write(const std::string& path, std::string_view text) { Write(path, AsBytes(text)); }
  /// The place of a file of the export while it is written; its folder exists.
  std::filesystem::path Place(const std::string& path);

  /// Makes everything durable and gives it its name.
  void Commit();

 private:
  std::filesystem::path target_, temporary_;
  std::unique_ptr<FolderLock> lock_;
  bool committed_ = false;
};

/// A file of an export that grows; RuntimeError where that fails.
class GrowingFile {
 public:
  GrowingFile(ExportFolder& folder, const std::string& path);
  void Append(std::span<const std::byte> bytes);
  void Append(std::string_view text) { Append(AsBytes(text)); }
  uint64_t size() const { return size_; }
  void Close();

 private:
  std::filesystem::path path_;
  std::ofstream file_;
  uint64_t size_ = 0;
};

/// A JSON file of lists that are told element by element, interleaved: {"a": [...], "b": [...]}. Lists wait in scratch files.
class JsonLists {
 public:
  JsonLists(ExportFolder& folder, std::string path, std::vector<std::string> lists);
  /// `element` is JSON text.
  void Add(const std::string& list, std::string_view element);
  /// Writes the file; `last` holds further keys with their JSON text.
  void Finish(const std::vector<std::pair<std::string, std::string>>& last = {});

 private:
  struct List {
    std::string name;
    std::unique_ptr<GrowingFile> file;
    std::filesystem::path scratch;
  };
  ExportFolder& folder_;
  std::string path_;
  std::vector<List> lists_;
};

}  // namespace airsim360

// What the page of `airsim360 view` reads of a finished dataset besides its own files: one compact index, where every entity is
// seen, who is in a picture.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360 {

/// All functions may be called from several threads.
class ViewedDataset {
 public:
  /// A dataset, or the folder of a flight, whose `frames` are one. InputError for a folder that holds none or an
  /// unfinished one.
  explicit ViewedDataset(const std::filesystem::path& folder);
  ~ViewedDataset();
  ViewedDataset(const ViewedDataset&) = delete;
  ViewedDataset& operator=(const ViewedDataset&) = delete;

  const std::filesystem::path& folder() const;
  std::string name() const;  ///< of the folder

  /// Paths of what is made here and is not on the disk: "index.json", "appearances.json", "people/STEM.json".
  std::vector<std::string> MadeFiles() const;
  /// One of them; nullopt for a path that is none.
  /// index.json: views, products with their extensions, categories, and by column stem, seconds, pose and median range of all frames.
  /// appearances.json: {"entity id": [frame, pixels, frame, pixels, …]}, frames counted from 0.
  /// people/STEM.json (STEM with the suffix of a view): [person], without the fields that no picture shows.
  std::optional<std::string> Made(std::string_view path) const;
  /// Files of the dataset that the page reads, relative: its pictures and tables.
  std::vector<std::string> Files() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360

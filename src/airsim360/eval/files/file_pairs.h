// Files of a prediction and of the truth, matched by their names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace airsim360 {

struct FilePair {
  std::string name;  ///< what both have in common
  std::filesystem::path prediction, truth;
};
struct FilePairs {
  std::vector<FilePair> pairs;  ///< sorted by name
  std::vector<std::string> notes;
};
/// Two files, or the files of two folders that have the same path below them up to the ending (one of `endings`, lower case with the dot). A
/// folder that is a dataset of ours stands for its folder `product`. InputError where a truth has no prediction, naming the first and their number, and for a
/// dataset without the product; predictions without truths are left out and noted.
FilePairs PairFiles(const std::filesystem::path& prediction, const std::filesystem::path& truth, const std::vector<std::string>& endings,
                    const std::string& product);

/// InputError naming the first file below `parts` (folders or files of the dataset) that SHA256SUMS lists and that is missing or another one now.
/// Looks at nothing where the folder is no finished dataset of ours. Reads all of those files: once a command is enough.
void CheckDatasetFiles(const std::filesystem::path& dataset, const std::vector<std::string>& parts);

}  // namespace airsim360

#include "airsim360/eval/files/file_pairs.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

// Files by their path below the folder, without the ending.
std::map<std::string, fs::path> FilesBelow(const fs::path& folder, const std::vector<std::string>& endings) {
  std::map<std::string, fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || std::find(endings.begin(), endings.end(), internal::LowerEnding(entry.path())) == endings.end())
      continue;
    const std::string name = entry.path().lexically_relative(folder).replace_extension().string();
    const auto [at, fresh] = files.emplace(name, entry.path());
    if (!fresh)
      throw InputError(folder.string() + ": two files are named " + name + ": " + at->second.filename().string() + " and " +
                       entry.path().filename().string());
  }
  return files;
}

fs::path ProductFolder(const fs::path& path, const std::string& product) {
  return fs::exists(path / "meta.json") && fs::is_directory(path / product) ? path / product : path;
}

}  // namespace

std::string internal::LowerEnding(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

FilePairs PairFiles(const fs::path& prediction, const fs::path& truth, const std::vector<std::string>& endings,
                    const std::string& product) {
  for (const fs::path& path : {prediction, truth}) {
    if (!fs::exists(path)) throw InputError(path.string() + ": does not exist");
  }
  if (fs::is_directory(prediction) != fs::is_directory(truth))
    throw InputError((fs::is_directory(prediction) ? truth : prediction).string() + " is a file, " +
                     (fs::is_directory(prediction) ? prediction : truth).string() + " a folder: give two of a kind");
  if (!fs::is_directory(truth)) return {{{truth.stem().string(), prediction, truth}}, {}};
  const auto truths = FilesBelow(ProductFolder(truth, product), endings);
  auto predictions = FilesBelow(ProductFolder(prediction, product), endings);
  if (truths.empty()) {
    std::string list;
    for (const std::string& ending : endings) list += (list.empty() ? "" : ", ") + ending;
    throw InputError(truth.string() + ": has no files " + list);
  }
  FilePairs result;
  std::vector<std::string> missing;
  for (const auto& [name, path] : truths) {
    const auto found = predictions.find(name);
    if (found == predictions.end()) {
      missing.push_back(name);
      continue;
    }
    result.pairs.push_back({name, found->second, path});
    predictions.erase(found);
  }
  if (!missing.empty())
    throw InputError(
        prediction.string() + ": has no prediction for " + std::to_string(missing.size()) + " of " + std::to_string(truths.size()) +
        " pictures, '" + missing[0] + "' first" +
        (predictions.empty() ? "" : "; it has '" + predictions.begin()->first + "', which the truth has not: are files named otherwise?"));
  if (!predictions.empty())
    result.notes.push_back(std::to_string(predictions.size()) + " predictions have no truth and are left out, '" +
                           predictions.begin()->first + "' first");
  return result;
}

}  // namespace airsim360

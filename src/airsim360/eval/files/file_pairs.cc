#include "airsim360/eval/files/file_pairs.h"

#include <algorithm>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/file_name.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/parallel.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

// Files by their path below the folder, without the ending.
std::map<std::string, fs::path> FilesBelow(const fs::path& folder, const std::vector<std::string>& endings) {
  std::map<std::string, fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || std::find(endings.begin(), endings.end(), LowerCaseExtension(entry.path())) == endings.end()) continue;
    const std::string name = entry.path().lexically_relative(folder).replace_extension().string();
    const auto [at, fresh] = files.emplace(name, entry.path());
    if (!fresh)
      throw InputError(folder.string() + ": two files are named " + name + ": " + at->second.filename().string() + " and " +
                       entry.path().filename().string());
  }
  return files;
}

fs::path ProductFolder(const fs::path& path, const std::string& product) {
  return fs::exists(path / "meta.json") && !product.empty() && fs::is_directory(path / product) ? path / product : path;
}

// A dataset of ours without the product says so, instead of offering whatever pictures it has.
void CheckProduct(const fs::path& path, const std::string& product) {
  if (!fs::exists(path / "meta.json") || !fs::exists(path / "frames.jsonl") || product.empty() || fs::is_directory(path / product)) return;
  std::string others;
  for (const auto& entry : fs::directory_iterator(path)) {
    if (entry.is_directory()) others += (others.empty() ? "" : ", ") + entry.path().filename().string();
  }
  throw InputError(path.string() + ": the dataset has no '" + product + "'" + (others.empty() ? "" : "; it has " + others) +
                   (product == "flow" ? " (collect --products flow)" : ""));
}

std::string Count(size_t count, const std::string& one, const std::string& many) {
  return count == 1 ? "1 " + one : std::to_string(count) + " " + many;
}

}  // namespace

void CheckDatasetFiles(const fs::path& dataset, const std::vector<std::string>& parts) {
  constexpr uint64_t kMostSumBytes = uint64_t{1} << 30;
  constexpr size_t kHexDigits = 64;
  const fs::path sums = dataset / "SHA256SUMS";
  if (!fs::exists(dataset / "meta.json") || !fs::is_regular_file(sums)) return;
  std::vector<std::pair<std::string, std::string>> files;
  const std::string text = ReadTextFile(sums, kMostSumBytes);
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    if (line.size() < kHexDigits + 3) continue;
    const std::string path = line.substr(kHexDigits + 2);
    if (std::any_of(parts.begin(), parts.end(), [&](const std::string& part) { return path == part || path.starts_with(part + "/"); }))
      files.emplace_back(path, line.substr(0, kHexDigits));
  }
  std::vector<std::string> faults(files.size());
  ParallelFor(static_cast<int64_t>(files.size()), [&](int64_t i) {
    const auto& [path, sum] = files[static_cast<size_t>(i)];
    if (!fs::is_regular_file(dataset / path))
      faults[static_cast<size_t>(i)] = "is missing";
    else if (Sha256HexOfFile(dataset / path) != sum)
      faults[static_cast<size_t>(i)] = "was changed or exchanged";
  });
  for (size_t i = 0; i < files.size(); ++i) {
    if (!faults[i].empty())
      throw InputError((dataset / files[i].first).string() + ": " + faults[i] +
                       " since the dataset was made (its SHA256SUMS; `airsim360 verify " + dataset.string() +
                       "` lists all such files); to take what is there as the truth, name " +
                       (files[i].first == parts[0] ? "that file" : (dataset / parts[0]).string()) + " itself");
  }
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
  for (const fs::path& path : {prediction, truth}) CheckProduct(path, product);
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
    result.notes.push_back(
        Count(predictions.size(), "prediction has no truth and is left out, '", "predictions have no truth and are left out, '") +
        predictions.begin()->first + (predictions.size() == 1 ? "'" : "' first"));
  return result;
}

}  // namespace airsim360

#include "airsim360/dataset/verify.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/folder.h"
#include "airsim360/dataset/index.h"
#include "airsim360/dataset/label_check.h"

namespace airsim360 {

namespace fs = std::filesystem;
using ParsedJson = nlohmann::json;

namespace {

Checksums ChecksumsOfJournal(const fs::path& folder) {
  Checksums checksums;
  if (!fs::exists(folder / kIndexName)) return checksums;
  const DatasetIndex index(folder, DatasetIndex::Mode::kRead);
  for (int64_t frame : index.Frames()) {
    for (const FileRecord& file : index.Files(frame)) checksums[file.path] = file.sha256;
  }
  return checksums;
}

// Hashes every file on the list.
void CheckFiles(const fs::path& folder, const Checksums& checksums, std::vector<Finding>& findings) {
  const std::vector<std::pair<std::string, std::string>> list(checksums.begin(), checksums.end());
  std::vector<std::vector<Finding>> found(list.size());
  ParallelFor(static_cast<int64_t>(list.size()), [&](int64_t i) {
    const auto& [path, sha256] = list[static_cast<size_t>(i)];
    auto& here = found[static_cast<size_t>(i)];
    if (!fs::is_regular_file(folder / path)) {
      here.push_back({Finding::Kind::kMissing, path, "no such file"});
    } else if (const std::string now = Sha256HexOfFile(folder / path); now != sha256) {
      here.push_back({Finding::Kind::kDamaged, path, "SHA-256 is " + now + ", not " + sha256});
    }
  });
  for (const auto& here : found) findings.insert(findings.end(), here.begin(), here.end());
}

// frames.jsonl and SHA256SUMS must name the same files with the same hashes.
int64_t CheckFrameLines(const fs::path& folder, const Checksums& checksums, std::vector<Finding>& findings) {
  std::set<std::string> known;
  for (const auto& [path, sha256] : checksums) known.insert(sha256);
  const std::string text = ReadTextFile(folder / "frames.jsonl");
  int64_t frames = 0;
  for (size_t begin = 0; begin < text.size(); ++frames) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string place = "line " + std::to_string(frames + 1);
    const ParsedJson line =
        ParsedJson::parse(text.begin() + static_cast<ptrdiff_t>(begin), text.begin() + static_cast<ptrdiff_t>(end), nullptr, false);
    begin = end + 1;
    if (!line.is_object() || !line.contains("sha256") || !line["sha256"].is_object()) {
      findings.push_back({Finding::Kind::kDamaged, "frames.jsonl", place + " is not a frame"});
      continue;
    }
    for (const auto& [key, sha256] : line["sha256"].items()) {
      if (!sha256.is_string() || !known.contains(sha256.get<std::string>())) {
        findings.push_back({Finding::Kind::kDamaged, "frames.jsonl", place + ": the SHA-256 of " + key + " is of no file"});
      }
    }
  }
  return frames;
}

void FindExtraFiles(const fs::path& folder, const Checksums& checksums, bool complete, std::vector<Finding>& findings) {
  static const std::set<std::string> kOwn = {kMetaName, kIndexName, kChecksumsName, "index.sqlite-journal"};
  for (const std::string& file : ListFiles(folder)) {
    if (checksums.contains(file) || (complete ? file == kChecksumsName : kOwn.contains(file))) continue;
    findings.push_back({Finding::Kind::kExtra, file, "not part of the dataset"});
  }
}

}  // namespace

Checksums ReadChecksums(const fs::path& folder, std::vector<Finding>& findings) {
  Checksums checksums;
  const std::string text = ReadTextFile(folder / kChecksumsName);
  size_t begin = 0;
  while (begin < text.size()) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (line.size() > 66 && line.substr(64, 2) == "  ") {
      checksums[line.substr(66)] = line.substr(0, 64);
    } else {
      findings.push_back({Finding::Kind::kDamaged, kChecksumsName, "unreadable line '" + line.substr(0, 80) + "'"});
    }
  }
  return checksums;
}

int64_t VerifyResult::Damages() const {
  return std::count_if(findings.begin(), findings.end(), [](const Finding& f) { return f.kind != Finding::Kind::kExtra; });
}

VerifyResult VerifyDataset(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError("'" + folder.string() + "' is not a folder");
  VerifyResult result;
  result.complete = fs::exists(folder / kChecksumsName);
  if (!result.complete && !fs::exists(folder / kMetaName)) {
    throw InputError("'" + folder.string() + "' is not a dataset: it has no " + kMetaName);
  }
  const Checksums checksums = result.complete ? ReadChecksums(folder, result.findings) : ChecksumsOfJournal(folder);
  result.files = static_cast<int64_t>(checksums.size());
  CheckFiles(folder, checksums, result.findings);
  if (result.complete) {
    if (fs::exists(folder / "frames.jsonl")) result.frames = CheckFrameLines(folder, checksums, result.findings);
    if (fs::exists(folder / "panoptic.json")) internal::CheckLabels(folder, result.findings);
  } else {
    result.findings.push_back({Finding::Kind::kMissing, kChecksumsName, "the collection was interrupted: run it again to finish it"});
  }
  FindExtraFiles(folder, checksums, result.complete, result.findings);
  std::stable_sort(result.findings.begin(), result.findings.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return result;
}

}  // namespace airsim360

// Taking frames out of a finished dataset.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"
#include "airsim360/dataset/dedupe/dedupe.h"
#include "airsim360/dataset/folder.h"
#include "airsim360/dataset/index.h"
#include "airsim360/dataset/sqlite.h"

namespace airsim360::internal {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr uint64_t kMostText = uint64_t{16} << 30;

// Lines of a JSON-lines file whose object is not of a dropped frame.
std::string KeptLines(const std::string& text, const std::set<int64_t>& dropped) {
  std::string kept;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    const Json line = Json::parse(text.begin() + static_cast<ptrdiff_t>(begin), text.begin() + static_cast<ptrdiff_t>(end));
    if (!dropped.contains(line.at("index").get<int64_t>())) kept.append(text, begin, end - begin);
    begin = end;
  }
  return kept;
}

// Elements of a list of panoptic.json, as this program writes it, that `keep` by their image id.
template <class Keep>
std::string KeptElements(const std::string& list, const std::string& key, const Keep& keep) {
  const std::string begin = "\n{\"" + key + "\":";
  std::string kept;
  for (size_t at = list.find(begin); at != std::string::npos;) {
    const size_t next = list.find(begin, at + 1);
    std::string element = list.substr(at, next == std::string::npos ? next : next - at);
    if (element.ends_with(",")) element.pop_back();
    if (keep(std::stoll(element.substr(begin.size())))) kept += (kept.empty() ? "" : ",") + element;
    at = next;
  }
  return kept;
}

std::string KeptPanoptic(const std::string& text, const std::string& path, const std::set<int64_t>& dropped) {
  const std::string images = "{\"images\":[", annotations = "],\n\"annotations\":[", categories = "],\n\"categories\":[";
  const size_t a = text.find(annotations), c = text.rfind(categories);
  if (!text.starts_with(images) || a == std::string::npos || c == std::string::npos)
    throw InputError(path + ": not as this program writes it");
  // One picture a frame: its id is the frame's index.
  const auto keep = [&](int64_t id) { return !dropped.contains(id); };
  return images + KeptElements(text.substr(images.size(), a - images.size()), "id", keep) + annotations +
         KeptElements(text.substr(a + annotations.size(), c - a - annotations.size()), "image_id", keep) + text.substr(c);
}

void ShrinkIndex(const fs::path& folder, const std::set<int64_t>& dropped) {
  const fs::path path = folder / kIndexName, temporary = path.string() + ".tmp";
  fs::copy_file(path, temporary, fs::copy_options::overwrite_existing);
  {
    Database database(temporary, Database::Mode::kWrite);
    database.Run("PRAGMA journal_mode=OFF");
    Transaction transaction(database);
    for (const char* table : {"frames", "files", "segments", "persons"}) {
      Statement statement(database, std::string("DELETE FROM ") + table + " WHERE frame=?");
      for (const int64_t frame : dropped) statement.Bind(0, frame).Run();
    }
    database.Run("DELETE FROM entities WHERE entity NOT IN (SELECT entity FROM segments)");
    database.Run("UPDATE entities SET first_frame=(SELECT MIN(frame) FROM segments WHERE segments.entity=entities.entity)");
    transaction.Commit();
    database.Run("VACUUM");
  }
  fs::rename(temporary, path);
}

std::string KeptEntities(const fs::path& folder) {
  Json kept = Json::object();
  const Json all = Json::parse(ReadTextFile(folder / "entities.json"));
  Database database(folder / kIndexName, Database::Mode::kRead);
  Statement rows(database, "SELECT entity, first_frame FROM entities ORDER BY entity");
  while (rows.Next()) {
    const std::string id = std::to_string(rows.Int(0));
    kept[id] = all.at(id);
    kept[id]["first_frame"] = rows.Int(1);
  }
  return kept.dump(0, ' ', false, Json::error_handler_t::replace) + "\n";
}

// What was dropped, for the card.
std::string CardSection(const DedupeResult& result) {
  std::map<std::string, int64_t> reasons;
  for (const DroppedFrame& frame : result.dropped) ++reasons[frame.reason];
  std::string text = "\n## Duplicates\n\n" + std::to_string(result.dropped.size()) + " of " +
                     std::to_string(result.dropped.size() + result.kept.size()) +
                     " frames were dropped (`dropped.csv` names each and its twin); the tables above count them too.\n\n";
  for (const auto& [reason, count] : reasons) text += "- " + reason + ": " + std::to_string(count) + "\n";
  text += "\n| parallax to the nearest frame kept before, rad | frames |\n|---|--:|\n";
  for (size_t i = 0; i < result.histogram.size(); ++i) {
    char label[32];
    const bool last = i == std::size(kParallaxBins);
    std::snprintf(label, sizeof label, last ? ">= %g" : "< %g", kParallaxBins[last ? i - 1 : i]);
    text += "| " + std::string(label) + " | " + std::to_string(result.histogram[i]) + " |\n";
  }
  return text;
}

std::string NewCard(const std::string& card, const DedupeResult& result) {
  std::string text = card.substr(0, card.find("\n## Duplicates\n"));
  const std::string row = "| frames | ";
  if (const size_t at = text.find(row); at != std::string::npos) {
    const size_t end = text.find(" |", at + row.size());
    text.replace(at + row.size(), end - at - row.size(), std::to_string(result.kept.size()));
  }
  return text + CardSection(result);
}

void WriteChecksums(const fs::path& folder, const std::map<std::string, std::string>& of_frames) {
  std::string text;
  for (const std::string& file : ListFiles(folder)) {
    if (file == kChecksumsName || file.ends_with(".tmp")) continue;
    const auto known = of_frames.find(file);
    text += (known != of_frames.end() ? known->second : Sha256HexOfFile(folder / file)) + "  " + file + "\n";
  }
  WriteFileAtomically(folder / kChecksumsName, text);
}

}  // namespace

void RemoveFrames(const fs::path& folder, const DedupeResult& result) {
  if (result.dropped.empty()) return;
  std::set<std::string> stems;
  for (const DroppedFrame& frame : result.dropped) stems.insert(frame.stem);
  std::set<int64_t> dropped;
  std::vector<std::string> files;
  std::map<std::string, std::string> sums;
  {
    const DatasetIndex index(folder, DatasetIndex::Mode::kRead);
    for (const int64_t frame : index.Frames()) {
      const bool drop = stems.contains(Stem(frame));
      if (drop) dropped.insert(frame);
      for (const FileRecord& file : index.Files(frame)) {
        if (drop) files.push_back(file.path);
        sums[file.path] = file.sha256;
      }
    }
  }
  // From here on the dataset is unfinished, until the checksums are there again.
  fs::remove(folder / kChecksumsName);
  ShrinkIndex(folder, dropped);
  WriteFileAtomically(folder / "frames.jsonl", KeptLines(ReadTextFile(folder / "frames.jsonl", kMostText), dropped));
  if (fs::exists(folder / "people.jsonl"))
    WriteFileAtomically(folder / "people.jsonl", KeptLines(ReadTextFile(folder / "people.jsonl", kMostText), dropped));
  const fs::path panoptic = folder / "panoptic.json";
  WriteFileAtomically(panoptic, KeptPanoptic(ReadTextFile(panoptic, kMostText), panoptic.string(), dropped));
  WriteFileAtomically(folder / "entities.json", KeptEntities(folder));
  WriteFileAtomically(folder / "README.md", NewCard(ReadTextFile(folder / "README.md"), result));
  for (const std::string& file : files) fs::remove(folder / file);
  WriteChecksums(folder, sums);
}

}  // namespace airsim360::internal

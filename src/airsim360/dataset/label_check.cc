#include "airsim360/dataset/label_check.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "airsim360/base/file.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/folder.h"
#include "airsim360/image/codecs.h"

namespace airsim360::internal {

namespace fs = std::filesystem;
using ParsedJson = nlohmann::json;

namespace {

// Ids of one picture and of one annotation, both ways, with their areas. Throws on malformed JSON.
std::string CompareLabels(const fs::path& file, const ParsedJson& annotation, bool allows_void) {
  std::map<int64_t, int64_t> in_picture, in_json;
  const Image<uint32_t> ids = DecodeIdPng(ReadFile(file), file.string());
  for (int y = 0; y < ids.height(); ++y) {
    for (int x = 0; x < ids.width();) {
      const int begin = x;
      const auto row = ids.row(y);
      while (x < ids.width() && row[x] == row[begin]) ++x;
      in_picture[row[begin]] += x - begin;
    }
  }
  for (const ParsedJson& segment : annotation.at("segments_info")) {
    in_json[segment.at("id").get<int64_t>()] = segment.at("area").get<int64_t>();
  }
  if (in_picture.erase(0) > 0 && !allows_void) return "pixels without an entity";
  for (const auto& [id, area] : in_picture) {
    if (!in_json.contains(id)) return "id " + std::to_string(id) + " is in the picture but not in panoptic.json";
    if (in_json[id] != area) {
      return "id " + std::to_string(id) + " covers " + std::to_string(area) + " pixels, panoptic.json says " + std::to_string(in_json[id]);
    }
  }
  for (const auto& [id, area] : in_json) {
    if (!in_picture.contains(id)) return "id " + std::to_string(id) + " is in panoptic.json but not in the picture";
  }
  return {};
}

// Ends of the names of pictures that have pixels without a ray.
std::vector<std::string> SuffixesWithVoid(const fs::path& folder) {
  const ParsedJson meta =
      fs::exists(folder / kMetaName) ? ParsedJson::parse(ReadTextFile(folder / kMetaName), nullptr, false) : ParsedJson();
  std::vector<std::string> suffixes;
  const ParsedJson::json_pointer projection("/parameters/projection"), cameras("/parameters/cameras");
  if (!meta.is_object()) return suffixes;
  if (meta.contains(cameras) && meta[cameras].is_array()) {
    for (const ParsedJson& camera : meta[cameras]) {
      if (!camera.is_object() || !camera.value("name", ParsedJson()).is_string()) continue;
      if (const ParsedJson kind = camera.value("projection", ParsedJson()); kind == "fisheye" || kind == "lens")
        suffixes.push_back("_" + camera["name"].get<std::string>() + ".png");
    }
  } else if (meta.contains(projection) && meta[projection] == "fisheye") {
    suffixes.push_back(".png");
  }
  return suffixes;
}

}  // namespace

void CheckLabels(const fs::path& folder, std::vector<Finding>& findings) {
  const ParsedJson panoptic = ParsedJson::parse(ReadTextFile(folder / "panoptic.json", uint64_t{8} << 30), nullptr, false);
  if (!panoptic.is_object() || !panoptic.contains("annotations") || !panoptic["annotations"].is_array()) {
    findings.push_back({Finding::Kind::kLabels, "panoptic.json", "not COCO panoptic JSON"});
    return;
  }
  const std::vector<std::string> with_void = SuffixesWithVoid(folder);
  const ParsedJson& annotations = panoptic["annotations"];
  std::vector<std::vector<Finding>> found(annotations.size());
  ParallelFor(static_cast<int64_t>(annotations.size()), [&](int64_t i) {
    const ParsedJson& annotation = annotations[static_cast<size_t>(i)];
    std::string path = "panoptic.json", problem;
    try {
      path = "entity/" + annotation.at("file_name").get<std::string>();
      const bool allows_void = std::ranges::any_of(with_void, [&](const std::string& end) { return path.ends_with(end); });
      if (fs::exists(folder / path)) problem = CompareLabels(folder / path, annotation, allows_void);
    } catch (const std::exception& error) {
      problem = error.what();
    }
    if (!problem.empty()) found[static_cast<size_t>(i)].push_back({Finding::Kind::kLabels, path, problem});
  });
  for (const auto& here : found) findings.insert(findings.end(), here.begin(), here.end());
}

}  // namespace airsim360::internal

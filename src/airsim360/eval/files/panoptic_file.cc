#include "airsim360/eval/files/panoptic_file.h"

#include <set>

#include "airsim360/base/error.h"
#include "airsim360/eval/files/json_cursor.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using internal::JsonCursor;
using internal::JsonFile;
using internal::OwnId;

std::vector<PanopticCategory> PanopticCategories(const JsonCursor& list, bool things_known) {
  std::vector<PanopticCategory> categories;
  std::set<int64_t> ids;
  for (size_t i = 0; i < list.size(); ++i) {
    const JsonCursor one = list[i];
    categories.push_back(
        {OwnId(one, ids), one.Has("name") ? one["name"].Text() : "", things_known ? one.FlagOr("isthing", false) : one["isthing"].Flag()});
  }
  return categories;
}

std::map<std::string, std::string> Sequences(const JsonCursor& top) {
  std::map<std::string, std::string> sequences;
  if (!top.Has("images")) return sequences;
  const JsonCursor list = top["images"];
  for (size_t i = 0; i < list.size(); ++i) {
    const char* field = list[i].Has("video_id") ? "video_id" : "sequence";
    if (list[i].Has(field)) sequences[list[i]["id"].IdText()] = list[i][field].IdText();
  }
  return sequences;
}

std::vector<PanopticSegment> Segments(const JsonCursor& list, const std::map<int64_t, size_t>& categories) {
  std::vector<PanopticSegment> segments;
  for (size_t i = 0; i < list.size(); ++i) {
    const JsonCursor one = list[i];
    const int64_t id = one["id"].Integer(), category = one["category_id"].Integer();
    if (id < 1 || id > 0xffffffff) one.Fail(std::to_string(id) + " is no id of a segment");
    const auto found = categories.find(category);
    if (found == categories.end()) one.Fail("category_id " + std::to_string(category) + " is not among the categories");
    segments.push_back({static_cast<uint32_t>(id), found->second, one.FlagOr("iscrowd", false)});
  }
  return segments;
}

std::string FileName(const JsonCursor& value) {
  const fs::path path = value.is_number() ? value.IdText() : value.Text();
  for (const fs::path& part : path) {
    if (part == "..") value.Fail("'" + path.string() + "' leads out of the folder");
  }
  if (path.empty() || path.is_absolute()) value.Fail("'" + path.string() + "' is no name of a file in the folder");
  return path.string();
}

PanopticFile Read(const JsonCursor& top, const std::vector<PanopticCategory>* known) {
  PanopticFile file;
  if (!known || top.Has("categories")) file.own_categories = PanopticCategories(top["categories"], known != nullptr);
  file.categories = known ? *known : file.own_categories;
  std::map<int64_t, size_t> categories;
  for (size_t c = 0; c < file.categories.size(); ++c) categories[file.categories[c].id] = c;
  const auto sequences = Sequences(top);
  const JsonCursor list = top["annotations"];
  std::set<std::string> images;
  const auto add = [&](const JsonCursor& one, const std::string& video) {
    const std::string folder = video.empty() ? "" : video + "/", image = folder + one["image_id"].IdText();
    PanopticFrame frame{image, folder + FileName(one["file_name"]), video, Segments(one["segments_info"], categories)};
    if (!images.insert(image).second) one.Fail("image_id " + image + " occurs twice");
    if (const auto sequence = sequences.find(image); sequence != sequences.end()) frame.sequence = sequence->second;
    file.frames.push_back(std::move(frame));
  };
  for (size_t i = 0; i < list.size(); ++i) {
    const JsonCursor one = list[i];
    if (!one.Has("annotations")) {
      add(one, "");
      continue;
    }
    const JsonCursor frames = one["annotations"];
    const std::string video = FileName(one["video_id"]);
    for (size_t f = 0; f < frames.size(); ++f) add(frames[f], video);
  }
  return file;
}

}  // namespace

PanopticFile ReadPanopticFile(const fs::path& path, const std::vector<PanopticCategory>* known) {
  return Read(JsonFile::Read(path).top(), known);
}

PanopticFile ParsePanopticFile(std::string_view text, const std::string& name, const std::vector<PanopticCategory>* known) {
  return Read(JsonFile::Parse(text, name).top(), known);
}

fs::path PanopticFolder(const fs::path& json) {
  const fs::path own = fs::path(json).replace_extension(), beside = json.parent_path();
  if (fs::is_directory(own)) return own;
  for (const char* name : {"entity", "panomasksRGB"}) {
    if (fs::is_directory(beside / name)) return beside / name;
  }
  return beside;
}

}  // namespace airsim360

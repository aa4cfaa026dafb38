#include "airsim360/eval/files/layout_file.h"

#include <algorithm>
#include <charconv>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/file_name.h"
#include "airsim360/eval/files/json_cursor.h"

namespace airsim360 {
namespace {

constexpr uint64_t kMostLayoutBytes = 1 << 20;
constexpr size_t kMostCorners = 2000;

std::string_view NextWord(std::string_view& line) {
  const size_t begin = std::min(line.find_first_not_of(" \t\r"), line.size()),
               end = std::min(line.find_first_of(" \t\r", begin), line.size());
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

std::vector<Vec2d> CornersOfLines(std::string_view text, const std::string& name) {
  std::vector<Vec2d> corners;
  int number = 0;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    at = end + 1;
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    double values[2];
    for (double& value : values) {
      const std::string_view word = NextWord(line);
      const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || stop != word.data() + word.size() || !(std::abs(value) < 1e6))
        throw InputError(name + ":" + std::to_string(number) + ": '" + std::string(word) +
                         "' is no coordinate; a line is \"x y\" in pixels");
    }
    corners.push_back({values[0], values[1]});
  }
  return corners;
}

}  // namespace

RoomLayout ParseLayoutFile(std::string_view text, const std::string& name, bool json, int width, int height) {
  std::vector<Vec2d> corners;
  if (json) {
    const internal::JsonFile file = internal::JsonFile::Parse(text, name);
    const internal::JsonCursor list = file.top()["uv"];
    for (size_t i = 0; i < list.size(); ++i) {
      const std::vector<double> uv = list[i].Numbers(2);
      corners.push_back({uv[0] * width, uv[1] * height});
    }
  } else {
    corners = CornersOfLines(text, name);
  }
  if (corners.size() % 2 != 0 || corners.size() > kMostCorners)
    throw InputError(name + ": " + std::to_string(corners.size()) + " corners; they come in pairs of a ceiling and a floor corner");
  RoomLayout layout;
  for (size_t i = 0; i < corners.size(); i += 2) {
    layout.ceiling.push_back(corners[i]);
    layout.floor.push_back(corners[i + 1]);
  }
  return layout;
}

RoomLayout ReadLayoutFile(const std::filesystem::path& path, int width, int height) {
  return ParseLayoutFile(ReadTextFile(path, kMostLayoutBytes), path.string(), LowerCaseExtension(path) == ".json", width, height);
}

}  // namespace airsim360

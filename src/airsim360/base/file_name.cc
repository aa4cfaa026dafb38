#include "airsim360/base/file_name.h"

#include <algorithm>
#include <cctype>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr size_t kLongestName = 200;

bool IsControl(char c) { return static_cast<unsigned char>(c) < 32 || c == 127; }

// What is wrong with a name; empty if nothing is.
std::string Problem(std::string_view name) {
  if (name.empty()) return "an empty name";
  if (name.size() > kLongestName) {
    return std::to_string(name.size()) + " bytes are more than " + std::to_string(kLongestName);
  }
  if (name.find('/') != std::string_view::npos) return "holds a '/'";
  if (std::ranges::any_of(name, IsControl)) return "holds a control character";
  return name.front() == '.' ? "begins with a dot" : "";
}

}  // namespace

void CheckFileName(std::string_view what, std::string_view name) {
  const std::string problem = Problem(name);
  if (problem.empty()) return;
  std::string shown(name.substr(0, kLongestName));
  std::ranges::replace_if(shown, IsControl, '?');
  throw InputError(std::string(what) + ": '" + shown + "' " + problem + ": it becomes the name of a file");
}

std::string LowerCaseExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace airsim360

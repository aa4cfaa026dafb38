#include "airsim360/assets/imported.h"

#include <strings.h>

#include <utility>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/printable.h"

namespace airsim360::internal {
namespace fs = std::filesystem;
namespace {

bool StaysInside(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  const fs::path root = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error);
  const fs::path target = fs::weakly_canonical(file, error);
  const fs::path relative = target.lexically_relative(root);
  return !error && !relative.empty() && *relative.begin() != "..";
}

// `folder`/`relative`; where there is no such file, the only one whose name differs in case alone: models are made on
// systems that do not tell case apart.
fs::path FileBeside(const fs::path& folder, const fs::path& relative) {
  std::error_code error;
  fs::path found = folder;
  for (const fs::path& step : relative) {
    if (fs::exists(found / step, error)) {
      found /= step;
      continue;
    }
    std::vector<fs::path> alike;
    for (const auto& entry : fs::directory_iterator(found.empty() ? fs::path(".") : found, error)) {
      if (::strcasecmp(entry.path().filename().c_str(), step.c_str()) == 0) alike.push_back(entry.path());
    }
    if (alike.size() != 1) return folder / relative;
    found = alike.front();
  }
  return found;
}

}  // namespace

void Warnings::Add(std::string text) {
  constexpr size_t kMost = 20;
  if (list_.size() > kMost || !seen_.insert(text).second) return;
  list_.push_back(list_.size() == kMost ? "further warnings are left out" : std::move(text));
}

std::vector<std::string> Warnings::Take() {
  seen_.clear();
  return std::exchange(list_, {});
}

std::string CleanName(std::string_view raw) {
  constexpr size_t kMaxLength = 120;
  std::string clean;
  while (!raw.empty() && clean.size() < kMaxLength) {
    const size_t length = Utf8Length(raw);
    const auto c = static_cast<unsigned char>(raw[0]);
    if (length == 0) {
      clean += {static_cast<char>(0xc0 | (c >> 6)), static_cast<char>(0x80 | (c & 0x3f))};
    } else if (length > 1) {
      clean += raw.substr(0, length);
    } else {
      clean += c < 0x20 || c == 0x7f ? ' ' : raw[0];
    }
    raw.remove_prefix(length == 0 ? 1 : length);
  }
  const size_t first = clean.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return clean.substr(first, clean.find_last_not_of(' ') - first + 1);
}

std::string Quoted(std::string_view raw) { return std::string("'").append(CleanName(raw)).append("'"); }

ResourceLoader FolderLoader(const std::string& model_name, const fs::path& folder) {
  return [=](const std::string& name) -> std::optional<Bytes> {
    // The name itself must be relative and plain.
    const auto refuse = [&](const char* why) { throw InputError(model_name + ": refers to " + Quoted(name) + ": " + why); };
    if (name.empty()) refuse("an empty file name");
    if (name.find('\0') != std::string::npos) refuse("a file name with a zero byte");
    if (name.find("://") != std::string::npos) refuse("only files beside the model are read, no addresses");
    if (name.front() == '/' || name.front() == '\\' || (name.size() > 1 && name[1] == ':')) {
      refuse("an absolute path; files must be in the model's folder");
    }
    const fs::path relative(name);
    for (const fs::path& step : relative) {
      if (step == "..") refuse(*relative.lexically_normal().begin() == ".." ? "leaves the model's folder" : "write it without '..'");
    }

    // So must the file that it really is.
    const fs::path file = FileBeside(folder, relative);
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return std::nullopt;
    if (!StaysInside(folder, file)) refuse("leads out of the model's folder by a link");
    return ReadFile(file);
  };
}

}  // namespace airsim360::internal

#include "airsim360/view/folder_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <charconv>

namespace airsim360 {
namespace {

constexpr size_t kLongestPath = 512;

int OpenStep(int folder, const std::string& name, int flags) {
  const int next = ::openat(folder, name.c_str(), flags | O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  ::close(folder);
  return next;
}

bool IsRegular(int file) {
  struct stat status {};
  return ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
}

}  // namespace

std::string PercentDecoded(std::string_view text) {
  std::string decoded;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    unsigned byte = 0;
    const char* begin = text.data() + i + 1;
    if (i + 2 >= text.size() || std::from_chars(begin, begin + 2, byte, 16).ptr != begin + 2) return "";
    decoded += static_cast<char>(byte);
    i += 2;
  }
  return decoded;
}

int OpenInFolder(const std::filesystem::path& folder, std::string_view path) {
  if (path.empty() || path.size() > kLongestPath || path.find('\0') != path.npos) return -1;
  int at = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  while (at >= 0) {
    const size_t slash = path.find('/');
    const std::string name(path.substr(0, slash));
    if (name.empty() || name == "." || name == "..") {
      ::close(at);
      return -1;
    }
    at = OpenStep(at, name, slash == path.npos ? 0 : O_DIRECTORY);
    if (slash == path.npos) break;
    path.remove_prefix(slash + 1);
  }
  if (at >= 0 && !IsRegular(at)) {
    ::close(at);
    return -1;
  }
  return at;
}

}  // namespace airsim360

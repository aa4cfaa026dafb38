#include "airsim360/base/file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "airsim360/base/error.h"
#include "airsim360/base/write_all.h"

namespace airsim360 {
namespace fs = std::filesystem;

std::span<const std::byte> AsBytes(std::string_view text) { return {reinterpret_cast<const std::byte*>(text.data()), text.size()}; }

std::string_view AsText(std::span<const std::byte> bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

namespace {

// "; did you mean 'x'?" for a file beside `path` whose name is near, or "".
std::string NearFile(const fs::path& path) {
  constexpr size_t kMaxNames = 4096;  // a folder of frames is not listed whole
  std::vector<std::string> names;
  std::error_code error;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  for (fs::directory_iterator it(folder, error), end; !error && it != end && names.size() < kMaxNames; it.increment(error))
    names.push_back(it->path().filename().string());
  std::ranges::sort(names);
  const std::string near = NearestChoice(path.filename().string(), names);
  return near.empty() ? "" : "; did you mean '" + (path.parent_path() / near).string() + "'?";
}

}  // namespace

Bytes ReadFile(const fs::path& path, uint64_t max_size) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (error || !fs::exists(status)) throw InputError(path.string() + ": no such file" + NearFile(path));
  if (!fs::is_regular_file(status)) throw InputError(path.string() + ": not a regular file");
  const uint64_t size = fs::file_size(path, error);
  if (error) throw InputError(path.string() + ": " + error.message());
  if (size > max_size) {
    throw InputError(path.string() + ": " + std::to_string(size) + " bytes, the limit is " + std::to_string(max_size));
  }
  Bytes bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)) && size > 0) {
    throw InputError(path.string() + ": cannot read");
  }
  return bytes;
}

std::string ReadTextFile(const fs::path& path, uint64_t max_size) { return std::string(AsText(ReadFile(path, max_size))); }

namespace internal {

int WriteAll(int file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written > 0) bytes = bytes.subspan(static_cast<size_t>(written));
    if (written < 0 && errno != EINTR) return errno;
  }
  return 0;
}

void ThrowWriteError(const fs::path& path, int error) { throw RuntimeError(path.string() + ": cannot write: " + std::strerror(error)); }

}  // namespace internal

void WriteFileAtomically(const fs::path& path, std::span<const std::byte> bytes) {
  fs::path temporary = path;
  temporary += ".tmp";
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) internal::ThrowWriteError(path, errno);

  // Write everything and make it durable before the rename makes it visible.
  int error = internal::WriteAll(fd, bytes);
  if (error == 0 && ::fsync(fd) != 0) error = errno;
  if (::close(fd) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    internal::ThrowWriteError(path, error);
  }
}

void WriteFileAtomically(const fs::path& path, std::string_view text) { WriteFileAtomically(path, AsBytes(text)); }

void CreateWritableFolder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw RuntimeError(path.string() + ": cannot create folder: " + error.message());
  if (!fs::is_directory(path)) throw RuntimeError(path.string() + ": not a folder");
  if (::access(path.c_str(), W_OK) != 0) internal::ThrowWriteError(path, errno);
}

}  // namespace airsim360

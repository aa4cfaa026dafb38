#include "airsim360/dataset/folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"
#include "airsim360/dataset/record/spec.h"

namespace airsim360 {

namespace fs = std::filesystem;

namespace {

bool IsTemporary(const fs::path& path) { return path.extension() == ".tmp"; }

// Is it a finished dataset that has lost the file `name`, which held `text`? Its checksums tell.
bool HasLost(const fs::path& folder, const char* name, const std::string& text) {
  if (!fs::is_regular_file(folder / kChecksumsName)) return false;
  const std::string line = Sha256Hex(AsBytes(text)) + "  " + name + "\n";
  return ("\n" + ReadTextFile(folder / kChecksumsName)).find("\n" + line) != std::string::npos;
}

}  // namespace

// Not O_CLOEXEC: processes that render for this one inherit the lock, so that those of a run that was killed still
// hold it while they end.
FolderLock::FolderLock(const fs::path& folder) : fd_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY)) {
  if (fd_ < 0) throw RuntimeError(folder.string() + ": cannot open: " + std::strerror(errno));
  constexpr auto kPatience = std::chrono::seconds(2);  // a killed run's processes end within it
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (::flock(fd_, LOCK_EX | LOCK_NB) != 0) {
    if (std::chrono::steady_clock::now() >= deadline) {
      ::close(fd_);
      throw RuntimeError(folder.string() + ": another airsim360 is writing here");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

FolderLock::~FolderLock() { ::close(fd_); }

void CheckFolder(const fs::path& folder, const std::string& meta, const std::string& what, const char* name) {
  if (folder.empty()) throw InputError("--out: '' is no name of a folder");
  for (fs::path place = folder; place.has_relative_path(); place = place.parent_path())
    if (fs::exists(place) && !fs::is_directory(place)) throw InputError("--out: '" + place.string() + "' is not a folder");
  CreateWritableFolder(folder);
  const fs::path on_disk = folder / name;
  if (!fs::exists(on_disk)) {
    if (HasLost(folder, name, meta)) return;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (IsTemporary(entry.path())) continue;
      throw InputError("--out: '" + folder.string() + "' is not empty and not a " + what + " (it holds '" +
                       entry.path().filename().string() + "')");
    }
    return;
  }
  const std::string difference = DescribeMetaDifference(ReadTextFile(on_disk), meta);
  if (!difference.empty()) {
    throw InputError("--out: '" + folder.string() + "' holds another " + what + ": " + difference +
                     "; choose another folder or the same parameters");
  }
}

void RemoveTemporaryFiles(const fs::path& folder) {
  for (const std::string& file : ListFiles(folder)) {
    if (IsTemporary(file)) fs::remove(folder / file);
  }
}

std::vector<std::string> ListFiles(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) files.push_back(entry.path().lexically_relative(folder).generic_string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace airsim360

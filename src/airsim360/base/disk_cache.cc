#include "airsim360/base/disk_cache.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "airsim360/base/checksum.h"
#include "airsim360/base/error.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/log.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/write_all.h"

namespace airsim360 {

namespace fs = std::filesystem;

namespace {

// First line of every entry; then a hash of the content in hex, a line feed, the content.
constexpr std::string_view kMagic = "airsim360 cache 2\n";
constexpr size_t kHashDigits = 64;
constexpr size_t kHeader = kMagic.size() + kHashDigits + 1;
constexpr const char* kExtension = ".cache";
constexpr size_t kBlock = size_t{1} << 20;  // bytes that one task reads and hashes

std::string Variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

void WarnOnce(const std::string& message) {
  static std::atomic_flag told;
  if (!told.test_and_set()) LogWarning("cache: " + message);
}

// SHA-256 of the checksums of all blocks in order, which are made side by side; empty where `ready`, which is asked of each block
// before it is read, says that one is not there.
template <class Ready>
std::string HashOfBlocks(std::span<const std::byte> content, const Ready& ready) {
  std::vector<uint64_t> checksums((content.size() + kBlock - 1) / kBlock);
  std::atomic<bool> whole = true;
  ParallelFor(static_cast<int64_t>(checksums.size()), [&](int64_t i) {
    const size_t begin = static_cast<size_t>(i) * kBlock;
    const auto block = content.subspan(begin, std::min(kBlock, content.size() - begin));
    if (ready(block))
      checksums[static_cast<size_t>(i)] = Checksum(block);
    else
      whole = false;
  });
  return whole ? Sha256Hex(std::as_bytes(std::span(checksums))) : std::string();
}

std::string HashOfBlocks(std::span<const std::byte> content) {
  return HashOfBlocks(content, [](std::span<const std::byte>) { return true; });
}

// Maps the pages of a part of a file; false where the disk does not give them, which would end the program if they were touched.
bool Populate(std::span<const std::byte> part) {
  const auto page = static_cast<uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto first = reinterpret_cast<uintptr_t>(part.data()) / page * page;
  const auto last = reinterpret_cast<uintptr_t>(part.data()) + part.size();
  // EINVAL: a system before Linux 5.14.
  return ::madvise(reinterpret_cast<void*>(first), last - first, MADV_POPULATE_READ) == 0 || errno == EINVAL;
}

// A file in memory, without a copy: large entries take longer to copy than to read.
std::optional<CacheContent> MapFile(const fs::path& path, size_t skipped) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return std::nullopt;
  struct stat status {};
  void* mapping = MAP_FAILED;
  const bool fits = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && static_cast<size_t>(status.st_size) >= skipped;
  if (fits) mapping = ::mmap(nullptr, static_cast<size_t>(status.st_size), PROT_READ, MAP_PRIVATE, file, 0);
  ::close(file);
  if (mapping == MAP_FAILED) return std::nullopt;
  return CacheContent(static_cast<const std::byte*>(mapping), static_cast<size_t>(status.st_size), skipped);
}

// What a power cut leaves of an entry fails its hash: nobody waits for the disk, and a large content is not copied behind its head.
void WriteEntry(const fs::path& path, std::string_view head, std::span<const std::byte> content) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  int error = file < 0 ? errno : 0;
  for (const std::span<const std::byte> part : {std::as_bytes(std::span(head)), content})
    if (error == 0) error = internal::WriteAll(file, part);
  if (file >= 0 && ::close(file) != 0 && error == 0) error = errno;
  if (error != 0) internal::ThrowWriteError(path, error);
}

bool IsWhole(const CacheContent& content) {
  const std::span<const std::byte> bytes = content.bytes();
  const std::span<const std::byte> head(bytes.data() - kHeader, kHeader);
  if (!Populate(head)) return false;
  const std::string_view header = AsText(head);
  return header.starts_with(kMagic) && header.back() == '\n' && header.substr(kMagic.size(), kHashDigits) == HashOfBlocks(bytes, Populate);
}

}  // namespace

CacheKey::CacheKey(std::string_view kind, int version) : kind_(kind) { Add(kind).Add(version); }

CacheKey& CacheKey::Add(std::span<const std::byte> bytes) {
  text_ += Sha256Hex(bytes);
  return *this;
}

CacheKey& CacheKey::AddProgram() {
  if (const char* build = std::getenv("AIRSIM360_CACHE_PROGRAM")) return Add(build);
  std::error_code error;
  AddFile(fs::read_symlink("/proc/self/exe", error));
  // In Python the program is the interpreter, and this code a shared library of its own.
  static const int kHere = 0;
  Dl_info library{};
  if (dladdr(&kHere, &library) == 0 || library.dli_fname == nullptr) return *this;
  const fs::path path = library.dli_fname;
  return path.extension() == ".so" ? AddFile(path) : *this;
}

CacheKey& CacheKey::AddFile(const fs::path& path) {
  std::error_code error;
  const uint64_t size = fs::file_size(path, error);
  if (error) return Add("no file");
  return Add(path.native()).Add(size).Add(fs::last_write_time(path, error).time_since_epoch().count());
}

std::string CacheKey::Name() const { return kind_ + "-" + Sha256Hex(AsBytes(text_)); }

DiskCache::DiskCache(fs::path folder, uint64_t limit) : folder_(std::move(folder)), limit_(limit) {}

DiskCache DiskCache::OfUser() {
  if (const char* own = std::getenv("AIRSIM360_CACHE")) return DiskCache(own);
  if (const std::string base = Variable("XDG_CACHE_HOME"); !base.empty()) return DiskCache(fs::path(base) / "airsim360");
  const std::string home = Variable("HOME");
  return DiskCache(home.empty() ? fs::path() : fs::path(home) / ".cache" / "airsim360");
}

void CacheContent::Unmap::operator()(const std::byte* mapping) const { ::munmap(const_cast<std::byte*>(mapping), size); }

std::optional<CacheContent> DiskCache::Load(const CacheKey& key) const {
  if (folder_.empty()) return std::nullopt;
  const fs::path path = folder_ / (key.Name() + kExtension);
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return std::nullopt;
  std::optional<CacheContent> content = MapFile(path, kHeader);
  if (!content || !IsWhole(*content)) {
    WarnOnce(path.string() + " is damaged; its content is computed again");
    fs::remove(path, ignored);
    return std::nullopt;
  }
  // Its age counts from its last use.
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
  return content;
}

void DiskCache::Store(const CacheKey& key, std::span<const std::byte> content) const {
  if (folder_.empty() || content.size() + kHeader > limit_) return;
  const std::string head = std::string(kMagic) + HashOfBlocks(content) + "\n";
  // A name of its own while it is written: another program may store the same entry at the same time.
  const fs::path path = folder_ / (key.Name() + kExtension);
  const fs::path own = path.string() + "." + std::to_string(::getpid());
  try {
    CreateWritableFolder(folder_);
    WriteEntry(own, head, content);
    fs::rename(own, path);
    Shrink();
  } catch (const std::exception& error) {
    WarnOnce(std::string(error.what()) + "; nothing is kept");
    std::error_code ignored;
    fs::remove(own, ignored);
  }
}

void DiskCache::Shrink() const {
  struct Entry {
    fs::file_time_type used;
    fs::path path;
    uint64_t size;
  };
  std::vector<Entry> entries;
  uint64_t total = 0;
  std::error_code error;
  for (const auto& file : fs::directory_iterator(folder_, error)) {
    // Only what is ours; files of writers that died go with the rest.
    if (file.path().filename().string().find(kExtension) == std::string::npos) continue;
    const uint64_t size = file.file_size(error);
    if (error) continue;
    const auto used = file.last_write_time(error);
    if (error) continue;
    entries.push_back({used, file.path(), size});
    total += size;
  }
  const fs::space_info disk = fs::space(folder_, error);
  const uint64_t limit = error ? limit_ : std::min(limit_, (disk.available + total) / 4);
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (const Entry& entry : entries) {
    if (total <= limit) return;
    fs::remove(entry.path, error);
    total -= entry.size;
  }
}

}  // namespace airsim360

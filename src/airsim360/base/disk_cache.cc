#include "airsim360/base/disk_cache.h"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <system_error>

#include "airsim360/base/error.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/log.h"

namespace airsim360 {

namespace fs = std::filesystem;

namespace {

// First line of every entry; then the SHA-256 of the content in hex, a line feed, the content.
constexpr std::string_view kMagic = "airsim360 cache 1\n";
constexpr size_t kHashDigits = 64;
constexpr size_t kHeader = kMagic.size() + kHashDigits + 1;
constexpr const char* kExtension = ".cache";

std::string Variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

void WarnOnce(const std::string& message) {
  static std::atomic_flag told;
  if (!told.test_and_set()) LogWarning("cache: " + message);
}

}  // namespace

CacheKey::CacheKey(std::string_view kind, int version) : kind_(kind) { Add(kind).Add(version); }

CacheKey& CacheKey::Add(std::span<const std::byte> bytes) {
  text_ += Sha256Hex(bytes);
  return *this;
}

CacheKey& CacheKey::AddProgram() {
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

std::optional<Bytes> DiskCache::Load(const CacheKey& key) const {
  if (folder_.empty()) return std::nullopt;
  const fs::path path = folder_ / (key.Name() + kExtension);
  Bytes bytes;
  try {
    bytes = ReadFile(path);
  } catch (const InputError&) {
    return std::nullopt;
  }
  const std::string_view text = AsText(bytes);
  const bool whole = text.size() >= kHeader && text.starts_with(kMagic) && text[kHeader - 1] == '\n' &&
                     text.substr(kMagic.size(), kHashDigits) == Sha256Hex(std::span<const std::byte>(bytes).subspan(kHeader));
  std::error_code ignored;
  if (!whole) {
    WarnOnce(path.string() + " is damaged; its content is computed again");
    fs::remove(path, ignored);
    return std::nullopt;
  }
  // Its age counts from its last use.
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
  bytes.erase(bytes.begin(), bytes.begin() + kHeader);
  return bytes;
}

void DiskCache::Store(const CacheKey& key, std::span<const std::byte> content) const {
  if (folder_.empty() || content.size() + kHeader > limit_) return;
  Bytes bytes;
  bytes.reserve(kHeader + content.size());
  const auto append = [&](std::span<const std::byte> part) { bytes.insert(bytes.end(), part.begin(), part.end()); };
  append(AsBytes(kMagic));
  append(AsBytes(Sha256Hex(content) + "\n"));
  append(content);
  // A name of its own while it is written: another program may store the same entry at the same time.
  const fs::path path = folder_ / (key.Name() + kExtension);
  const fs::path own = path.string() + "." + std::to_string(::getpid());
  try {
    CreateWritableFolder(folder_);
    WriteFileAtomically(own, bytes);
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

// Results that take long to compute, kept on disk under a hash of everything they depend on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "airsim360/base/file.h"

namespace airsim360 {

/// Name of an entry: SHA-256 over everything that went in. Change the version whenever the code that computes
/// the result changes.
class CacheKey {
 public:
  /// `kind` is for people ("light_probes"), `version` of the code.
  CacheKey(std::string_view kind, int version);
  CacheKey& Add(std::span<const std::byte> bytes);
  CacheKey& Add(std::string_view text) { return Add(AsBytes(text)); }
  /// Numbers and arrays of numbers; types without padding, whose bytes are their value.
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T> CacheKey& Add(T value) { return Add(std::as_bytes(std::span(&value, 1))); }
  /// What this program is (size and time of its file), so that a rebuilt one reads nothing of the old.
  CacheKey& AddProgram();
  /// Size and time of a file, or that there is none.
  CacheKey& AddFile(const std::filesystem::path& path);
  /// "light_probes-0123…": a file name.
  std::string Name() const;

 private:
  std::string kind_;
  std::string text_;  // hash of every part, in order: boundaries count
};

/// What an entry holds.
class CacheContent {
 public:
  /// Of a mapping of `size` bytes without the first `skipped`; unmaps it at its end.
  CacheContent(const std::byte* mapping, size_t size, size_t skipped)
      : mapping_(mapping, {size}), bytes_(mapping + skipped, size - skipped) {}
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  struct Unmap {
    size_t size;
    void operator()(const std::byte* mapping) const;
  };
  std::unique_ptr<const std::byte, Unmap> mapping_;
  std::span<const std::byte> bytes_;
};

/// A folder of entries, safe to delete at any time, also while programs use it. Several programs may share
/// it: entries appear whole or not at all, and one that is damaged, cut off or of another format counts as
/// missing. Nothing that goes wrong on the disk is an error: the result is computed again, after one warning
/// of the program.
class DiskCache {
 public:
  /// Room for all built-in worlds with their navigation meshes and light (a city takes up to 0.8 GB): a recipe
  /// that goes through more worlds than fit would find none of them the second time.
  static constexpr uint64_t kDefaultLimit = uint64_t{12} << 30;

  /// An empty folder name: keeps nothing. `limit`: bytes of all entries together, and never more than a quarter
  /// of what the disk would have free without them; the ones not used for the longest time go first.
  explicit DiskCache(std::filesystem::path folder, uint64_t limit = kDefaultLimit);
  /// $AIRSIM360_CACHE, else $XDG_CACHE_HOME/airsim360, else ~/.cache/airsim360; keeps nothing where there is
  /// no home or AIRSIM360_CACHE is empty.
  static DiskCache OfUser();

  /// Reads and checks on all threads.
  std::optional<CacheContent> Load(const CacheKey& key) const;
  void Store(const CacheKey& key, std::span<const std::byte> content) const;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  void Shrink() const;

  std::filesystem::path folder_;
  uint64_t limit_;
};

}  // namespace airsim360

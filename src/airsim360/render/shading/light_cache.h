// What the light of a scene takes long to compute, kept in the user's disk cache.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "airsim360/base/archive.h"
#include "airsim360/base/disk_cache.h"
#include "airsim360/scene/scene_archive.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// The results for one scene under one environment. Keeps nothing of scenes without a cache_key, and of those
/// where something has moved. Or what is the same in every scene: all that `key` stands for.
class LightCache {
 public:
  LightCache(const RayTracer& tracer, const Environment& environment)
      : enabled_(!tracer.scene().cache_key.empty() && tracer.moved().empty() && tracer.deformed().empty() && !disk_.folder().empty()) {
    if (!enabled_) return;
    CacheKey key("lit_scene", 1);
    key.AddProgram().Add(tracer.scene().cache_key);
    AddToKey(key, environment);
    lit_scene_ = key.Name();
  }
  explicit LightCache(CacheKey key) : enabled_(!disk_.folder().empty()), lit_scene_(key.AddProgram().Name()) {}

  bool enabled() const { return enabled_; }
  /// make(), or what it gave in an earlier run. T is movable, is made empty by T(), and lists its fields in
  /// T::Visit(archive, self).
  template <class T, class Make>
  T Get(std::string_view kind, const Make& make) const {
    if (!enabled_) return make();
    CacheKey key(kind, 1);
    key.Add(lit_scene_);
    if (const std::optional<CacheContent> found = disk_.Load(key)) {
      if (std::optional<T> kept = Read<T>(found->bytes())) return std::move(*kept);
    }
    T made = make();
    ArchiveWriter archive;
    T::Visit(archive, std::as_const(made));
    disk_.Store(key, archive.bytes());
    return made;
  }

 private:
  template <class T>
  static std::optional<T> Read(std::span<const std::byte> bytes) {
    try {
      ArchiveReader archive(bytes);
      T kept;
      T::Visit(archive, kept);
      if (archive.done()) return kept;
    } catch (const InputError&) {  // of another program: computed again
    }
    return std::nullopt;
  }

  DiskCache disk_ = DiskCache::OfUser();
  bool enabled_;
  std::string lit_scene_;
};

}  // namespace airsim360::internal

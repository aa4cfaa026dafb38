// A whole scene as bytes, for the disk cache.
#pragma once

#include <optional>
#include <span>

#include "airsim360/base/disk_cache.h"
#include "airsim360/base/file.h"
#include "airsim360/scene/scene.h"

namespace airsim360 {

/// Everything of a scene but its cache_key. Equal scenes give equal bytes; only the program that wrote them
/// can read them.
Bytes ArchiveScene(const Scene& scene);

/// What of it can be seen in pictures: everything but its cache_key and its roads.
Bytes ArchivePictured(const Scene& scene);

/// The scene that ArchiveScene was given, exactly; nullopt where the bytes are cut off or too many. Bytes
/// changed in other ways are for a checksum to find, as DiskCache has.
std::optional<Scene> SceneFromArchive(std::span<const std::byte> bytes);

/// Adds every value of an environment to a key.
void AddToKey(CacheKey& key, const Environment& environment);

}  // namespace airsim360

#include "airsim360/worlds/texture/kept_textures.h"

#include <optional>
#include <utility>

#include "airsim360/scene/scene.h"
#include "airsim360/scene/scene_archive.h"

namespace airsim360::internal {

std::vector<Texture> KeptTextures(const DiskCache& cache, std::string_view name, const std::function<std::vector<Texture>()>& make) {
  if (cache.folder().empty()) return make();
  const CacheKey key = CacheKey("textures", 1).Add(name).AddProgram();
  if (const std::optional<CacheContent> kept = cache.Load(key)) {
    if (std::optional<Scene> scene = SceneFromArchive(kept->bytes())) return std::move(scene->textures);
  }
  Scene scene;
  scene.textures = make();
  cache.Store(key, ArchiveScene(scene));
  return std::move(scene.textures);
}

}  // namespace airsim360::internal

#include "airsim360/vln/episodes/world_things.h"

#include <algorithm>
#include <cstring>

#include "airsim360/base/hash.h"

namespace airsim360 {

WorldThings ThingsOf(const Scene& scene, size_t count) {
  count = std::min(count, scene.entities.size());
  std::string text;
  for (size_t i = 0; i < count; ++i) {
    const Entity& entity = scene.entities[i];
    const float box[6] = {entity.bounds.min.x, entity.bounds.min.y, entity.bounds.min.z,
                          entity.bounds.max.x, entity.bounds.max.y, entity.bounds.max.z};
    char bytes[sizeof(box)];
    std::memcpy(bytes, box, sizeof(box));
    text.append(entity.name).push_back('\0');
    text.append(scene.tree[entity.category].path).push_back('\0');
    text.append(bytes, sizeof(bytes));
  }
  return {count, Sha256Hex(std::as_bytes(std::span(text)))};
}

std::string ThingsDiffer(const WorldThings& made_in, const Scene& scene) {
  if (made_in.count == 0) return "";
  const WorldThings now = ThingsOf(scene, made_in.count);
  if (now == made_in) return "";
  const std::string what = now.count < made_in.count
                               ? "it had " + std::to_string(made_in.count) + " things and has " + std::to_string(now.count)
                               : "the names, categories or boxes of its first " + std::to_string(now.count) + " things are others";
  return "the world has changed since it was made: " + what;
}

}  // namespace airsim360

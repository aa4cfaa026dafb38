// A tileset, or a tile, from arbitrary bytes. What it refers to by ".json" is what follows the first "TILESET", by
// any other name what follows the first "CONTENT".
#include <cstddef>
#include <cstdint>

#include "airsim360/assets/importing/scene_assembly.h"
#include "airsim360/assets/tiles/tiles.h"
#include "airsim360/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  using namespace airsim360::internal;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const size_t inner = std::min(text.find("TILESET"), size), content = std::min(text.find("CONTENT"), size);
  const ResourceLoader load = [&](const std::string& name) -> std::optional<Bytes> {
    const size_t at = name.ends_with(".json") ? inner : content;
    if (at == size) return std::nullopt;
    const auto bytes = AsBytes(text.substr(at + 7));
    return Bytes(bytes.begin(), bytes.end());
  };
  ImportLimits limits;
  limits.max_vertices = limits.max_triangles = limits.max_nodes = 1 << 16;
  limits.max_texture_pixels = 1 << 20;
  limits.max_buffer_bytes = 1 << 24;
  const std::string_view head = text.substr(0, std::min(inner, content));
  try {
    ImportedFile file = head.starts_with("{") ? ReadTileset("fuzz", head, load, limits, 64) : ReadTile("fuzz", AsBytes(head), load, limits);
    AssembleScene(std::move(file), {}, "fuzz", "fuzz");
  } catch (const InputError&) {
  }
  return 0;
}

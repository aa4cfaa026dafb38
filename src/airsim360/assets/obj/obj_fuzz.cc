// OBJ and MTL from arbitrary bytes: the text before the first zero byte is the OBJ, what follows is its only
// library.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "airsim360/assets/importing/scene_assembly.h"
#include "airsim360/assets/obj/obj.h"
#include "airsim360/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  using namespace airsim360::internal;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const size_t cut = std::min(text.find('\0'), size);
  const ResourceLoader load = [&](const std::string&) -> std::optional<Bytes> {
    if (cut == size) return std::nullopt;
    const auto bytes = AsBytes(text.substr(cut + 1));
    return Bytes(bytes.begin(), bytes.end());
  };
  ImportLimits limits;
  limits.max_vertices = limits.max_triangles = 1 << 16;
  limits.max_texture_pixels = 1 << 20;
  try {
    ImportedFile file = ReadObj("fuzz", text.substr(0, cut), load, limits);
    AssembleScene(std::move(file), {}, "fuzz", "fuzz");
  } catch (const InputError&) {
  }
  return 0;
}

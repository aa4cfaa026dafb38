// glTF and GLB from arbitrary bytes: anything but an InputError is a finding.
#include <cstddef>
#include <cstdint>

#include "airsim360/assets/gltf/gltf.h"
#include "airsim360/assets/importing/scene_assembly.h"
#include "airsim360/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  using namespace airsim360::internal;
  ImportLimits limits;
  limits.max_vertices = limits.max_triangles = 1 << 16;
  limits.max_nodes = 1 << 12;
  limits.max_texture_pixels = 1 << 20;
  limits.max_buffer_bytes = 1 << 24;
  // Files beside the model: a few bytes of the input itself.
  const ResourceLoader load = [&](const std::string& name) -> std::optional<Bytes> {
    if (name.size() > 8) return std::nullopt;
    const auto* bytes = reinterpret_cast<const std::byte*>(data);
    return Bytes(bytes, bytes + (size < 64 ? size : 64));
  };
  try {
    ImportedFile file = ReadGltf("fuzz", {reinterpret_cast<const std::byte*>(data), size}, load, limits);
    AssembleScene(std::move(file), {}, "fuzz", "fuzz");
  } catch (const InputError&) {
  }
  return 0;
}

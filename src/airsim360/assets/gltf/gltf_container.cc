// The .glb container.
#include <cstring>

#include "airsim360/assets/gltf/gltf_parts.h"
#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

uint32_t LoadU32(std::span<const std::byte> bytes, size_t offset) {
  uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, 4);
  return value;
}

}  // namespace

// A .glb is "glTF", version, length, then chunks of length, type, bytes: JSON first, BIN second (glTF 2.0,
// section 4).
GltfContainer OpenGltfContainer(const std::string& file, std::span<const std::byte> bytes) {
  constexpr uint32_t kMagic = 0x46546c67, kJson = 0x4e4f534a, kBinary = 0x004e4942;
  if (bytes.size() < 4 || LoadU32(bytes, 0) != kMagic) return {AsText(bytes), {}};
  const auto fail = [&](const std::string& what) { throw InputError(file + ": " + what); };
  if (bytes.size() < 20) fail("GLB header cut short at " + std::to_string(bytes.size()) + " bytes");
  if (LoadU32(bytes, 4) != 2) fail("GLB version " + std::to_string(LoadU32(bytes, 4)) + ": only 2 is read");
  const uint64_t length = LoadU32(bytes, 8);
  if (length > bytes.size() || length < 20) {
    fail("GLB header says " + std::to_string(length) + " bytes, the file has " + std::to_string(bytes.size()));
  }
  GltfContainer out;
  for (uint64_t at = 12; at + 8 <= length;) {
    const uint64_t size = LoadU32(bytes, at);
    const uint32_t type = LoadU32(bytes, at + 4);
    at += 8;
    if (size > length - at) fail("GLB chunk of " + std::to_string(size) + " bytes at byte " + std::to_string(at) + " is cut short");
    const std::span<const std::byte> chunk = bytes.subspan(at, size);
    if (type == kJson && out.json.empty()) out.json = AsText(chunk);
    if (type == kBinary && out.binary.empty()) out.binary = chunk;
    at += (size + 3) / 4 * 4;
  }
  if (out.json.empty()) fail("GLB file without a JSON chunk");
  return out;
}

}  // namespace airsim360::internal

// EXT_meshopt_compression: decoding compressed buffer views.
#include <meshoptimizer.h>

#include "airsim360/assets/gltf/gltf_buffers.h"

namespace airsim360::internal {
namespace {

// Undoes a filter in place; false if it does not fit the stride.
bool ApplyFilter(const std::string& filter, void* data, size_t count, size_t stride) {
  if (filter == "NONE") return true;
  if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) {
    meshopt_decodeFilterOct(data, count, stride);
  } else if (filter == "QUATERNION" && stride == 8) {
    meshopt_decodeFilterQuat(data, count, stride);
  } else if (filter == "EXPONENTIAL" && stride % 4 == 0) {
    meshopt_decodeFilterExp(data, count, stride);
  } else {
    return false;
  }
  return true;
}

}  // namespace

std::span<const std::byte> GltfBuffers::Decompress(const JsonRef& extension, uint64_t key) {
  if (const auto known = decompressed_.find(key); known != decompressed_.end()) return known->second;
  const std::span<const std::byte> source = Slice(extension);
  const std::string mode = extension.At("mode").Text();
  const std::string filter = extension.TextOr("filter", "NONE");
  const uint64_t stride = extension.At("byteStride").Uint(256);
  const uint64_t count = extension.At("count").Uint(uint64_t{1} << 32);

  // What the codecs can hold at most: 2 bits for 16 vertex bytes, one byte for a triangle or an index.
  const bool vertices = mode == "ATTRIBUTES";
  if (!vertices && mode != "TRIANGLES" && mode != "INDICES") extension.At("mode").Fail("unknown mode");
  if (vertices ? stride == 0 || stride % 4 != 0 : stride != 2 && stride != 4)
    extension.At("byteStride").Fail("a stride that the mode does not allow");
  if (mode == "TRIANGLES" && count % 3 != 0) extension.At("count").Fail("a multiple of three expected");
  const uint64_t most = vertices ? uint64_t{source.size()} * 64 + 65536 : uint64_t{source.size()} * (mode == "TRIANGLES" ? 3 : 1) * stride;
  if (count * stride > most) extension.At("count").Fail("more than " + std::to_string(source.size()) + " compressed bytes can hold");
  Charge(count * stride, extension);

  // The decoders check every read themselves and answer 0 when all went well.
  Bytes bytes(static_cast<size_t>(count * stride));
  const auto* data = reinterpret_cast<const unsigned char*>(source.data());
  int failed = 0;
  if (vertices) {
    failed = meshopt_decodeVertexBuffer(bytes.data(), count, stride, data, source.size());
  } else if (mode == "TRIANGLES") {
    failed = meshopt_decodeIndexBuffer(bytes.data(), count, stride, data, source.size());
  } else {
    failed = meshopt_decodeIndexSequence(bytes.data(), count, stride, data, source.size());
  }
  if (failed != 0) extension.Fail("damaged compressed data");
  if (vertices && count > 0 && !ApplyFilter(filter, bytes.data(), count, stride))
    extension.At("filter").Fail("unknown, or not for this stride");
  return decompressed_.emplace(key, std::move(bytes)).first->second;
}

}  // namespace airsim360::internal

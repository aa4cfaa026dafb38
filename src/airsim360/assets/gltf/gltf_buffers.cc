#include "airsim360/assets/gltf/gltf_buffers.h"

#include <utility>

#include "airsim360/assets/gltf/gltf_uri.h"

namespace airsim360::internal {

JsonRef GltfBuffers::Element(const char* array, const JsonRef& index) const {
  const std::optional<JsonRef> elements = root_.Find(array);
  const size_t count = elements ? elements->size() : 0;
  const uint64_t i = index.Uint();
  if (i >= count) index.Fail("there are only " + std::to_string(count) + " " + array);
  return (*elements)[static_cast<size_t>(i)];
}

void GltfBuffers::Charge(uint64_t bytes, const JsonRef& where) {
  if (bytes > limits_.max_buffer_bytes - charged_) {
    where.Fail("more than " + std::to_string(limits_.max_buffer_bytes) + " bytes of data");
  }
  charged_ += bytes;
}

std::span<const std::byte> GltfBuffers::Buffer(const JsonRef& index) {
  const JsonRef buffer = Element("buffers", index);
  const uint64_t length = buffer.At("byteLength").Uint();
  const uint64_t i = index.Uint();

  // The bytes: the GLB's own chunk, or those of a URI, loaded once.
  std::span<const std::byte> bytes;
  if (const std::optional<JsonRef> uri = buffer.Find("uri")) {
    auto loaded = buffers_.find(i);
    if (loaded == buffers_.end()) {
      const std::string text = uri->Text();
      std::optional<Bytes> data;
      if (IsDataUri(text)) {
        Charge(text.size() / 4 * 3, *uri);
        data = DecodeDataUri(text);
        if (!data) uri->Fail("a damaged data URI");
      } else {
        const std::optional<std::string> name = DecodePercent(text);
        if (!name) uri->Fail("a damaged URI");
        data = load_(*name);
        if (!data) uri->Fail("no such file beside the model");
        Charge(data->size(), *uri);
      }
      loaded = buffers_.emplace(i, std::move(*data)).first;
    }
    bytes = loaded->second;
  } else {
    if (i != 0 || glb_.empty()) buffer.Fail("a buffer without data");
    bytes = glb_;
  }
  if (length > bytes.size()) {
    buffer.At("byteLength").Fail("only " + std::to_string(bytes.size()) + " bytes are there");
  }
  return bytes.first(static_cast<size_t>(length));
}

std::span<const std::byte> GltfBuffers::Slice(const JsonRef& object) {
  const std::span<const std::byte> buffer = Buffer(object.At("buffer"));
  const uint64_t offset = object.UintOr("byteOffset", 0);
  const uint64_t length = object.At("byteLength").Uint();
  if (offset > buffer.size() || length > buffer.size() - offset) {
    object.Fail("bytes " + std::to_string(offset) + " + " + std::to_string(length) + " of a buffer of " + std::to_string(buffer.size()));
  }
  return buffer.subspan(static_cast<size_t>(offset), static_cast<size_t>(length));
}

GltfBuffers::ViewBytes GltfBuffers::ReadView(const JsonRef& index) {
  const JsonRef view = Element("bufferViews", index);
  const uint64_t stride = view.UintOr("byteStride", 0);
  if (stride > 65536) view.At("byteStride").Fail("too large");
  if (const auto extensions = view.Find("extensions")) {
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
      if (const auto meshopt = extensions->Find(name)) {
        return {Decompress(*meshopt, index.Uint()), meshopt->At("byteStride").Uint(256)};
      }
    }
  }
  return {Slice(view), stride};
}

}  // namespace airsim360::internal

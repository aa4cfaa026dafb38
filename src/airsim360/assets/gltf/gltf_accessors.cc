// Accessors: typed elements in buffer views, dense or sparse.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "airsim360/assets/gltf/gltf_buffers.h"

namespace airsim360::internal {
namespace {

enum ComponentType : uint32_t { kI8 = 5120, kU8 = 5121, kI16 = 5122, kU16 = 5123, kU32 = 5125, kF32 = 5126 };

uint64_t SizeOf(uint32_t type, const JsonRef& where) {
  if (type == kI8 || type == kU8) return 1;
  if (type == kI16 || type == kU16) return 2;
  if (type == kU32 || type == kF32) return 4;
  where.Fail("unknown component type");
}

const char* TypeName(int components) {
  switch (components) {
    case 1:
      return "SCALAR";
    case 2:
      return "VEC2";
    case 3:
      return "VEC3";
    case 4:
      return "VEC4";
    default:
      return "MAT4";
  }
}

template <class T>
T Load(const std::byte* p) {
  T value;
  std::memcpy(&value, p, sizeof(T));
  return value;
}

float ToFloat(const std::byte* p, uint32_t type, bool normalized) {
  switch (type) {
    case kI8:
      return normalized ? std::max(Load<int8_t>(p) / 127.0f, -1.0f) : Load<int8_t>(p);
    case kU8:
      return normalized ? Load<uint8_t>(p) / 255.0f : Load<uint8_t>(p);
    case kI16:
      return normalized ? std::max(Load<int16_t>(p) / 32767.0f, -1.0f) : Load<int16_t>(p);
    case kU16:
      return normalized ? Load<uint16_t>(p) / 65535.0f : Load<uint16_t>(p);
    case kU32:
      return static_cast<float>(Load<uint32_t>(p));
    default:
      return Load<float>(p);
  }
}

uint32_t ToUint(const std::byte* p, uint32_t type) {
  return type == kU8 ? Load<uint8_t>(p) : type == kU16 ? Load<uint16_t>(p) : Load<uint32_t>(p);
}

}  // namespace

struct GltfBuffers::Accessor {
  explicit Accessor(JsonRef accessor) : json(std::move(accessor)) {}
  JsonRef json;
  uint64_t count = 0;
  uint32_t type = kF32;
  uint64_t component_size = 4;
  int components = 1;
  bool normalized = false;
  std::span<const std::byte> bytes;  // from the first element on; empty = all zero
  uint64_t stride = 0;
};

GltfBuffers::Accessor GltfBuffers::Describe(const JsonRef& index, int components) {
  Accessor a(Element("accessors", index));
  a.components = components;
  a.count = a.json.At("count").Uint(limits_.max_vertices);
  a.type = static_cast<uint32_t>(a.json.At("componentType").Uint(kF32));
  a.component_size = SizeOf(a.type, a.json.At("componentType"));
  a.normalized = a.json.BoolOr("normalized", false);
  if (a.json.At("type").Text() != TypeName(components)) a.json.At("type").Fail(std::string(TypeName(components)) + " expected");

  // Without a view all elements are zero (to be replaced by a sparse part): then the count has nothing to
  // hold it.
  const std::optional<JsonRef> view_index = a.json.Find("bufferView");
  if (!view_index) {
    a.json.At("count").Uint(std::min(limits_.max_vertices, uint64_t{1} << 24));
    return a;
  }
  const ViewBytes view = ReadView(*view_index);
  const uint64_t element = a.component_size * static_cast<uint64_t>(components);
  a.stride = view.stride == 0 ? element : view.stride;
  if (a.stride < element) a.json.Fail("elements of " + std::to_string(element) + " bytes at a stride of " + std::to_string(a.stride));

  // count <= 2^27 and stride <= 2^16: no overflow.
  const uint64_t offset = a.json.UintOr("byteOffset", 0);
  const uint64_t needed = a.count == 0 ? 0 : (a.count - 1) * a.stride + element;
  if (offset > view.bytes.size() || needed > view.bytes.size() - offset) {
    a.json.Fail(std::to_string(a.count) + " elements need " + std::to_string(needed) + " bytes at offset " + std::to_string(offset) +
                ", the buffer view has " + std::to_string(view.bytes.size()));
  }
  a.bytes = view.bytes.subspan(static_cast<size_t>(offset));
  return a;
}

template <class Out, class Convert>
std::vector<Out> GltfBuffers::Read(const Accessor& a, const JsonRef& where, Convert convert) {
  const auto n = static_cast<size_t>(a.components);
  Charge(a.count * n * sizeof(Out), where);
  std::vector<Out> out(static_cast<size_t>(a.count) * n);
  const auto read_element = [&](const std::byte* p, size_t element) {
    for (size_t k = 0; k < n; ++k) out[element * n + k] = convert(p + k * a.component_size);
  };
  if (!a.bytes.empty()) {
    for (size_t i = 0; i < a.count; ++i) read_element(a.bytes.data() + i * a.stride, i);
  }

  // Sparse: some elements are replaced.
  const std::optional<JsonRef> sparse = a.json.Find("sparse");
  if (!sparse) return out;
  const uint64_t count = sparse->At("count").Uint(a.count);
  const JsonRef indices = sparse->At("indices");
  const JsonRef values = sparse->At("values");
  const auto index_type = static_cast<uint32_t>(indices.At("componentType").Uint());
  const uint64_t index_size = SizeOf(index_type, indices.At("componentType"));
  if (index_type != kU8 && index_type != kU16 && index_type != kU32) indices.At("componentType").Fail("an unsigned type expected");
  const auto bytes_of = [&](const JsonRef& part, uint64_t size) {
    const std::span<const std::byte> view = View(part.At("bufferView"));
    const uint64_t offset = part.UintOr("byteOffset", 0);
    if (offset > view.size() || count * size > view.size() - offset) part.Fail(std::to_string(count) + " elements are not there");
    return view.data() + offset;
  };
  const std::byte* index = bytes_of(indices, index_size);
  const uint64_t element = a.component_size * n;
  const std::byte* value = bytes_of(values, element);
  for (uint64_t i = 0; i < count; ++i) {
    const uint32_t target = ToUint(index + i * index_size, index_type);
    if (target >= a.count) indices.Fail("index " + std::to_string(target) + " of " + std::to_string(a.count));
    read_element(value + i * element, target);
  }
  return out;
}

std::vector<float> GltfBuffers::Floats(const JsonRef& index, int components) {
  const Accessor a = Describe(index, components);
  return Read<float>(a, index, [&](const std::byte* p) { return ToFloat(p, a.type, a.normalized); });
}

std::vector<uint32_t> GltfBuffers::Uints(const JsonRef& index, int components) {
  const Accessor a = Describe(index, components);
  if ((a.type != kU8 && a.type != kU16 && a.type != kU32) || a.normalized) a.json.Fail("plain unsigned integers expected");
  return Read<uint32_t>(a, index, [&](const std::byte* p) { return ToUint(p, a.type); });
}

}  // namespace airsim360::internal

#include "airsim360/assets/export/glb_writer.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr int kFloat = 5126, kUint32 = 5125, kUint16 = 5123;
constexpr int kVertices = 34962, kIndices = 34963, kNoTarget = 0;

void AppendUint32(Bytes& out, uint64_t value) {
  for (int shift : {0, 8, 16, 24}) out.push_back(static_cast<std::byte>(value >> shift));
}

}  // namespace

GlbWriter::GlbWriter() {
  json["asset"] = {{"version", "2.0"}, {"generator", "airsim360 world export"}};
  for (const char* array :
       {"scenes", "nodes", "meshes", "materials", "textures", "images", "samplers", "accessors", "bufferViews", "buffers"}) {
    json[array] = nlohmann::ordered_json::array();
  }
}

size_t GlbWriter::Append(const char* array, nlohmann::ordered_json element) {
  json[array].push_back(std::move(element));
  return json[array].size() - 1;
}

void GlbWriter::Use(const std::string& extension) {
  auto& used = json["extensionsUsed"];
  if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
}

size_t GlbWriter::AddView(std::span<const std::byte> bytes) {
  const size_t offset = binary_.size();
  binary_.insert(binary_.end(), bytes.begin(), bytes.end());
  binary_.resize((binary_.size() + 3) / 4 * 4);
  return Append("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
}

size_t GlbWriter::AddAccessor(std::span<const std::byte> bytes, int target, int component_type, const char* type, size_t count) {
  const size_t view = AddView(bytes);
  if (target != kNoTarget) json["bufferViews"][view]["target"] = target;
  return Append("accessors", {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}});
}

size_t GlbWriter::AddVectors(std::span<const Vec3f> vectors) {
  return AddAccessor(std::as_bytes(vectors), kVertices, kFloat, "VEC3", vectors.size());
}

size_t GlbWriter::AddPositions(std::span<const Vec3f> positions) {
  const size_t accessor = AddVectors(positions);
  Vec3f low = positions[0], high = positions[0];
  for (const Vec3f& p : positions) low = Min(low, p), high = Max(high, p);
  json["accessors"][accessor]["min"] = {low.x, low.y, low.z};
  json["accessors"][accessor]["max"] = {high.x, high.y, high.z};
  return accessor;
}

size_t GlbWriter::AddUvs(std::span<const Vec2f> uvs) { return AddAccessor(std::as_bytes(uvs), kVertices, kFloat, "VEC2", uvs.size()); }

size_t GlbWriter::AddColors(std::span<const VertexColor> colors) {
  const size_t accessor = AddAccessor(std::as_bytes(colors), kVertices, kUint16, "VEC4", colors.size());
  json["accessors"][accessor]["normalized"] = true;
  return accessor;
}

size_t GlbWriter::AddIndices(std::span<const uint32_t> indices) {
  return AddAccessor(std::as_bytes(indices), kIndices, kUint32, "SCALAR", indices.size());
}

Bytes GlbWriter::Finish() {
  json["buffers"].push_back({{"byteLength", binary_.size()}});
  // Empty arrays are not allowed.
  for (auto it = json.begin(); it != json.end();) {
    if (it->is_array() && it->empty())
      it = json.erase(it);
    else
      ++it;
  }

  // Header, then chunks of JSON (padded with blanks) and binary data, each with length and type.
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const uint64_t size = 12 + 8 + text.size() + 8 + binary_.size();
  if (size > UINT32_MAX) {
    throw InputError("the scene needs " + std::to_string(size >> 20) + " MiB as .glb, more than the 4096 MiB that the format allows");
  }
  Bytes out;
  out.reserve(size);
  AppendUint32(out, 0x46546C67);  // "glTF"
  AppendUint32(out, 2);
  AppendUint32(out, size);
  AppendUint32(out, text.size());
  AppendUint32(out, 0x4E4F534A);  // "JSON"
  const auto bytes = AsBytes(text);
  out.insert(out.end(), bytes.begin(), bytes.end());
  AppendUint32(out, binary_.size());
  AppendUint32(out, 0x004E4942);  // "BIN"
  out.insert(out.end(), binary_.begin(), binary_.end());
  return out;
}

}  // namespace airsim360::internal

// Small glTF documents for tests, made in code.
#pragma once

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "airsim360/assets/gltf/gltf.h"
#include "airsim360/base/file.h"

namespace airsim360::internal {

inline std::string EncodeBase64(const Bytes& bytes) {
  static const char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) bits = (bits << 8) | (i + k < bytes.size() ? std::to_integer<uint32_t>(bytes[i + k]) : 0);
    for (size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : kDigits[(bits >> (18 - 6 * k)) & 63];
  }
  return out;
}

/// Gathers numbers in one buffer, with a view and an accessor for each list.
class GltfDocument {
 public:
  nlohmann::json json = {{"asset", {{"version", "2.0"}}}};

  GltfDocument() {
    for (const char* key : {"buffers", "bufferViews", "accessors", "meshes", "nodes"}) json[key] = nlohmann::json::array();
    json["buffers"].push_back({{"byteLength", 0}});
  }

  template <class T>
  size_t AddView(const std::vector<T>& values) {
    const size_t offset = (bytes_.size() + 3) / 4 * 4;
    bytes_.resize(offset + values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(bytes_.data() + offset, values.data(), values.size() * sizeof(T));
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}});
    return json["bufferViews"].size() - 1;
  }
  template <class T>
  size_t AddAccessor(const std::vector<T>& values, int component_type, const std::string& type) {
    const size_t components = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<size_t>(type[3] - '0');
    const size_t view = AddView(values);
    json["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component_type}, {"count", values.size() / components}, {"type", type}});
    return json["accessors"].size() - 1;
  }
  /// The usual test shape: a right triangle in the plane z = 0 of G, facing +Z, as mesh 0 at node 0.
  static GltfDocument Triangle() {
    GltfDocument doc;
    const size_t positions = doc.AddAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3");
    const size_t indices = doc.AddAccessor<uint16_t>({0, 1, 2}, 5123, "SCALAR");
    doc.json["meshes"].push_back({{"name", "tri"}, {"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}}});
    doc.json["nodes"].push_back({{"mesh", 0}, {"name", "node"}});
    return doc;
  }

  const Bytes& bytes() const { return bytes_; }
  /// .gltf text with the buffer embedded.
  std::string Text() const {
    nlohmann::json out = json;
    if (!out["buffers"].empty() && !out["buffers"][0].contains("uri")) {
      if (out["buffers"][0]["byteLength"] == 0) out["buffers"][0]["byteLength"] = bytes_.size();
      out["buffers"][0]["uri"] = "data:application/octet-stream;base64," + EncodeBase64(bytes_);
    }
    return out.dump();
  }
  /// .glb with the buffer as its binary chunk.
  std::string Glb() const {
    nlohmann::json out = json;
    out["buffers"][0]["byteLength"] = bytes_.size();
    std::string text = out.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string binary(AsText(bytes_));
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const auto u32 = [](size_t v) {
      const auto value = static_cast<uint32_t>(v);
      return std::string(reinterpret_cast<const char*>(&value), 4);
    };
    std::string glb = "glTF" + u32(2) + u32(28 + text.size() + binary.size());
    glb += u32(text.size()) + "JSON" + text;
    glb += u32(binary.size()) + std::string("BIN\0", 4) + binary;
    return glb;
  }

 private:
  Bytes bytes_;
};

inline const ResourceLoader kNoFiles = [](const std::string&) { return std::optional<Bytes>(); };

inline ImportedFile ReadText(const std::string& text, const ImportLimits& limits = {}) {
  return ReadGltf("test.gltf", AsBytes(text), kNoFiles, limits);
}

}  // namespace airsim360::internal

// Mesh primitives: attributes, indices, triangles.
#include <algorithm>
#include <cmath>

#include "airsim360/assets/gltf/gltf_draco.h"
#include "airsim360/assets/gltf/gltf_parts.h"

namespace airsim360::internal {
namespace {

enum Mode : uint64_t { kTriangles = 4, kStrip = 5, kFan = 6 };

// The attributes of one primitive by name, wherever they come from.
class Attributes {
 public:
  Attributes(const JsonRef& primitive, uint64_t uv_set, GltfBuffers& buffers, const ImportLimits& limits)
      : json_(primitive.At("attributes")), buffers_(buffers) {
    const auto draco = GltfExtension(primitive, "KHR_draco_mesh_compression");
    if (!draco) return;
    const std::map<std::string, int> wanted = {
        {"POSITION", 3}, {"NORMAL", 3},    {"TEXCOORD_0", 2},           {"TEXCOORD_" + std::to_string(uv_set), 2},
        {"JOINTS_0", 4}, {"WEIGHTS_0", 4}, {"COLOR_0", ColorChannels()}};
    draco_ = DecodeDraco(buffers.View(draco->At("bufferView")), *draco, draco->At("attributes"), wanted, limits);
    buffers.Charge(draco_->indices.size() * 4 + draco_->vertices * uint64_t{64}, *draco);
  }

  bool Has(const std::string& name) const { return json_.Has(name); }
  const std::optional<DracoMesh>& draco() const { return draco_; }

  // `components` floats a vertex; empty if there is no such attribute. All must agree on the number of
  // vertices.
  std::vector<float> Read(const std::string& name, int components) {
    const auto index = json_.Find(name);
    if (!index) return {};
    std::vector<float> values;
    if (draco_ && draco_->attributes.contains(name)) {
      values = std::move(draco_->attributes[name]);
    } else {
      values = buffers_.Floats(*index, components);
    }
    const size_t count = values.size() / static_cast<size_t>(components);
    if (name == "POSITION") vertices_ = count;
    if (count != vertices_) index->Fail(std::to_string(count) + " elements for " + std::to_string(vertices_) + " vertices");
    return values;
  }
  const JsonRef& json() const { return json_; }
  /// 4 with coverage, else 3.
  int ColorChannels() const {
    const auto index = json_.Find("COLOR_0");
    return index && buffers_.Element("accessors", *index).At("type").Text() == "VEC4" ? 4 : 3;
  }

 private:
  JsonRef json_;
  GltfBuffers& buffers_;
  std::optional<DracoMesh> draco_;
  size_t vertices_ = 0;
};

std::vector<Vec3f> ToVec3(const std::vector<float>& values) {
  std::vector<Vec3f> out(values.size() / 3);
  for (size_t i = 0; i < out.size(); ++i) out[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return out;
}

// Linear colours with or without coverage.
std::vector<VertexColor> ReadColors(Attributes& attributes) {
  const auto stride = static_cast<size_t>(attributes.ColorChannels());
  const std::vector<float> values = attributes.Read("COLOR_0", static_cast<int>(stride));
  std::vector<VertexColor> colors;
  for (size_t i = 0; i + stride <= values.size(); i += stride) {
    colors.push_back(MakeVertexColor({values[i], values[i + 1], values[i + 2]}, stride == 4 ? values[i + 3] : 1.0f));
  }
  return colors;
}

// Morph targets at rest: p += weight * target.
void ApplyMorphs(const JsonRef& primitive, const std::vector<double>& weights, GltfBuffers& buffers, GltfPrimitive& out) {
  const auto targets = primitive.Find("targets");
  for (size_t i = 0; targets && i < std::min(targets->size(), weights.size()); ++i) {
    if (weights[i] == 0) continue;
    for (const char* name : {"POSITION", "NORMAL"}) {
      std::vector<Vec3f>& base = name[0] == 'P' ? out.positions : out.normals;
      const auto index = (*targets)[i].Find(name);
      if (!index || base.empty()) continue;
      const std::vector<Vec3f> delta = ToVec3(buffers.Floats(*index, 3));
      if (delta.size() != base.size())
        index->Fail(std::to_string(delta.size()) + " elements for " + std::to_string(base.size()) + " vertices");
      for (size_t k = 0; k < base.size(); ++k) base[k] += delta[k] * static_cast<float>(weights[i]);
    }
  }
}

std::vector<Vec3u> MakeTriangles(uint64_t mode, const std::vector<uint32_t>& indices) {
  std::vector<Vec3u> triangles;
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    if (a != b && b != c && c != a) triangles.push_back({a, b, c});
  };
  const size_t n = indices.size();
  if (mode == kTriangles) {
    for (size_t i = 0; i + 2 < n; i += 3) add(indices[i], indices[i + 1], indices[i + 2]);
  } else if (mode == kStrip) {
    for (size_t i = 0; i + 2 < n; ++i) add(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
  } else {
    for (size_t i = 0; i + 2 < n; ++i) add(indices[i + 1], indices[i + 2], indices[0]);
  }
  return triangles;
}

std::vector<uint32_t> ReadIndices(const JsonRef& primitive, Attributes& attributes, size_t vertices, GltfBuffers& buffers) {
  std::vector<uint32_t> indices;
  const auto index = primitive.Find("indices");
  if (attributes.draco()) {
    indices = attributes.draco()->indices;
  } else if (index) {
    indices = buffers.Uints(*index, 1);
  } else {
    for (uint32_t i = 0; i < vertices; ++i) indices.push_back(i);
  }
  for (size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= vertices) {
      (index ? *index : primitive)
          .Fail("element " + std::to_string(i) + " is vertex " + std::to_string(indices[i]) + " of " + std::to_string(vertices));
    }
  }
  return indices;
}

}  // namespace

void CheckPositions(const std::vector<Vec3f>& positions, const JsonRef& where) {
  for (size_t i = 0; i < positions.size(); ++i) {
    const Vec3f p = positions[i];
    // Written so that NaN fails too.
    if (!(std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate && std::abs(p.z) <= kMaxCoordinate)) {
      where.Fail("vertex " + std::to_string(i) + " is not finite or beyond 1e9");
    }
  }
}

std::optional<GltfPrimitive> ReadPrimitive(const JsonRef& json, uint64_t uv_set, const std::vector<double>& morph_weights,
                                           GltfBuffers& buffers, const ImportLimits& limits, Warnings& warnings) {
  const uint64_t mode = json.UintOr("mode", kTriangles);
  if (mode > kFan) json.At("mode").Fail("a mode from 0 to 6 expected");
  if (mode < kTriangles) {
    warnings.Add(json.file() + ": points and lines are left out");
    return std::nullopt;
  }
  Attributes attributes(json, uv_set, buffers, limits);
  if (!attributes.Has("POSITION")) {
    warnings.Add(json.file() + ": " + json.pointer() + ": has no positions: left out");
    return std::nullopt;
  }

  GltfPrimitive out;
  out.positions = ToVec3(attributes.Read("POSITION", 3));
  out.normals = ToVec3(attributes.Read("NORMAL", 3));
  const std::string uv_name = "TEXCOORD_" + std::to_string(uv_set);
  const std::vector<float> uvs = attributes.Read(attributes.Has(uv_name) ? uv_name : "TEXCOORD_0", 2);
  for (size_t i = 0; i + 1 < uvs.size(); i += 2) {
    const bool finite = std::isfinite(uvs[i]) && std::isfinite(uvs[i + 1]);
    out.uvs.push_back(finite ? Vec2f{uvs[i], uvs[i + 1]} : Vec2f{});
  }
  out.colors = ReadColors(attributes);
  out.joints = attributes.Read("JOINTS_0", 4);
  out.weights = attributes.Read("WEIGHTS_0", 4);
  ApplyMorphs(json, morph_weights, buffers, out);
  CheckPositions(out.positions, attributes.json().At("POSITION"));

  const std::vector<uint32_t> indices = ReadIndices(json, attributes, out.positions.size(), buffers);
  if (mode == kTriangles && indices.size() % 3 != 0) {
    warnings.Add(json.file() + ": " + json.pointer() + ": " + std::to_string(indices.size()) +
                 " corners are not whole triangles: the rest is left out");
  }
  out.triangles = MakeTriangles(mode, indices);
  return out;
}

}  // namespace airsim360::internal

#include "airsim360/assets/ply/ply.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "airsim360/assets/obj/obj_geometry.h"
#include "airsim360/assets/ply/ply_parts.h"
#include "airsim360/assets/textures/texture_store.h"
#include "airsim360/base/error.h"
#include "airsim360/base/text.h"
#include "airsim360/image/color.h"

namespace airsim360::internal {
namespace {

// What a property of a vertex is.
enum class Use { kNone, kX, kY, kZ, kNx, kNy, kNz, kU, kV, kRed, kGreen, kBlue };

Use UseOf(const std::string& name) {
  static const std::map<std::string, Use> kUses = {{"x", Use::kX},
                                                   {"y", Use::kY},
                                                   {"z", Use::kZ},
                                                   {"nx", Use::kNx},
                                                   {"ny", Use::kNy},
                                                   {"nz", Use::kNz},
                                                   {"u", Use::kU},
                                                   {"v", Use::kV},
                                                   {"s", Use::kU},
                                                   {"t", Use::kV},
                                                   {"texture_u", Use::kU},
                                                   {"texture_v", Use::kV},
                                                   {"s0", Use::kU},
                                                   {"t0", Use::kV},
                                                   {"red", Use::kRed},
                                                   {"green", Use::kGreen},
                                                   {"blue", Use::kBlue},
                                                   {"r", Use::kRed},
                                                   {"g", Use::kGreen},
                                                   {"b", Use::kBlue},
                                                   {"diffuse_red", Use::kRed},
                                                   {"diffuse_green", Use::kGreen},
                                                   {"diffuse_blue", Use::kBlue}};
  const auto it = kUses.find(name);
  return it == kUses.end() ? Use::kNone : it->second;
}

// sRGB of 0 … 1, whatever the type.
double ColorShare(double value, PlyType type) {
  const double full = type == PlyType::kUint8 ? 255 : type == PlyType::kUint16 ? 65535 : 1;
  return std::isfinite(value) ? std::clamp(value / full, 0.0, 1.0) : 0;
}

float ToLinear(double srgb) { return static_cast<float>(SrgbDecode(srgb)); }

class PlyReader {
 public:
  PlyReader(const std::string& file, std::span<const std::byte> bytes, const ResourceLoader& load, const ImportLimits& limits)
      : file_(file),
        load_(load),
        limits_(limits),
        header_(ReadPlyHeader(file, AsText(bytes))),
        values_(file, header_, bytes),
        textures_(file, limits, warnings_) {}
  ImportedFile Read();

 private:
  using Rgb = std::array<uint8_t, 3>;
  void CheckCount(const PlyElement& element);
  std::vector<double> ReadList(const PlyProperty& property);
  void ReadVertices(const PlyElement& element);
  void ReadFaces(const PlyElement& element);
  void ReadStrips(const PlyElement& element);
  void Skip(const PlyElement& element);
  void ReadVerticesAhead();
  void AddFace(const std::vector<double>& indices, const std::vector<double>& uvs, int texture, std::optional<Rgb> color);
  MaterialId MaterialFor(int texture, Rgb color);
  void CountTriangles(uint64_t count) {
    triangles_ += count;
    if (triangles_ > limits_.max_triangles) values_.Fail("more than " + std::to_string(limits_.max_triangles) + " triangles");
  }

  const std::string& file_;
  const ResourceLoader& load_;
  ImportLimits limits_;
  PlyHeader header_;
  PlyValues values_;
  Warnings warnings_;
  TextureStore textures_;
  ObjGeometry geometry_;
  bool vertex_uvs_ = false, vertex_normals_ = false;
  std::vector<ObjCorner> face_;
  uint64_t triangles_ = 0;
  const PlyElement* ahead_ = nullptr;  // vertices that were read before their turn
  std::map<std::pair<int, Rgb>, MaterialId> material_ids_;
  std::vector<Material> materials_;
};

// Every element takes bytes: no count may claim more than the file can hold.
void PlyReader::CheckCount(const PlyElement& element) {
  uint64_t least = 0;
  for (const PlyProperty& property : element.properties)
    least += values_.ascii() ? 2 : kPlyTypeBytes[static_cast<int>(property.count.value_or(property.type))];
  if (element.count > 0 && (least == 0 || element.count > (values_.left() + 1) / least)) {
    values_.Enter(element.name, element.count);
    values_.Fail("so many cannot stand in the " + std::to_string(values_.left()) + " bytes that are left");
  }
}

std::vector<double> PlyReader::ReadList(const PlyProperty& property) {
  const double length = values_.Next(*property.count);
  const double least = values_.ascii() ? 2 : static_cast<double>(kPlyTypeBytes[static_cast<int>(property.type)]);
  if (!(length >= 0) || length != std::floor(length) || length * least > static_cast<double>(values_.left() + 1))
    values_.Fail("a list of " + ShortestText(length) + " in " + std::to_string(values_.left()) + " bytes");
  std::vector<double> list(static_cast<size_t>(length));
  for (double& value : list) value = values_.Next(property.type);
  return list;
}

void PlyReader::ReadVertices(const PlyElement& element) {
  if (element.count > limits_.max_vertices) values_.Fail("more than " + std::to_string(limits_.max_vertices) + " vertices");
  std::vector<Use> uses;
  const auto has = [&](Use use) { return std::find(uses.begin(), uses.end(), use) != uses.end(); };
  for (const PlyProperty& property : element.properties) uses.push_back(property.count ? Use::kNone : UseOf(property.name));
  if (!has(Use::kX) || !has(Use::kY) || !has(Use::kZ)) values_.Fail("vertices have no x, y and z");
  vertex_normals_ = has(Use::kNx) && has(Use::kNy) && has(Use::kNz);
  vertex_uvs_ = has(Use::kU) && has(Use::kV);
  const bool colors = has(Use::kRed) && has(Use::kGreen) && has(Use::kBlue);
  for (uint64_t i = 0; i < element.count; ++i) {
    values_.Enter(element.name, i);
    std::array<double, 12> v{};
    for (size_t k = 0; k < uses.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (property.count) {
        ReadList(property);
        continue;
      }
      const double value = values_.Next(property.type);
      v[static_cast<size_t>(uses[k])] = uses[k] >= Use::kRed ? ColorShare(value, property.type) : value;
    }
    const auto at = [&](Use use) { return static_cast<float>(v[static_cast<size_t>(use)]); };
    const Vec3f p{at(Use::kX), at(Use::kY), at(Use::kZ)};
    for (int k = 0; k < 3; ++k) {
      if (!(std::abs(p[k]) <= kMaxCoordinate)) values_.Fail("a position that is not finite or beyond 1e9");
    }
    geometry_.positions.push_back(p);
    if (vertex_normals_) {
      const Vec3f n{at(Use::kNx), at(Use::kNy), at(Use::kNz)};
      geometry_.normals.push_back(std::isfinite(Dot(n, n)) ? n : Vec3f{});
    }
    if (vertex_uvs_) {
      const Vec2f uv{at(Use::kU), 1 - at(Use::kV)};
      geometry_.uvs.push_back(std::isfinite(uv.x) && std::isfinite(uv.y) ? uv : Vec2f{});
    }
    if (!colors) continue;
    const auto linear = [&](Use use) { return ToLinear(v[static_cast<size_t>(use)]); };
    geometry_.colors.push_back(MakeVertexColor({linear(Use::kRed), linear(Use::kGreen), linear(Use::kBlue)}));
  }
}

MaterialId PlyReader::MaterialFor(int texture, Rgb color) {
  // Colours of faces in eight steps a channel: as many surfaces at most.
  constexpr int kStep = 36;
  for (uint8_t& c : color) c = static_cast<uint8_t>((c + kStep / 2) / kStep * kStep + 3 * (c >= 255 - kStep / 2));
  const auto [it, is_new] = material_ids_.try_emplace({texture, color}, static_cast<MaterialId>(materials_.size()));
  if (!is_new) return it->second;
  Material material;
  material.base_color = {ToLinear(color[0] / 255.0), ToLinear(color[1] / 255.0), ToLinear(color[2] / 255.0)};
  if (texture >= 0 && static_cast<size_t>(texture) < header_.textures.size())
    material.base_color_texture = textures_.Get(header_.textures[static_cast<size_t>(texture)], {}, load_);
  materials_.push_back(material);
  return it->second;
}

void PlyReader::AddFace(const std::vector<double>& indices, const std::vector<double>& uvs, int texture, std::optional<Rgb> color) {
  face_.clear();
  for (size_t k = 0; k < indices.size(); ++k) {
    if (!(indices[k] >= 0 && indices[k] < static_cast<double>(geometry_.positions.size())))
      values_.Fail("there are only " + std::to_string(geometry_.positions.size()) + " vertices, not a number " + ShortestText(indices[k]));
    const auto i = static_cast<uint32_t>(indices[k]);
    ObjCorner corner{.position = i};
    if (vertex_normals_) corner.normal = i;
    if (uvs.size() == 2 * indices.size()) {
      corner.uv = static_cast<uint32_t>(geometry_.uvs.size());
      const Vec2f uv{static_cast<float>(uvs[2 * k]), static_cast<float>(1 - uvs[2 * k + 1])};
      geometry_.uvs.push_back(std::isfinite(uv.x) && std::isfinite(uv.y) ? uv : Vec2f{});
    } else if (vertex_uvs_) {
      corner.uv = i;
    }
    face_.push_back(corner);
  }
  if (face_.size() < 3) return;
  CountTriangles(face_.size() - 2);
  const bool textured = texture >= 0 && static_cast<size_t>(texture) < header_.textures.size();
  // Where vertices have colours those are the colour of the faces too.
  if (!geometry_.colors.empty()) color = Rgb{255, 255, 255};
  const uint8_t usual = textured ? 255 : 231;
  geometry_.AddFace(face_, MaterialFor(textured ? texture : -1, color.value_or(Rgb{usual, usual, usual})));
}

void PlyReader::ReadFaces(const PlyElement& element) {
  for (uint64_t i = 0; i < element.count; ++i) {
    values_.Enter(element.name, i);
    std::vector<double> indices, uvs;
    int texture = 0, channels = 0;
    Rgb color{};
    for (const PlyProperty& property : element.properties) {
      if (property.count) {
        std::vector<double> list = ReadList(property);
        if (property.name == "vertex_indices" || property.name == "vertex_index")
          indices = std::move(list);
        else if (property.name == "texcoord")
          uvs = std::move(list);
        continue;
      }
      const double value = values_.Next(property.type);
      const Use use = UseOf(property.name);
      if (property.name == "texnumber") texture = value >= 0 && value < 256 ? static_cast<int>(value) : -1;
      if (use < Use::kRed) continue;
      color[static_cast<size_t>(use) - static_cast<size_t>(Use::kRed)] =
          static_cast<uint8_t>(std::lround(ColorShare(value, property.type) * 255));
      ++channels;
    }
    AddFace(indices, uvs, texture, channels == 3 ? std::optional(color) : std::nullopt);
  }
}

// Each index makes a triangle with the two before it; -1 begins anew.
void PlyReader::ReadStrips(const PlyElement& element) {
  for (uint64_t i = 0; i < element.count; ++i) {
    values_.Enter(element.name, i);
    for (const PlyProperty& property : element.properties) {
      if (!property.count) {
        values_.Next(property.type);
        continue;
      }
      const std::vector<double> list = ReadList(property);
      if (property.name != "vertex_indices" && property.name != "vertex_index") continue;
      size_t begin = 0;
      for (size_t k = 0; k < list.size(); ++k) {
        if (list[k] < 0) begin = k + 1;
        if (list[k] < 0 || k < begin + 2) continue;
        const bool odd = (k - begin) % 2 != 0;
        AddFace({list[k - (odd ? 1 : 2)], list[k - (odd ? 2 : 1)], list[k]}, {}, 0, std::nullopt);
      }
    }
  }
}

void PlyReader::Skip(const PlyElement& element) {
  for (uint64_t i = 0; i < element.count; ++i) {
    values_.Enter(element.name, i);
    for (const PlyProperty& property : element.properties) {
      if (property.count)
        ReadList(property);
      else
        values_.Next(property.type);
    }
  }
}

// The vertices of a file in which faces stand before them; reading is then where it was.
void PlyReader::ReadVerticesAhead() {
  const auto vertices = std::ranges::find(header_.elements, "vertex", &PlyElement::name);
  const auto surface = [](const PlyElement& element) { return element.name == "face" || element.name == "tristrips"; };
  if (vertices == header_.elements.end() || std::none_of(header_.elements.begin(), vertices, surface)) return;
  const PlyValues::Mark begin = values_.mark();
  for (auto element = header_.elements.begin(); element != vertices; ++element) {
    CheckCount(*element);
    Skip(*element);
  }
  CheckCount(*vertices);
  values_.Enter(vertices->name, 0);
  ReadVertices(*vertices);
  values_.Return(begin);
  ahead_ = &*vertices;
}

ImportedFile PlyReader::Read() {
  static const std::string kHeader = "element";
  values_.Enter(kHeader, 0);
  geometry_.StartGroup({});
  ReadVerticesAhead();
  for (const PlyElement& element : header_.elements) {
    CheckCount(element);
    values_.Enter(element.name, 0);
    if (&element == ahead_) {
      Skip(element);
    } else if (element.name == "vertex") {
      if (!geometry_.positions.empty()) values_.Fail("a second list of vertices");
      ReadVertices(element);
    } else if (element.name == "face") {
      ReadFaces(element);
    } else if (element.name == "tristrips") {
      ReadStrips(element);
    } else {
      Skip(element);
    }
  }
  if (triangles_ == 0)
    throw InputError(file_ + ": " + std::to_string(geometry_.positions.size()) +
                     " points and no surface: a point cloud or Gaussian splats; make a mesh of it (MeshLab, CloudCompare)");
  ImportedFile out;
  out.meshes = geometry_.TakeMeshes();
  for (size_t i = 0; i < out.meshes.size(); ++i) out.nodes.push_back({"", -1, static_cast<int32_t>(i), {}});
  out.textures = textures_.Take();
  out.materials = std::move(materials_);
  out.warnings = warnings_.Take();
  return out;
}

}  // namespace

ImportedFile ReadPly(const std::string& file, std::span<const std::byte> bytes, const ResourceLoader& load, const ImportLimits& limits) {
  return PlyReader(file, bytes, load, limits).Read();
}

}  // namespace airsim360::internal

#include "airsim360/assets/obj/obj.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "airsim360/assets/axes.h"
#include "airsim360/assets/obj/obj_geometry.h"
#include "airsim360/assets/text_lines.h"
#include "airsim360/image/color.h"

namespace airsim360::internal {
namespace {

class ObjReader {
 public:
  ObjReader(const std::string& file, std::string_view text, const ResourceLoader& load, const ImportLimits& limits,
            const MtlContext& context)
      : lines_(file, text, true), load_(load), limits_(limits), context_(context), textures_(file, limits, warnings_) {}

  ImportedFile Read();

 private:
  void ReadStatement(std::string_view key, std::string_view rest);
  Vec3f ReadPosition(std::string_view& rest);
  void ReadColor(std::string_view rest);
  void ReadFace(std::string_view rest);
  ObjCorner ReadCorner(std::string_view word);
  // An index into a list that may still grow: some exporters refer to what comes later in the file.
  struct Forward {
    const char* what;
    int64_t largest = -1, line = 0;
  };
  uint32_t ReadIndex(std::string_view digits, size_t count, const char* what, Forward* forward = nullptr);
  void CheckForward(const Forward& forward, size_t count);
  void ReadLibraries(std::string_view rest);
  bool ReadLibrary(const std::string& name);
  MaterialId FindMaterial(const std::string& name);

  TextLines lines_;
  const ResourceLoader& load_;
  ImportLimits limits_;
  MtlContext context_;
  Warnings warnings_;
  TextureStore textures_;

  ObjGeometry geometry_;
  std::string object_;
  std::map<std::string, MtlMaterial> library_;
  std::map<std::string, MaterialId> material_ids_;
  std::vector<Material> materials_;
  std::string material_name_;
  uint64_t triangles_ = 0;
  Forward forward_uv_{"texture"}, forward_normal_{"normal"};
  int64_t beyond_line_ = 0;      // where a vertex colour first lay beyond [0, 1]
  std::vector<ObjCorner> face_;  // reused
};

MaterialId ObjReader::FindMaterial(const std::string& name) {
  const auto [it, is_new] = material_ids_.try_emplace(name, static_cast<MaterialId>(materials_.size()));
  if (!is_new) return it->second;
  const auto mtl = library_.find(name);
  if (mtl == library_.end() && !name.empty()) {
    warnings_.Add(lines_.file() + ":" + std::to_string(lines_.line_number()) + ": material '" + name + "' is in no MTL file: plain");
  }
  MtlMaterial plain;
  plain.name = name;
  materials_.push_back(ToMaterial(mtl == library_.end() ? plain : mtl->second, context_, textures_, load_));
  return it->second;
}

bool ObjReader::ReadLibrary(const std::string& name) {
  const std::optional<Bytes> bytes = load_(name);
  if (!bytes) return false;
  for (MtlMaterial& mtl : ParseMtl(CleanName(name), AsText(*bytes))) library_.try_emplace(mtl.name, std::move(mtl));
  return true;
}

void ObjReader::ReadLibraries(std::string_view rest) {
  // The whole rest may be one name with blanks; else it is several names.
  std::string all(rest);
  std::replace(all.begin(), all.end(), '\\', '/');
  const std::string where = lines_.file() + ":" + std::to_string(lines_.line_number());
  if (all.empty() || ReadLibrary(all)) return;
  std::string_view words = all;
  for (std::string_view word = NextWord(words); !word.empty(); word = NextWord(words)) {
    if (word.size() == all.size() || !ReadLibrary(std::string(word))) {
      warnings_.Add(where + ": material library '" + CleanName(word) + "' is missing: its materials are plain");
    }
  }
}

Vec3f ObjReader::ReadPosition(std::string_view& rest) {
  Vec3f p;
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = NextWord(rest);
    if (word.empty()) lines_.Fail("three numbers expected, " + std::to_string(i) + " found");
    p[i] = ParseFloat(word, lines_);
    if (std::abs(p[i]) > kMaxCoordinate) lines_.Fail(Quoted(word) + " is too large for a coordinate");
  }
  return p;
}

// Of the vertex just read: three more numbers, as MeshLab writes them. They are what its window shows, so sRGB.
// One or two more are the weights of curves.
void ObjReader::ReadColor(std::string_view rest) {
  std::string_view words[3];
  for (std::string_view& word : words) {
    word = NextWord(rest);
    if (word.empty() || word.front() == '#') return;
  }
  Vec3f linear;
  for (int i = 0; i < 3; ++i) {
    const float encoded = ParseFloat(words[i], lines_);
    if ((encoded < 0 || encoded > 1) && beyond_line_ == 0) beyond_line_ = lines_.line_number();
    linear[i] = static_cast<float>(SrgbDecode(std::clamp(encoded, 0.0f, 1.0f)));
  }
  geometry_.colors.resize(geometry_.positions.size() - 1);
  geometry_.colors.push_back(MakeVertexColor(linear));
}

uint32_t ObjReader::ReadIndex(std::string_view digits, size_t count, const char* what, Forward* forward) {
  int64_t index = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    lines_.Fail(Quoted(digits) + " is not a " + what + " index");
  }
  // 1 is the first, -1 the latest.
  const auto known = static_cast<int64_t>(count);
  if (forward && index > known && index < int64_t{ObjCorner::kAbsent}) {
    if (index > forward->largest) *forward = {what, index, lines_.line_number()};
    return static_cast<uint32_t>(index - 1);
  }
  if (index == 0 || index > known || index < -known) {
    lines_.Fail(std::string(what) + " index " + std::to_string(index) + " of " + std::to_string(count));
  }
  return static_cast<uint32_t>(index > 0 ? index - 1 : known + index);
}

void ObjReader::CheckForward(const Forward& forward, size_t count) {
  if (forward.largest <= static_cast<int64_t>(count)) return;
  throw InputError(lines_.file() + ":" + std::to_string(forward.line) + ": " + forward.what + " index " + std::to_string(forward.largest) +
                   " of " + std::to_string(count));
}

ObjCorner ObjReader::ReadCorner(std::string_view word) {
  const size_t first = std::min(word.find('/'), word.size());
  ObjCorner corner{ReadIndex(word.substr(0, first), geometry_.positions.size(), "vertex")};
  if (first == word.size()) return corner;
  word.remove_prefix(first + 1);
  const size_t second = std::min(word.find('/'), word.size());
  if (second > 0) corner.uv = ReadIndex(word.substr(0, second), geometry_.uvs.size(), "texture", &forward_uv_);
  if (second + 1 < word.size()) corner.normal = ReadIndex(word.substr(second + 1), geometry_.normals.size(), "normal", &forward_normal_);
  return corner;
}

void ObjReader::ReadFace(std::string_view rest) {
  face_.clear();
  for (std::string_view word = NextWord(rest); !word.empty() && word.front() != '#'; word = NextWord(rest)) {
    face_.push_back(ReadCorner(word));
  }
  if (face_.size() < 3) {
    warnings_.Add(lines_.file() + ":" + std::to_string(lines_.line_number()) + ": a face of " + std::to_string(face_.size()) +
                  " corners is left out");
    return;
  }
  triangles_ += face_.size() - 2;
  if (triangles_ > limits_.max_triangles) lines_.Fail("more than " + std::to_string(limits_.max_triangles) + " triangles");
  geometry_.AddFace(face_, FindMaterial(material_name_));
}

void ObjReader::ReadStatement(std::string_view key, std::string_view rest) {
  if (key == "v") {
    geometry_.positions.push_back(FromG(ReadPosition(rest)));
    ReadColor(rest);
    if (geometry_.positions.size() > limits_.max_vertices) lines_.Fail("more than " + std::to_string(limits_.max_vertices) + " vertices");
  } else if (key == "vn") {
    geometry_.normals.push_back(FromG(ReadPosition(rest)));
  } else if (key == "vt") {
    const float u = ParseFloat(NextWord(rest), lines_);
    const std::string_view word = NextWord(rest);
    const float v = word.empty() || word.front() == '#' ? 0 : ParseFloat(word, lines_);
    geometry_.uvs.push_back({u, 1 - v});
  } else if (key == "f" || key == "fo") {
    ReadFace(rest);
  } else if (key == "o") {
    object_ = CleanName(rest);
    geometry_.StartGroup(object_);
  } else if (key == "g") {
    const std::string name = CleanName(rest);
    geometry_.StartGroup(name.empty() || name == "default" || name == "off" ? object_ : name);
  } else if (key == "usemtl") {
    material_name_ = CleanName(rest);
  } else if (key == "mtllib") {
    ReadLibraries(rest);
  } else if (key == "l" || key == "p") {
    warnings_.Add(lines_.file() + ": lines and points are left out");
  } else if (key == "curv" || key == "curv2" || key == "surf") {
    warnings_.Add(lines_.file() + ": free-form curves and surfaces are left out");
  } else if (key.find_first_not_of("abcdefghijklmnopqrstuvwxyz_ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789") != std::string_view::npos) {
    lines_.Fail(Quoted(key) + " is not an OBJ statement");
  }
}

ImportedFile ObjReader::Read() {
  std::string_view line;
  while (lines_.Next(line)) {
    if (line.empty() || line.front() == '#') continue;
    if (line.find('\0') != std::string_view::npos) lines_.Fail("a zero byte: this is not a text file");
    const std::string_view key = NextWord(line);
    ReadStatement(key, Trimmed(line));
  }
  CheckForward(forward_uv_, geometry_.uvs.size());
  if (forward_normal_.largest > static_cast<int64_t>(geometry_.normals.size()))
    warnings_.Add(lines_.file() + ":" + std::to_string(forward_normal_.line) + ": normal index " + std::to_string(forward_normal_.largest) +
                  " of " + std::to_string(geometry_.normals.size()) + ": normals that are not there are computed");
  if (beyond_line_ != 0) {
    warnings_.Add(lines_.file() + ":" + std::to_string(beyond_line_) + ": vertex colours beyond 0 to 1 (here first) are clamped");
  }
  // Where colours are of the vertices alone, the plain grey would only darken them.
  if (!geometry_.colors.empty()) {
    for (Material& material : materials_) {
      if (!library_.contains(material.name)) material.base_color = {1, 1, 1};
    }
  }
  ImportedFile out;
  out.meshes = geometry_.TakeMeshes();
  for (size_t i = 0; i < out.meshes.size(); ++i) {
    out.nodes.push_back({out.meshes[i].name, -1, static_cast<int32_t>(i), {}});
  }
  out.textures = textures_.Take();
  out.materials = std::move(materials_);
  out.warnings = warnings_.Take();
  return out;
}

}  // namespace

ImportedFile ReadObj(const std::string& file, std::string_view text, const ResourceLoader& load, const ImportLimits& limits,
                     const MtlContext& context) {
  return ObjReader(file, text, load, limits, context).Read();
}

}  // namespace airsim360::internal

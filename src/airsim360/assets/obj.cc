#include "airsim360/assets/obj.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "airsim360/assets/axes.h"
#include "airsim360/assets/normals.h"
#include "airsim360/assets/polygon.h"
#include "airsim360/assets/text_lines.h"

namespace airsim360::internal {
namespace {

constexpr uint32_t kAbsent = UINT32_MAX;

// One corner of a face: indices into the file's position, uv and normal lists.
struct Corner {
  uint32_t position, uv = kAbsent, normal = kAbsent;
  auto operator<=>(const Corner&) const = default;
};

// The faces of one object or group, by material.
struct Group {
  std::string name;
  std::map<MaterialId, std::vector<Corner>> corners;  // three a triangle
};

class ObjReader {
 public:
  ObjReader(const std::string& file, std::string_view text, const ResourceLoader& load,
            const ImportLimits& limits, const MtlContext& context)
      : lines_(file, text, true),
        load_(load),
        limits_(limits),
        context_(context),
        textures_(file, limits, warnings_) {}

  ImportedFile Read();

 private:
  void ReadStatement(std::string_view key, std::string_view rest);
  Vec3f ReadPosition(std::string_view rest);
  void ReadFace(std::string_view rest);
  Corner ReadCorner(std::string_view word);
  // An index into a list that may still grow: some exporters refer to what comes later in the file.
  struct Forward {
    const char* what;
    int64_t largest = -1, line = 0;
  };
  uint32_t ReadIndex(std::string_view digits, size_t count, const char* what, Forward* forward = nullptr);
  void CheckForward(const Forward& forward, size_t count);
  void ReadLibraries(std::string_view rest);
  bool ReadLibrary(const std::string& name);
  void StartGroup(std::string name);
  Group& CurrentGroup();
  MaterialId FindMaterial(const std::string& name);
  Mesh MakeMesh(Group& group);

  TextLines lines_;
  const ResourceLoader& load_;
  ImportLimits limits_;
  MtlContext context_;
  Warnings warnings_;
  TextureStore textures_;

  std::vector<Vec3f> positions_, normals_;
  std::vector<Vec2f> uvs_;
  std::vector<Group> groups_;
  std::map<std::string, size_t> group_of_name_;
  std::string object_;
  size_t group_ = SIZE_MAX;
  std::map<std::string, MtlMaterial> library_;
  std::map<std::string, MaterialId> material_ids_;
  std::vector<Material> materials_;
  std::string material_name_;
  uint64_t triangles_ = 0;
  Forward forward_uv_{"texture"}, forward_normal_{"normal"};
  std::vector<Corner> face_;           // reused
  std::vector<Vec3f> face_positions_;  // reused
};

void ObjReader::StartGroup(std::string name) {
  // A named group may be continued later in the file; nameless ones are each their own.
  const auto known = group_of_name_.find(name);
  if (!name.empty() && known != group_of_name_.end()) {
    group_ = known->second;
    return;
  }
  if (group_ != SIZE_MAX && groups_[group_].corners.empty()) {
    group_of_name_.erase(groups_[group_].name);
  } else {
    group_ = groups_.size();
    groups_.emplace_back();
  }
  if (!name.empty()) group_of_name_[name] = group_;
  groups_[group_].name = std::move(name);
}

Group& ObjReader::CurrentGroup() {
  if (group_ == SIZE_MAX) StartGroup({});
  return groups_[group_];
}

MaterialId ObjReader::FindMaterial(const std::string& name) {
  const auto [it, is_new] = material_ids_.try_emplace(name, static_cast<MaterialId>(materials_.size()));
  if (!is_new) return it->second;
  const auto mtl = library_.find(name);
  if (mtl == library_.end() && !name.empty()) {
    warnings_.Add(lines_.file() + ":" + std::to_string(lines_.line_number()) + ": material '" + name +
                  "' is in no MTL file: plain grey");
  }
  MtlMaterial plain;
  plain.name = name;
  materials_.push_back(ToMaterial(mtl == library_.end() ? plain : mtl->second, context_, textures_, load_));
  return it->second;
}

bool ObjReader::ReadLibrary(const std::string& name) {
  const std::optional<Bytes> bytes = load_(name);
  if (!bytes) return false;
  for (MtlMaterial& mtl : ParseMtl(CleanName(name), AsText(*bytes)))
    library_.try_emplace(mtl.name, std::move(mtl));
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
      warnings_.Add(where + ": material library '" + CleanName(word) +
                    "' is missing: its materials are plain");
    }
  }
}

Vec3f ObjReader::ReadPosition(std::string_view rest) {
  Vec3f p;
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = NextWord(rest);
    if (word.empty()) lines_.Fail("three numbers expected, " + std::to_string(i) + " found");
    p[i] = ParseFloat(word, lines_);
    if (std::abs(p[i]) > kMaxCoordinate) lines_.Fail(Quoted(word) + " is too large for a coordinate");
  }
  return p;
}

uint32_t ObjReader::ReadIndex(std::string_view digits, size_t count, const char* what, Forward* forward) {
  int64_t index = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    lines_.Fail(Quoted(digits) + " is not a " + what + " index");
  }
  // 1 is the first, -1 the latest.
  const auto known = static_cast<int64_t>(count);
  if (forward && index > known && index < int64_t{kAbsent}) {
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
  throw InputError(lines_.file() + ":" + std::to_string(forward.line) + ": " + forward.what + " index " +
                   std::to_string(forward.largest) + " of " + std::to_string(count));
}

Corner ObjReader::ReadCorner(std::string_view word) {
  const size_t first = std::min(word.find('/'), word.size());
  Corner corner{ReadIndex(word.substr(0, first), positions_.size(), "vertex")};
  if (first == word.size()) return corner;
  word.remove_prefix(first + 1);
  const size_t second = std::min(word.find('/'), word.size());
  if (second > 0) corner.uv = ReadIndex(word.substr(0, second), uvs_.size(), "texture", &forward_uv_);
  if (second + 1 < word.size())
    corner.normal = ReadIndex(word.substr(second + 1), normals_.size(), "normal", &forward_normal_);
  return corner;
}

void ObjReader::ReadFace(std::string_view rest) {
  face_.clear();
  face_positions_.clear();
  for (std::string_view word = NextWord(rest); !word.empty() && word.front() != '#'; word = NextWord(rest)) {
    face_.push_back(ReadCorner(word));
    face_positions_.push_back(positions_[face_.back().position]);
  }
  if (face_.size() < 3) {
    warnings_.Add(lines_.file() + ":" + std::to_string(lines_.line_number()) + ": a face of " +
                  std::to_string(face_.size()) + " corners is left out");
    return;
  }
  triangles_ += face_.size() - 2;
  if (triangles_ > limits_.max_triangles)
    lines_.Fail("more than " + std::to_string(limits_.max_triangles) + " triangles");

  std::vector<Corner>& corners = CurrentGroup().corners[FindMaterial(material_name_)];
  for (Vec3u t : TriangulateFace(face_positions_)) {
    // Triangles without area in indices say nothing.
    const Corner abc[3] = {face_[t.x], face_[t.y], face_[t.z]};
    if (abc[0].position == abc[1].position || abc[1].position == abc[2].position ||
        abc[2].position == abc[0].position)
      continue;
    corners.insert(corners.end(), abc, abc + 3);
  }
}

void ObjReader::ReadStatement(std::string_view key, std::string_view rest) {
  if (key == "v") {
    positions_.push_back(FromG(ReadPosition(rest)));
    if (positions_.size() > limits_.max_vertices)
      lines_.Fail("more than " + std::to_string(limits_.max_vertices) + " vertices");
  } else if (key == "vn") {
    normals_.push_back(FromG(ReadPosition(rest)));
  } else if (key == "vt") {
    const float u = ParseFloat(NextWord(rest), lines_);
    const std::string_view word = NextWord(rest);
    const float v = word.empty() || word.front() == '#' ? 0 : ParseFloat(word, lines_);
    uvs_.push_back({u, 1 - v});
  } else if (key == "f" || key == "fo") {
    ReadFace(rest);
  } else if (key == "o") {
    object_ = CleanName(rest);
    StartGroup(object_);
  } else if (key == "g") {
    const std::string name = CleanName(rest);
    StartGroup(name.empty() || name == "default" || name == "off" ? object_ : name);
  } else if (key == "usemtl") {
    material_name_ = CleanName(rest);
  } else if (key == "mtllib") {
    ReadLibraries(rest);
  } else if (key == "l" || key == "p") {
    warnings_.Add(lines_.file() + ": lines and points are left out");
  } else if (key == "curv" || key == "curv2" || key == "surf") {
    warnings_.Add(lines_.file() + ": free-form curves and surfaces are left out");
  } else if (key.find_first_not_of("abcdefghijklmnopqrstuvwxyz_ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789") !=
             std::string_view::npos) {
    lines_.Fail(Quoted(key) + " is not an OBJ statement");
  }
}

Mesh ObjReader::MakeMesh(Group& group) {
  Mesh mesh;
  mesh.name = group.name;

  // Vertices are the distinct corners, in sorted order.
  std::vector<Corner> all;
  for (const auto& [material, corners] : group.corners) all.insert(all.end(), corners.begin(), corners.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  const bool any_uv = std::any_of(all.begin(), all.end(), [](const Corner& c) { return c.uv != kAbsent; });
  for (const Corner& c : all) {
    mesh.positions.push_back(positions_[c.position]);
    mesh.normals.push_back(c.normal == kAbsent ? Vec3f{} : normals_[c.normal]);
    if (any_uv) mesh.uvs.push_back(c.uv == kAbsent ? Vec2f{} : uvs_[c.uv]);
  }

  // One part a material.
  const auto vertex = [&](const Corner& c) {
    return static_cast<uint32_t>(std::lower_bound(all.begin(), all.end(), c) - all.begin());
  };
  for (const auto& [material, corners] : group.corners) {
    if (corners.empty()) continue;
    mesh.parts.push_back({static_cast<uint32_t>(mesh.triangles.size()),
                          static_cast<uint32_t>(corners.size() / 3), material, kNoEntity});
    for (size_t i = 0; i < corners.size(); i += 3) {
      mesh.triangles.push_back({vertex(corners[i]), vertex(corners[i + 1]), vertex(corners[i + 2])});
    }
  }
  group.corners.clear();
  FillMissingNormals(mesh);
  return mesh;
}

ImportedFile ObjReader::Read() {
  std::string_view line;
  while (lines_.Next(line)) {
    if (line.empty() || line.front() == '#') continue;
    if (line.find('\0') != std::string_view::npos) lines_.Fail("a zero byte: this is not a text file");
    const std::string_view key = NextWord(line);
    ReadStatement(key, Trimmed(line));
  }
  CheckForward(forward_uv_, uvs_.size());
  CheckForward(forward_normal_, normals_.size());
  ImportedFile out;
  for (Group& group : groups_) {
    Mesh mesh = MakeMesh(group);
    if (mesh.triangles.empty()) continue;
    out.nodes.push_back({mesh.name, -1, static_cast<int32_t>(out.meshes.size()), {}});
    out.meshes.push_back(std::move(mesh));
  }
  out.textures = textures_.Take();
  out.materials = std::move(materials_);
  out.warnings = warnings_.Take();
  return out;
}

}  // namespace

ImportedFile ReadObj(const std::string& file, std::string_view text, const ResourceLoader& load,
                     const ImportLimits& limits, const MtlContext& context) {
  return ObjReader(file, text, load, limits, context).Read();
}

}  // namespace airsim360::internal

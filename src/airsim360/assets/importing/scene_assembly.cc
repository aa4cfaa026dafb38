#include "airsim360/assets/importing/scene_assembly.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "airsim360/assets/baked_light.h"
#include "airsim360/assets/labels/labelling.h"
#include "airsim360/assets/limits.h"
#include "airsim360/assets/viewpoint.h"
#include "airsim360/base/error.h"
#include "airsim360/base/log.h"

namespace airsim360::internal {
namespace {

constexpr const char* kNothingKnown = "object";  // category of what no name tells of

// Only the given parts of a mesh, with the vertices they use.
Mesh ExtractParts(const Mesh& mesh, const std::vector<uint32_t>& parts) {
  constexpr uint32_t kUnused = UINT32_MAX;
  Mesh out;
  out.name = mesh.name;
  std::vector<uint32_t> moved(mesh.positions.size(), kUnused);
  const auto vertex = [&](uint32_t i) {
    if (moved[i] != kUnused) return moved[i];
    moved[i] = static_cast<uint32_t>(out.positions.size());
    out.positions.push_back(mesh.positions[i]);
    if (!mesh.normals.empty()) out.normals.push_back(mesh.normals[i]);
    if (!mesh.uvs.empty()) out.uvs.push_back(mesh.uvs[i]);
    if (!mesh.colors.empty()) out.colors.push_back(mesh.colors[i]);
    return moved[i];
  };
  for (uint32_t index : parts) {
    MeshPart part = mesh.parts[index];
    const auto first = static_cast<uint32_t>(out.triangles.size());
    for (uint32_t i = 0; i < part.triangle_count; ++i) {
      const Vec3u t = mesh.triangles[part.first_triangle + i];
      const Vec3u triangle{vertex(t.x), vertex(t.y), vertex(t.z)};
      out.triangles.push_back(triangle);
    }
    part.first_triangle = first;
    out.parts.push_back(part);
  }
  return out;
}

class Assembler {
 public:
  Assembler(ImportedFile file, const LabelRules& rules, const std::string& title, const std::string& where, std::optional<bool> baked)
      : file_(std::move(file)), rules_(rules), title_(title), where_(where), baked_(baked), builder_(title) {}

  std::shared_ptr<const Scene> Assemble() {
    const std::vector<std::vector<PartLabel>> labels = LabelNodes(file_, rules_, title_);
    for (const std::string& warning : UnusedRules(file_, rules_, labels)) LogWarning(warning);
    if (baked_ && file_.written)
      throw InputError(where_ + ": light: " + (*baked_ ? "baked" : "lit") +
                       ": a world written by world export keeps its own light; leave light out");
    if (!baked_ && !file_.written) GuessLight();
    for (Texture& texture : file_.textures) builder_.AddTexture(std::move(texture));
    for (size_t i = 0; i < file_.materials.size(); ++i) builder_.AddMaterial(file_.materials[i]);
    for (size_t i : InOrderOfEntities()) AddNode(file_.nodes[i], labels[i]);
    if (instances_.empty()) throw InputError(where_ + ": has no triangles to show");
    AddUnseen(UINT64_MAX);
    SetSurroundings();
    for (Mesh& mesh : meshes_) builder_.AddMesh(std::move(mesh));
    std::stable_sort(instances_.begin(), instances_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& numbered : instances_) builder_.AddInstance(numbered.second);
    return builder_.Build();
  }

 private:
  void GuessLight() {
    // What a name other than the file's says; of many nodes some have one.
    constexpr size_t kMostOfScan = 2000;
    bool named = file_.nodes.size() > kMostOfScan;
    if (!named) {
      const std::vector<std::vector<PartLabel>> labels = LabelNodes(file_, {}, "");
      for (size_t i = 0; i < labels.size(); ++i)
        named |=
            !file_.nodes[i].added && std::ranges::any_of(labels[i], [](const PartLabel& label) { return label.category != kNothingKnown; });
    }
    const std::string why = WhyBaked(file_, named);
    baked_ = !why.empty();
    if (*baked_)
      LogWarning(where_ + ": " + why + ": its colours are shown as they are, without sun and sky (light: lit in a world file lights them)");
  }

  // Nodes that show something: those of an exported world by their entities' numbers, then the others.
  std::vector<size_t> InOrderOfEntities() const {
    std::vector<size_t> order;
    for (size_t i = 0; i < file_.nodes.size(); ++i) {
      if (file_.nodes[i].mesh >= 0) order.push_back(i);
    }
    const auto place = [&](size_t i) {
      const ImportedNode& node = file_.nodes[i];
      return file_.written && node.entity != 0 && node.copy == 0 ? node.entity : UINT64_MAX;
    };
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return place(a) < place(b); });
    return order;
  }

  // The entities of an exported world that nothing shows and that come before number `before`.
  void AddUnseen(uint64_t before) {
    if (!file_.written) return;
    for (; unseen_ < file_.written->unseen.size() && file_.written->unseen[unseen_].id < before; ++unseen_) {
      const WrittenWorld::Unseen& entity = file_.written->unseen[unseen_];
      if (entity.sky)
        builder_.AddSky();
      else
        builder_.AddEntity(entity.name, CategoryFor({entity.category, -1}));
    }
  }

  // Sky, light, viewpoint and credits: those of the exported world, else usual ones.
  void SetSurroundings() {
    if (const auto& written = file_.written) {
      builder_.environment() = written->environment;
      builder_.SetInteriorLight(written->interior_light);
      if (written->spawn) builder_.SetSpawn(*written->spawn, written->spawn_yaw_deg);
      for (const std::string& line : written->attributions) builder_.AddAttribution(line);
      return;
    }
    std::vector<Instance> instances;
    for (const auto& numbered : instances_) instances.push_back(numbered.second);
    builder_.SetSpawn(ChooseViewpoint(meshes_, instances, bounds_));
    builder_.AddSky();
    if (baked_ && *baked_) builder_.SetInteriorLight(LightOfBakedRooms());
    if (!file_.copyright.empty()) builder_.AddAttribution(title_ + ", " + file_.copyright);
  }

  void AddNode(const ImportedNode& node, const std::vector<PartLabel>& labels) {
    if (!IsVisible(node)) return;
    if (node.entity != 0 && node.copy == 0) AddUnseen(node.entity);
    std::map<PartLabel, std::vector<uint32_t>> groups;
    for (uint32_t i = 0; i < labels.size(); ++i) groups[labels[i]].push_back(i);
    for (const auto& [label, parts] : groups) {
      Instance instance;
      instance.mesh = MeshFor(static_cast<uint32_t>(node.mesh), parts);
      instance.X_WM = node.X_WM;
      instance.entity = EntityFor(node, label, parts, groups.size() > 1);
      instance.tint = node.tint;
      instance.glow = node.glow;
      instances_.emplace_back(node.number == 0 ? UINT64_MAX : node.number, instance);
    }
  }

  // Flat or not finite transforms show nothing; coordinates out of bounds are an error.
  bool IsVisible(const ImportedNode& node) {
    const Box3f& box = BoundsOf(static_cast<uint32_t>(node.mesh));
    const float volume = std::abs(node.X_WM.A.determinant());
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3f p =
          node.X_WM * Vec3f{corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y, corner & 4 ? box.max.z : box.min.z};
      if (!(std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate && std::abs(p.z) <= kMaxCoordinate)) {
        throw InputError(where_ + ": node " + Quoted(node.name) + ": placed beyond 1e9 m or not finite");
      }
      if (volume > 1e-30f) bounds_.Add(p);
    }
    return volume > 1e-30f;
  }

  const Box3f& BoundsOf(uint32_t mesh) {
    const auto [it, is_new] = boxes_.try_emplace(mesh);
    if (is_new) it->second = MeshAt(mesh).Bounds();
    return it->second;
  }

  // Meshes are shared by all nodes that show the same parts of them.
  MeshId MeshFor(uint32_t mesh, const std::vector<uint32_t>& parts) {
    const auto [it, is_new] = mesh_ids_.try_emplace({mesh, parts}, static_cast<MeshId>(meshes_.size()));
    if (is_new) {
      const bool whole = parts.size() == MeshAt(mesh).parts.size();
      meshes_.push_back(whole ? std::move(file_.meshes[mesh]) : ExtractParts(MeshAt(mesh), parts));
      if (whole) moved_[mesh] = it->second;
    }
    return it->second;
  }

  // A mesh of the file, wherever it is by now.
  const Mesh& MeshAt(uint32_t mesh) const {
    const auto it = moved_.find(mesh);
    return it == moved_.end() ? file_.meshes[mesh] : meshes_[it->second];
  }

  EntityId EntityFor(const ImportedNode& node, const PartLabel& label, const std::vector<uint32_t>& parts, bool is_split) {
    const LabelRule* rule = label.rule < 0 ? nullptr : &rules_.rules[static_cast<size_t>(label.rule)];
    const Mesh& mesh = MeshAt(static_cast<uint32_t>(node.mesh));
    std::string name = !node.name.empty() ? node.name : !mesh.name.empty() ? mesh.name : title_;
    if (is_split && !file_.materials[mesh.parts[parts[0]].material].name.empty())
      name += " " + file_.materials[mesh.parts[parts[0]].material].name;
    if (rule && !rule->name.empty()) name = rule->name;
    if (!rule && node.entity != 0) {
      const auto [it, is_new] = numbered_.try_emplace({node.entity, node.copy, label}, kNoEntity);
      if (is_new) it->second = builder_.AddEntity(name, CategoryFor(label));
      return it->second;
    }
    if (!rule || !rule->merge) return builder_.AddEntity(name, CategoryFor(label));

    // Merged: one entity for the rule and category.
    const auto [it, is_new] = merged_.try_emplace(label, kNoEntity);
    if (is_new) {
      if (rule->name.empty()) name = label.category.substr(label.category.rfind('/') + 1);
      it->second = builder_.AddEntity(name, CategoryFor(label));
    }
    return it->second;
  }

  CategoryId CategoryFor(const PartLabel& label) {
    const auto [it, is_new] = categories_.try_emplace(label.category, kVoid);
    if (!is_new) return it->second;
    SemanticTree& tree = builder_.tree();
    if (const auto known = tree.Find(label.category)) return it->second = *known;

    // New: like its nearest known ancestor a thing or stuff.
    bool thing = true;
    for (size_t slash = label.category.rfind('/'); slash != std::string::npos && slash > 0; slash = label.category.rfind('/', slash - 1)) {
      if (const auto ancestor = tree.Find(std::string_view(label.category).substr(0, slash))) {
        thing = tree[*ancestor].thing;
        break;
      }
    }
    try {
      return it->second = tree.Add(label.category, thing);
    } catch (const InputError& error) {
      const int line = label.rule >= 0 ? rules_.rules[static_cast<size_t>(label.rule)].line : rules_.otherwise_line;
      throw InputError((line > 0 ? rules_.file + ":" + std::to_string(line) : where_) + ": " + error.what());
    }
  }

  ImportedFile file_;
  const LabelRules& rules_;
  std::string title_, where_;
  std::optional<bool> baked_;
  SceneBuilder builder_;
  std::vector<Mesh> meshes_;
  std::vector<std::pair<uint64_t, Instance>> instances_;  // with their places
  size_t unseen_ = 0;
  Box3f bounds_;
  std::map<uint32_t, Box3f> boxes_;
  std::map<std::pair<uint32_t, std::vector<uint32_t>>, MeshId> mesh_ids_;
  std::map<uint32_t, MeshId> moved_;  // meshes of the file that went over whole
  std::map<PartLabel, EntityId> merged_;
  std::map<std::tuple<uint64_t, uint64_t, PartLabel>, EntityId> numbered_;  // by the file's own numbers
  std::map<std::string, CategoryId> categories_;
};

}  // namespace

std::shared_ptr<const Scene> AssembleScene(ImportedFile file, const LabelRules& rules, const std::string& title, const std::string& where,
                                           std::optional<bool> baked) {
  return Assembler(std::move(file), rules, title, where, baked).Assemble();
}

}  // namespace airsim360::internal

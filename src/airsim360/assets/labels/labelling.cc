#include "airsim360/assets/labels/labelling.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include "airsim360/assets/labels/labels.h"

namespace airsim360::internal {
namespace {

// What the keywords say about the nodes of one file.
class Keywords {
 public:
  Keywords(const ImportedFile& file, const std::string& title) : file_(file) {
    nodes_.resize(file.nodes.size());
    owners_.resize(file.nodes.size());
    std::map<std::string_view, int> found;  // categories of whole things, nodes of each
    for (size_t i = 0; i < file.nodes.size(); ++i) {
      const ImportedNode& node = file.nodes[i];
      nodes_[i] = Lookup(node.name, NameKind::kNode);
      if (!nodes_[i] && node.mesh >= 0) nodes_[i] = Lookup(file.meshes[static_cast<size_t>(node.mesh)].name, NameKind::kNode);
      if (nodes_[i] && !nodes_[i]->part) ++found[nodes_[i]->category];
      if (nodes_[i] && nodes_[i]->part && nodes_[i]->category == kVehicle) ++vehicle_parts_;

      // The nearest ancestor that is something whole; parents come before their children.
      if (node.parent < 0) continue;
      const auto parent = static_cast<size_t>(node.parent);
      owners_[i] = nodes_[parent] && !nodes_[parent]->part ? nodes_[parent]->category : owners_[parent];
    }
    for (const Material& material : file.materials) materials_.push_back(Lookup(material.name, NameKind::kMaterial));
    SetWhole(title, found);
  }

  // Labels of the parts of a node's mesh; "" where nothing is known.
  std::vector<std::string> Label(size_t node) {
    const Mesh& mesh = file_.meshes[static_cast<size_t>(file_.nodes[node].mesh)];
    const std::string_view owner = owners_[node].empty() ? whole_ : owners_[node];
    std::string_view own;
    if (nodes_[node]) {
      const std::string_view part_of = owner.empty() ? only_ : owner;
      own = nodes_[node]->part ? CategoryOfPart(nodes_[node]->category, part_of) : nodes_[node]->category;
      // One engine or wheel alone makes no vehicle.
      if (own == kVehicle && vehicle_parts_ < 2) own = {};
    }
    if (own.empty()) own = owners_[node];
    if (!own.empty()) return std::vector<std::string>(mesh.parts.size(), std::string(own));
    return LabelByMaterials(mesh, owner);
  }

 private:
  static constexpr std::string_view kVehicle = "vehicle";

  std::optional<KeywordMatch> Lookup(const std::string& name, NameKind kind) {
    const auto [it, is_new] = cache_.try_emplace({name, kind});
    if (is_new) it->second = FindKeyword(name, kind);
    return it->second;
  }

  // The file's name speaks for all that is nameless, unless most of the named things are of other kinds.
  // Without it, parts belong to the one kind of whole thing that most of the named are, vehicles only where parts
  // of vehicles are among them.
  void SetWhole(const std::string& title, const std::map<std::string_view, int>& found) {
    const std::optional<KeywordMatch> named = FindKeyword(title, NameKind::kFile);
    if (named && !named->part && CanNameAFile(named->category)) {
      int same = 0, all = 0;
      for (const auto& [category, nodes] : found) {
        all += nodes;
        if (RootOf(category) == RootOf(named->category)) same += nodes;
      }
      if (2 * same >= all) whole_ = named->category;
    }
    int all = 0;
    for (const auto& entry : found) all += entry.second;
    for (const auto& [category, nodes] : found) {
      const bool most = found.size() == 1 || (3 * nodes >= 2 * all && RootOf(category) == kVehicle && vehicle_parts_ > 0);
      if (whole_.empty() && most) only_ = category;
    }
    if (whole_.empty() && found.empty() && vehicle_parts_ > 1) only_ = kVehicle;
  }

  static bool CanNameAFile(std::string_view category) {
    const std::string_view root = RootOf(category);
    return category != "furniture/box" && root != "ground" && root != "water" && root != "nature" && root != "sky";
  }

  // One mesh for many things: materials that name grounds, plants, waters or buildings each make one; the
  // others go with the largest of them.
  std::vector<std::string> LabelByMaterials(const Mesh& mesh, std::string_view owner) {
    std::vector<std::string> labels(mesh.parts.size());
    std::map<std::string_view, uint64_t> triangles;
    for (size_t i = 0; i < mesh.parts.size(); ++i) {
      const auto& match = materials_[mesh.parts[i].material];
      if (!match) continue;
      const std::string_view category = match->part ? CategoryOfPart(match->category, owner) : match->category;
      labels[i] = category;
      triangles[category] += mesh.parts[i].triangle_count;
    }
    std::string_view fallback = owner;
    const auto largest =
        std::max_element(triangles.begin(), triangles.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    if (fallback.empty() && largest != triangles.end()) fallback = largest->first;

    const auto splits = [](std::string_view category) {
      const std::string_view root = RootOf(category);
      return root == "ground" || root == "vegetation" || root == "water" || root == "nature" || root == "construction";
    };
    for (std::string& label : labels) {
      const bool keep = !label.empty() && (owner.empty() || RootOf(label) == RootOf(owner)) && splits(label);
      if (!keep) label = fallback;
    }
    return labels;
  }

  const ImportedFile& file_;
  std::map<std::pair<std::string, NameKind>, std::optional<KeywordMatch>> cache_;
  std::vector<std::optional<KeywordMatch>> nodes_, materials_;
  std::vector<std::string_view> owners_;
  std::string_view whole_, only_;
  int vehicle_parts_ = 0;
};

int FindRule(const LabelRules& rules, std::string_view node, std::string_view mesh, std::string_view material) {
  for (size_t i = 0; i < rules.rules.size(); ++i) {
    if (Matches(rules.rules[i], node, mesh, material)) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

std::vector<std::string> UnusedRules(const ImportedFile& file, const LabelRules& rules, const std::vector<std::vector<PartLabel>>& labels) {
  std::vector<bool> used(rules.rules.size());
  for (const auto& parts : labels) {
    for (const PartLabel& label : parts) {
      if (label.rule >= 0) used[static_cast<size_t>(label.rule)] = true;
    }
  }
  Warnings warnings;
  for (size_t i = 0; i < used.size(); ++i) {
    if (used[i]) continue;
    const bool any = std::any_of(file.nodes.begin(), file.nodes.end(), [&](const ImportedNode& node) {
      if (node.mesh < 0) return false;
      const Mesh& mesh = file.meshes[static_cast<size_t>(node.mesh)];
      return std::any_of(mesh.parts.begin(), mesh.parts.end(), [&](const MeshPart& part) {
        return Matches(rules.rules[i], node.name, mesh.name, file.materials[part.material].name);
      });
    });
    warnings.Add(UnusedRule(rules, i, any));
  }
  return warnings.Take();
}

std::vector<std::vector<PartLabel>> LabelNodes(const ImportedFile& file, const LabelRules& rules, const std::string& title) {
  const std::string otherwise = rules.otherwise.empty() ? "object" : rules.otherwise;
  Keywords keywords(file, title);
  std::vector<std::vector<PartLabel>> out(file.nodes.size());
  for (size_t i = 0; i < file.nodes.size(); ++i) {
    if (file.nodes[i].mesh < 0) continue;
    const Mesh& mesh = file.meshes[static_cast<size_t>(file.nodes[i].mesh)];
    std::vector<std::string> categories(mesh.parts.size());
    if (rules.keywords) categories = keywords.Label(i);
    for (size_t k = 0; k < mesh.parts.size(); ++k) {
      // A rule wins, then what the file itself says, then the keywords.
      PartLabel label{categories[k].empty() ? otherwise : categories[k], -1};
      if (!file.nodes[i].category.empty()) label.category = file.nodes[i].category;
      label.rule = FindRule(rules, file.nodes[i].name, mesh.name, file.materials[mesh.parts[k].material].name);
      if (label.rule >= 0 && !rules.rules[static_cast<size_t>(label.rule)].category.empty()) {
        label.category = rules.rules[static_cast<size_t>(label.rule)].category;
      }
      out[i].push_back(std::move(label));
    }
  }
  return out;
}

}  // namespace airsim360::internal

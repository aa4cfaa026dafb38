#include "airsim360/assets/gltf/gltf.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "airsim360/assets/gltf/gltf_extras.h"
#include "airsim360/assets/gltf/gltf_parts.h"
#include "airsim360/assets/gltf/written_world.h"

namespace airsim360::internal {
namespace {

// Extensions that a file may require: those that are read, and those that only refine how things look or are
// described.
bool IsKnownExtension(const std::string& name) {
  static const std::set<std::string, std::less<>> kKnown = {"KHR_draco_mesh_compression",
                                                            "EXT_meshopt_compression",
                                                            "KHR_meshopt_compression",
                                                            "KHR_mesh_quantization",
                                                            "KHR_texture_transform",
                                                            "EXT_texture_webp",
                                                            "KHR_texture_basisu",
                                                            "KHR_texture_ktx",
                                                            "EXT_mesh_gpu_instancing",
                                                            "KHR_lights_punctual",
                                                            "EXT_mesh_features",
                                                            "EXT_structural_metadata",
                                                            "EXT_instance_features",
                                                            "KHR_xmp_json_ld",
                                                            "CESIUM_primitive_outline",
                                                            "KHR_technique_webgl",
                                                            "KHR_techniques_webgl",
                                                            "KHR_animation_pointer",
                                                            "KHR_node_visibility",
                                                            "EXT_lights_image_based",
                                                            "KHR_xmp",
                                                            "CESIUM_RTC"};
  return kKnown.contains(name) || name.starts_with("KHR_materials_");
}

class GltfReader {
 public:
  GltfReader(const JsonRef& root, std::span<const std::byte> binary, const ResourceLoader& load, const ImportLimits& limits)
      : root_(root),
        limits_(limits),
        buffers_(root, binary, load, limits),
        textures_(root.file(), limits, warnings_),
        materials_(root, buffers_, textures_, load, warnings_),
        meshes_(root, buffers_, materials_, nodes_, limits, warnings_) {}

  ImportedFile Read();

 private:
  void CheckVersion();
  void CheckNames();
  std::vector<uint32_t> SceneRoots();
  void AddTree(uint32_t node);
  void AddNode(uint32_t node, int32_t parent);

  JsonRef root_;
  ImportLimits limits_;
  Warnings warnings_;
  GltfBuffers buffers_;
  TextureStore textures_;
  GltfMaterials materials_;
  std::vector<GltfNode> nodes_;
  GltfMeshes meshes_;

  std::map<uint64_t, uint64_t> copies_;  // nodes read, by the number that world export gave
  ImportedFile out_;
  std::set<uint32_t> shown_;
};

void GltfReader::CheckVersion() {
  const JsonRef asset = root_.At("asset");
  const JsonRef version = asset.At("version");
  if (!version.Text().starts_with("2.")) version.Fail("only glTF 2 is read");
  if (const auto least = asset.Find("minVersion"); least && least->Text() != "2.0") least->Fail("only glTF 2.0 is read");
  out_.copyright = CleanName(asset.TextOr("copyright", ""));
  if (const auto required = root_.Find("extensionsRequired")) {
    for (size_t i = 0; i < required->size(); ++i) {
      const JsonRef name = (*required)[i];
      if (!IsKnownExtension(name.Text())) name.Fail("the file needs this extension, which is not read");
    }
  }
}

void GltfReader::CheckNames() {
  for (const char* array : {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials", "meshes", "nodes",
                            "samplers", "scenes", "skins", "textures"}) {
    const auto elements = root_.Find(array);
    for (size_t i = 0; elements && i < elements->size(); ++i) static_cast<void>((*elements)[i].TextOr("name", ""));
  }
}

std::vector<uint32_t> GltfReader::SceneRoots() {
  std::vector<uint32_t> roots;
  const auto scenes = root_.Find("scenes");
  const auto chosen = root_.Find("scene");
  if (chosen || (scenes && scenes->size() > 0)) {
    const JsonRef scene = chosen ? buffers_.Element("scenes", *chosen) : (*scenes)[0];
    if (const auto extras = scene.Find("extras"); extras && extras->IsObject()) {
      const std::string world = extras->TextOr(kExtraWorld, "");
      if (!world.empty()) out_.written = ReadWrittenWorld(root_.file(), world);
    }
    const auto list = scene.Find("nodes");
    for (size_t i = 0; list && i < list->size(); ++i) {
      const uint64_t node = (*list)[i].Uint();
      if (node >= nodes_.size()) (*list)[i].Fail("there are only " + std::to_string(nodes_.size()) + " nodes");
      roots.push_back(static_cast<uint32_t>(node));
    }
    return roots;
  }
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].parent < 0) roots.push_back(i);
  }
  return roots;
}

// What `world export` wrote of a node beyond glTF. `seen` counts the nodes of the same number.
void ReadNodeExtras(const JsonRef& json, ImportedNode& node, std::map<uint64_t, uint64_t>& seen) {
  const auto extras = json.Find("extras");
  if (!extras || !extras->IsObject()) return;
  node.category = extras->TextOr(kExtraCategory, "");
  node.entity = extras->UintOr(kExtraEntity, 0);
  node.number = extras->UintOr(kExtraNode, 0);
  if (node.number != 0) node.copy = seen[node.number]++;
  // The whole of a name that was cut short (and perhaps numbered, "….001"), unless it was changed or is a copy's.
  const std::string whole = CleanName(extras->TextOr(kExtraName, "")), kept = node.name.substr(0, node.name.rfind('.'));
  if (node.copy == 0 && whole.size() > kBlenderName && kept.size() + 8 > kBlenderName && whole.starts_with(kept)) node.name = whole;
  const std::vector<double> tint = extras->NumbersOr(kExtraTint, {1, 1, 1});
  const std::vector<double> glow = extras->NumbersOr(kExtraGlow, {1, 1, 1});
  for (int k = 0; k < 3; ++k) {
    node.tint[k] = static_cast<float>(std::clamp(tint[k], 0.0, 1e3));
    node.glow[k] = static_cast<float>(std::clamp(glow[k], 0.0, 1e3));
  }
}

void GltfReader::AddNode(uint32_t i, int32_t parent) {
  const JsonRef json = root_.At("nodes")[i];
  const std::string name = CleanName(json.TextOr("name", ""));
  const TransformG& X = nodes_[i].X_G;
  const int32_t mesh = meshes_.MeshOf(json);
  const auto instancing = GltfExtension(json, "EXT_mesh_gpu_instancing");
  if (mesh >= 0 && instancing) {
    // The node itself only groups its instances.
    const auto self = static_cast<int32_t>(out_.nodes.size());
    out_.nodes.push_back({name, parent, -1, FromG(X)});
    for (const TransformG& local : ReadGpuInstances(*instancing, buffers_, limits_)) {
      out_.nodes.push_back({name, self, mesh, FromG(X * local)});
    }
  } else {
    // A skinned mesh is where its joints are, wherever its node is.
    const bool skinned = mesh >= 0 && json.Has("skin");
    out_.nodes.push_back({name, parent, mesh, skinned ? AffineTransform{} : FromG(X)});
    if (!skinned) out_.nodes.back().p_exact = FromG(X.p);
    ReadNodeExtras(json, out_.nodes.back(), copies_);
  }
  if (out_.nodes.size() > limits_.max_nodes) json.Fail("at most " + std::to_string(limits_.max_nodes) + " nodes and instances allowed");
}

void GltfReader::AddTree(uint32_t root) {
  // Depth first in the order of the file, so that names are numbered as its author sees them.
  std::vector<std::pair<uint32_t, int32_t>> stack = {{root, -1}};
  while (!stack.empty()) {
    const auto [node, parent] = stack.back();
    stack.pop_back();
    if (!shown_.insert(node).second) root_.At("nodes")[node].Fail("the scene shows this node twice");
    const auto self = static_cast<int32_t>(out_.nodes.size());
    AddNode(node, parent);
    const std::vector<uint32_t>& children = nodes_[node].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child) stack.emplace_back(*child, self);
  }
}

ImportedFile GltfReader::Read() {
  CheckVersion();
  CheckNames();
  nodes_ = ReadNodes(root_, limits_);
  for (uint32_t root : SceneRoots()) AddTree(root);
  out_.meshes = std::move(meshes_.meshes);
  out_.materials = std::move(meshes_.materials);
  out_.unlit = std::move(meshes_.unlit);
  out_.textures = textures_.Take();
  out_.warnings = warnings_.Take();
  return std::move(out_);
}

}  // namespace

ImportedFile ReadGltf(const std::string& file, std::span<const std::byte> bytes, const ResourceLoader& load, const ImportLimits& limits) {
  const GltfContainer container = OpenGltfContainer(file, bytes);
  const nlohmann::json json = ParseJson(file, container.json);
  const JsonRef root(file, json);
  if (!json.is_object()) root.Fail("an object expected");
  return GltfReader(root, container.binary, load, limits).Read();
}

}  // namespace airsim360::internal

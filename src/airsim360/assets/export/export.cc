#include "airsim360/assets/export/export.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "airsim360/assets/axes.h"
#include "airsim360/assets/export/glb_writer.h"
#include "airsim360/assets/gltf/gltf_extras.h"
#include "airsim360/assets/gltf/written_world.h"
#include "airsim360/image/codecs.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace internal {
namespace {

using nlohmann::ordered_json;

ordered_json ToJson(Vec3f v) { return {v.x, v.y, v.z}; }

// The colour channels alone where alpha says nothing: smaller, and viewers need not blend.
Bytes EncodePicture(const Image<Rgba8>& image) {
  const auto pixels = image.pixels();
  if (std::any_of(pixels.begin(), pixels.end(), [](const Rgba8& p) { return p.a != 255; })) return EncodePng(image);
  Image<Rgb8> rgb(image.width(), image.height());
  std::transform(pixels.begin(), pixels.end(), rgb.pixels().begin(), [](const Rgba8& p) { return Rgb8{p.r, p.g, p.b}; });
  return EncodePng(rgb);
}

class Exporter {
 public:
  explicit Exporter(const Scene& scene)
      : scene_(scene), meshes_of_(scene.meshes.size()), used_(scene.meshes.size()), seen_(scene.entities.size() + 1) {}

  Bytes Encode() {
    for (const Texture& texture : scene_.textures) AddTexture(texture);
    for (const Material& material : scene_.materials) AddMaterial(material);
    AddInstances();
    AddSun();
    ordered_json nodes = ordered_json::array();
    for (size_t i = 0; i < writer_.json["nodes"].size(); ++i) nodes.push_back(i);
    ordered_json extras = {{kExtraSun, {scene_.environment.sun_azimuth_deg, scene_.environment.sun_elevation_deg}}};
    if (scene_.spawn) extras[kExtraSpawn] = ToJson(*scene_.spawn);
    extras[kExtraWorld] = WriteWorld(scene_, seen_);
    writer_.Append("scenes", {{"name", scene_.name}, {"nodes", nodes}, {"extras", extras}});
    writer_.json["scene"] = 0;
    if (!scene_.attributions.empty()) {
      std::string copyright;
      for (const std::string& line : scene_.attributions) copyright += (copyright.empty() ? "" : "; ") + line;
      writer_.json["asset"]["copyright"] = copyright;
    }
    return writer_.Finish();
  }

 private:
  // One sub-mesh of a mesh: the triangles of one entity (kNoEntity: of those that leave it to the instance).
  struct SubMesh {
    EntityId entity = kNoEntity;
    size_t mesh = 0;
  };

  void AddTexture(const Texture& texture);
  ordered_json TextureInfo(TextureId id, const Material& material);
  void AddMaterial(const Material& material);
  ordered_json MaterialExtras(const Material& material) const;
  const std::vector<SubMesh>& SubMeshesOf(MeshId id);
  size_t AddSubMesh(const Mesh& mesh, EntityId entity);
  ordered_json Primitive(const Mesh& mesh, const std::vector<uint32_t>& triangles, MaterialId material);
  void AddInstances();
  void AddSun();

  const Scene& scene_;
  GlbWriter writer_;
  std::vector<std::vector<SubMesh>> meshes_of_;
  std::vector<bool> used_, seen_;  // meshes that were written, entities that a node shows
};

void Exporter::AddTexture(const Texture& texture) {
  static constexpr int kWrapModes[] = {10497, 33648, 33071};  // repeat, mirrored, clamp
  const size_t view = writer_.AddView(EncodePicture(texture.levels[0]));
  const size_t image = writer_.Append("images", {{"name", texture.name}, {"bufferView", view}, {"mimeType", "image/png"}});
  const size_t sampler = writer_.Append("samplers", {{"magFilter", 9729},  // linear; smaller: linear between levels
                                                     {"minFilter", 9987},
                                                     {"wrapS", kWrapModes[static_cast<int>(texture.wrap_u)]},
                                                     {"wrapT", kWrapModes[static_cast<int>(texture.wrap_v)]}});
  writer_.Append("textures", {{"name", texture.name}, {"sampler", sampler}, {"source", image}});
}

ordered_json Exporter::TextureInfo(TextureId id, const Material& m) {
  ordered_json info = {{"index", id}};
  if (m.uv_scale == Vec2f{1, 1} && m.uv_offset == Vec2f{} && m.uv_rotation == 0) return info;
  writer_.Use("KHR_texture_transform");
  info["extensions"]["KHR_texture_transform"] = {
      {"offset", {m.uv_offset.x, m.uv_offset.y}}, {"rotation", m.uv_rotation}, {"scale", {m.uv_scale.x, m.uv_scale.y}}};
  return info;
}

ordered_json Exporter::MaterialExtras(const Material& m) const {
  ordered_json extras = {{kExtraKind, kSurfaceKindNames[static_cast<int>(m.kind)]}};
  if (m.transmission != 0) extras[kExtraTransmission] = m.transmission;
  if (m.ground != GroundWear::kNone) extras[kExtraGround] = kGroundWearNames[static_cast<int>(m.ground)];
  if (m.blend_tiles) extras[kExtraBlendTiles] = true;
  if (!(m.units == Vec2f{})) extras[kExtraUnits] = {m.units.x, m.units.y};
  const Vec3f gain = Max(m.base_color, {1, 1, 1});
  if (!(gain == Vec3f{1, 1, 1})) extras[kExtraBaseGain] = ToJson(gain);
  if (m.macro_variation != 0) extras[kExtraMacroVariation] = m.macro_variation;
  if (m.interior) extras[kExtraInterior] = true;
  if (m.lamp) extras[kExtraLamp] = true;
  if (m.beam != 0) extras[kExtraBeam] = m.beam;
  return extras;
}

void Exporter::AddMaterial(const Material& m) {
  const auto unit = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
  ordered_json pbr = {{"baseColorFactor", {unit(m.base_color.x), unit(m.base_color.y), unit(m.base_color.z), unit(m.base_alpha)}},
                      {"metallicFactor", unit(m.metallic)},
                      {"roughnessFactor", unit(m.roughness)}};
  if (m.base_color_texture != kNoTexture) pbr["baseColorTexture"] = TextureInfo(m.base_color_texture, m);
  if (m.metallic_roughness_texture != kNoTexture) pbr["metallicRoughnessTexture"] = TextureInfo(m.metallic_roughness_texture, m);
  ordered_json out = {{"name", m.name}, {"pbrMetallicRoughness", pbr}, {"doubleSided", true}};
  if (m.normal_texture != kNoTexture) {
    out["normalTexture"] = TextureInfo(m.normal_texture, m);
    out["normalTexture"]["scale"] = m.normal_scale;
  }
  if (m.alpha_mode == AlphaMode::kMask) {
    out["alphaMode"] = "MASK";
    out["alphaCutoff"] = m.alpha_cutoff;
  }

  // A factor of at most 1 and its strength.
  const float strength = std::max({m.emission.x, m.emission.y, m.emission.z});
  if (strength > 0) {
    // A power of two divides without rounding.
    const float power = strength > 1 ? std::exp2(std::ceil(std::log2(strength))) : 1;
    out["emissiveFactor"] = ToJson(m.emission * (1 / power));
    if (m.emission_texture != kNoTexture) out["emissiveTexture"] = TextureInfo(m.emission_texture, m);
    if (strength > 1) {
      writer_.Use("KHR_materials_emissive_strength");
      out["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", power}};
    }
  }
  if (m.clear_coat > 0) {
    writer_.Use("KHR_materials_clearcoat");
    out["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", m.clear_coat},
                                                    {"clearcoatRoughnessFactor", m.clear_coat_roughness}};
  }
  out["extras"] = MaterialExtras(m);
  writer_.Append("materials", std::move(out));
}

// The triangles named, with the vertices they use.
ordered_json Exporter::Primitive(const Mesh& mesh, const std::vector<uint32_t>& triangles, MaterialId material) {
  constexpr uint32_t kUnused = UINT32_MAX;
  std::vector<uint32_t> moved(mesh.positions.size(), kUnused), indices;
  std::vector<Vec3f> positions, normals;
  std::vector<Vec2f> uvs;
  std::vector<VertexColor> colors;
  const auto vertex = [&](uint32_t i) {
    if (moved[i] == kUnused) {
      moved[i] = static_cast<uint32_t>(positions.size());
      positions.push_back(ToG(mesh.positions[i]));
      if (!mesh.normals.empty()) normals.push_back(ToG(mesh.normals[i]));
      if (!mesh.uvs.empty()) uvs.push_back(mesh.uvs[i]);
      if (!mesh.colors.empty()) colors.push_back(mesh.colors[i]);
    }
    indices.push_back(moved[i]);
  };
  for (uint32_t t : triangles) {
    vertex(mesh.triangles[t].x);
    vertex(mesh.triangles[t].y);
    vertex(mesh.triangles[t].z);
  }
  ordered_json attributes = {{"POSITION", writer_.AddPositions(positions)}};
  if (!normals.empty()) attributes["NORMAL"] = writer_.AddVectors(normals);
  if (!uvs.empty()) attributes["TEXCOORD_0"] = writer_.AddUvs(uvs);
  if (!colors.empty()) attributes["COLOR_0"] = writer_.AddColors(colors);
  return {{"attributes", attributes}, {"indices", writer_.AddIndices(indices)}, {"material", material}};
}

size_t Exporter::AddSubMesh(const Mesh& mesh, EntityId entity) {
  // A primitive for each material, in the order of their first part.
  std::vector<std::pair<MaterialId, std::vector<uint32_t>>> groups;
  for (const MeshPart& part : mesh.parts) {
    if (part.entity != entity) continue;
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == part.material; });
    if (group == groups.end()) group = groups.insert(groups.end(), {part.material, {}});
    for (uint32_t i = 0; i < part.triangle_count; ++i) group->second.push_back(part.first_triangle + i);
  }
  ordered_json primitives = ordered_json::array();
  for (const auto& [material, triangles] : groups) {
    if (!triangles.empty()) primitives.push_back(Primitive(mesh, triangles, material));
  }
  if (primitives.empty()) return SIZE_MAX;
  const std::string& name = entity == kNoEntity ? mesh.name : scene_.entity(entity).name;
  ordered_json out = {{"name", name}, {"primitives", primitives}};
  if (mesh.normals.empty()) out["extras"] = {{kExtraFlat, true}};
  return writer_.Append("meshes", std::move(out));
}

const std::vector<Exporter::SubMesh>& Exporter::SubMeshesOf(MeshId id) {
  if (used_[id]) return meshes_of_[id];
  used_[id] = true;
  std::vector<EntityId> entities;
  for (const MeshPart& part : scene_.meshes[id].parts) entities.push_back(part.entity);
  std::sort(entities.begin(), entities.end());
  entities.erase(std::unique(entities.begin(), entities.end()), entities.end());
  for (EntityId entity : entities) {
    const size_t mesh = AddSubMesh(scene_.meshes[id], entity);
    if (mesh != SIZE_MAX) meshes_of_[id].push_back({entity, mesh});
  }
  return meshes_of_[id];
}

void Exporter::AddInstances() {
  std::vector<std::pair<EntityId, ordered_json>> nodes;
  for (const Instance& instance : scene_.instances) {
    const Mat3f A = ToG(instance.X_WM.A);
    const Vec3f p = ToG(instance.X_WM.p), x = A.column(0), y = A.column(1), z = A.column(2);
    for (const SubMesh& sub : SubMeshesOf(instance.mesh)) {
      const EntityId id = sub.entity != kNoEntity ? sub.entity : instance.entity;
      ordered_json node = {{"name", scene_.entity(id).name}, {"mesh", sub.mesh}};
      if (!(instance.X_WM == AffineTransform())) node["matrix"] = {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, p.x, p.y, p.z, 1};
      node["extras"] = {{kExtraEntity, id}, {kExtraCategory, scene_.tree[scene_.entity(id).category].path}};
      if (!(instance.tint == Vec3f{1, 1, 1})) node["extras"][kExtraTint] = ToJson(instance.tint);
      if (!(instance.glow == Vec3f{1, 1, 1})) node["extras"][kExtraGlow] = ToJson(instance.glow);
      node["extras"][kExtraNode] = nodes.size() + 1;
      seen_[id] = true;
      nodes.emplace_back(id, std::move(node));
    }
  }
  std::stable_sort(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [id, node] : nodes) {
    if (const std::string& name = scene_.entity(id).name; name.size() > kBlenderName) node["extras"][kExtraName] = name;
    writer_.Append("nodes", std::move(node));
  }
}

// A directional light shines along -Z of its node: that axis is turned away from the sun.
void Exporter::AddSun() {
  if (scene_.sky_entity == kNoEntity) return;
  const double azimuth = scene_.environment.sun_azimuth_deg * kDegree, elevation = scene_.environment.sun_elevation_deg * kDegree;
  const Vec3d to_sun = ToG(Vec3d{std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation)});
  const Vec3d side = std::abs(to_sun.y) < 0.999 ? Normalized(Cross(Vec3d{0, 1, 0}, to_sun)) : Vec3d{1, 0, 0};
  const Vec3d up = Cross(to_sun, side);
  writer_.Use("KHR_lights_punctual");
  constexpr double kClearNoonLux = 100000;
  writer_.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}, {"name", "sun"}, {"intensity", kClearNoonLux}}};
  writer_.Append("nodes", {{"name", "sun"},
                           {"matrix", {side.x, side.y, side.z, 0, up.x, up.y, up.z, 0, to_sun.x, to_sun.y, to_sun.z, 0, 0, 0, 0, 1}},
                           {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
}

}  // namespace
}  // namespace internal

Bytes EncodeGlb(const Scene& scene) { return internal::Exporter(scene).Encode(); }

}  // namespace airsim360

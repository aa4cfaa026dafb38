#include "airsim360/render/vulkan/gpu_scene.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/trace/triangle_opacity.h"

namespace airsim360::internal {
namespace {

constexpr size_t kMaxInstances = size_t{1} << 24;

// The geometry of a triangle: 0, 1, 2; 3 = never hit.
uint8_t GeometryOf(TriangleOpacity opacity, const Material& material) {
  if (opacity == TriangleOpacity::kClear) return 3;
  if (opacity == TriangleOpacity::kMixed) return 1;
  return IsClearPane(material) ? 2 : 0;
}

struct Sorted {
  std::vector<uint32_t> triangle_of;  // by primitive; empty = the order of the mesh
  uint32_t first[4];
};

Sorted Sort(const Scene& scene, const Mesh& mesh) {
  const std::vector<TriangleOpacity> opacity = TriangleOpacities(scene, mesh);
  std::vector<uint8_t> geometry(mesh.triangles.size());
  uint32_t counts[4] = {};
  for (const MeshPart& part : mesh.parts) {
    for (uint32_t i = part.first_triangle; i < part.first_triangle + part.triangle_count; ++i) {
      geometry[i] = GeometryOf(opacity[i], scene.materials[part.material]);
      ++counts[geometry[i]];
    }
  }
  Sorted out;
  for (int g = 0; g < 3; ++g) out.first[g] = g == 0 ? 0 : out.first[g - 1] + counts[g - 1];
  out.first[3] = out.first[2] + counts[2];
  if (std::ranges::count(counts, uint32_t(mesh.triangles.size())) == 1 && counts[3] == 0) return out;
  out.triangle_of.resize(out.first[3]);
  uint32_t next[3] = {out.first[0], out.first[1], out.first[2]};
  for (uint32_t i = 0; i < geometry.size(); ++i) {
    if (geometry[i] < 3) out.triangle_of[next[geometry[i]]++] = i;
  }
  return out;
}

// The alpha channel of a texture, four texels a word, rows padded.
std::vector<uint32_t> PackAlpha(const Image<Rgba8>& image) {
  const int words = (image.width() + 3) / 4;
  std::vector<uint32_t> out(static_cast<size_t>(words) * image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      out[static_cast<size_t>(y) * words + x / 4] |= static_cast<uint32_t>(image(x, y).a) << (8 * (x % 4));
    }
  }
  return out;
}

}  // namespace

GpuScene::GpuScene(GpuDevice& device, std::shared_ptr<const Scene> scene) : device_(device), scene_(std::move(scene)), arena_(device) {
  const Scene& s = *scene_;
  if (s.instances.size() > kMaxInstances)
    throw RuntimeError("GPU: the scene has " + std::to_string(s.instances.size()) + " instances, at most 2^24 can be traced");
  records_.resize(s.meshes.size());
  structures_.resize(s.meshes.size(), VK_NULL_HANDLE);
  addresses_.resize(s.meshes.size(), 0);
  std::vector<uint8_t> is_used(s.meshes.size());
  for (const Instance& instance : s.instances) is_used[instance.mesh] = 1;
  std::vector<MeshId> used;
  for (MeshId m = 0; m < s.meshes.size(); ++m) {
    if (!is_used[m]) continue;
    UploadMesh(m);
    if (records_[m].first[3] > 0) used.push_back(m);
  }
  meshes_ = arena_.Put(records_);
  std::vector<uint32_t> categories(1, kVoid);
  for (const Entity& entity : s.entities) categories.push_back(entity.category);
  categories_ = arena_.Put(categories);
  UploadAlphas();
  arena_.Flush();
  BuildStructures(used);
  arena_.EndUploads();
}

GpuScene::~GpuScene() {
  for (VkAccelerationStructureKHR structure : structures_) {
    if (structure != VK_NULL_HANDLE) device_.rt().destroy_structure(device_.device(), structure, nullptr);
  }
}

void GpuScene::UploadMesh(MeshId id) {
  const Mesh& mesh = scene_->meshes[id];
  GpuMesh& record = records_[id];
  record.positions = arena_.Put(mesh.positions).address;
  if (!mesh.uvs.empty()) {
    record.flags |= kGpuHasUvs;
    record.uvs = arena_.Put(mesh.uvs).address;
  }

  // Read for their coverage alone.
  const bool tested = std::ranges::any_of(
      mesh.parts, [&](const MeshPart& part) { return scene_->materials[part.material].alpha_mode == AlphaMode::kMask; });
  if (tested && !mesh.colors.empty()) {
    record.flags |= kGpuHasColors;
    record.colors = arena_.Put(mesh.colors).address;
  }

  // Primitives in the order of their geometries.
  const Sorted sorted = Sort(*scene_, mesh);
  std::copy_n(sorted.first, 4, record.first);
  if (sorted.triangle_of.empty()) {
    record.indices = arena_.Put(mesh.triangles).address;
  } else {
    std::vector<Vec3u> indices;
    for (uint32_t triangle : sorted.triangle_of) indices.push_back(mesh.triangles[triangle]);
    record.indices = arena_.Put(indices).address;
    record.triangle_of = arena_.Put(sorted.triangle_of).address;
    record.flags |= kGpuSorted;
  }

  // Per triangle: material, and the entities of parts that have their own.
  std::vector<uint32_t> materials, entities;
  bool own = false;
  for (const MeshPart& part : mesh.parts) {
    materials.insert(materials.end(), part.triangle_count, part.material);
    entities.insert(entities.end(), part.triangle_count, part.entity);
    own |= part.entity != kNoEntity;
  }
  record.material_of = arena_.Put(materials).address;
  if (!own) return;
  record.entity_of = arena_.Put(entities).address;
  record.flags |= kGpuHasEntities;
}

void GpuScene::UploadAlphas() {
  std::vector<GpuAlpha> alphas;
  std::vector<VkDeviceAddress> texels(scene_->textures.size(), 0);
  for (const Material& material : scene_->materials) {
    GpuAlpha alpha{};
    alpha.scale = material.base_alpha;
    alpha.cutoff = material.alpha_mode == AlphaMode::kMask ? material.alpha_cutoff : 0;
    const UvTransform uv(material);
    const float m[6] = {uv.m00, uv.m01, uv.m10, uv.m11, uv.t.x, uv.t.y};
    std::copy_n(m, 6, alpha.uv);
    if (material.alpha_mode == AlphaMode::kMask && material.base_color_texture != kNoTexture) {
      const auto id = static_cast<size_t>(material.base_color_texture);
      const Texture& texture = scene_->textures[id];
      if (!texture.levels.empty() && !texture.levels[0].empty()) {
        if (texels[id] == 0) texels[id] = arena_.Put(PackAlpha(texture.levels[0])).address;
        alpha.texels = texels[id];
        alpha.width = static_cast<uint32_t>(texture.levels[0].width());
        alpha.height = static_cast<uint32_t>(texture.levels[0].height());
        alpha.wrap_u = static_cast<uint32_t>(texture.wrap_u);
        alpha.wrap_v = static_cast<uint32_t>(texture.wrap_v);
      }
    }
    alphas.push_back(alpha);
  }
  alphas_ = arena_.Put(alphas);
}

}  // namespace airsim360::internal

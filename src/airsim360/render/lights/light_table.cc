#include "airsim360/render/lights/light_table.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "airsim360/image/color.h"
#include "airsim360/render/lights/lamp_parts.h"
#include "airsim360/render/lights/light_tree.h"
#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

// Whether A keeps angles: then areas measured in the mesh frame are right up to a factor.
bool IsSimilarity(const Mat3f& A) {
  const Vec3f a = A.column(0), b = A.column(1), c = A.column(2);
  const float scale = Dot(a, a), slack = 1e-4f * scale;
  return std::fabs(Dot(b, b) - scale) < slack && std::fabs(Dot(c, c) - scale) < slack && std::fabs(Dot(a, b)) < slack &&
         std::fabs(Dot(b, c)) < slack && std::fabs(Dot(c, a)) < slack;
}

// Bilinear look-up of the finest level, as shading_texture.h does.
Vec3f TexelsAt(const TextureRecord& texture, float u, float v) {
  const TextureLevel& level = texture.levels[0];
  const auto fold = [](float x, uint8_t wrap) {
    const float half = x * 0.5f - std::floor(x * 0.5f);
    return wrap == 0 ? x - std::floor(x) : wrap == 1 ? 1 - std::fabs(1 - 2 * half) : std::clamp(x, 0.0f, 1.0f);
  };
  const auto neighbour = [](float at, float size, bool clamps) {
    if (at < 0) return clamps ? 0.0f : size - 1;
    return at > size - 1 ? (clamps ? size - 1 : 0.0f) : at;
  };
  const float x = fold(u, texture.wrap_u) * level.width - 0.5f, y = fold(v, texture.wrap_v) * level.height - 0.5f;
  const float x0 = std::floor(x), y0 = std::floor(y);
  Vec3f sum;
  for (int k = 0; k < 4; ++k) {
    const float dx = static_cast<float>(k & 1), dy = static_cast<float>(k >> 1);
    const float weight = std::fabs(1 - dx - (x - x0)) * std::fabs(1 - dy - (y - y0));
    const auto column = static_cast<size_t>(neighbour(x0 + dx, level.width, texture.wrap_u != 0));
    const auto row = static_cast<size_t>(neighbour(y0 + dy, level.height, texture.wrap_v != 0));
    const uint32_t texel = level.texels[row * static_cast<size_t>(level.width) + column];
    for (int c = 0; c < 3; ++c) {
      const auto value = static_cast<uint8_t>(texel >> (8 * c));
      sum[c] += weight * (texture.srgb > 0.5f ? SrgbToLinear(value) : static_cast<float>(value) / 255.0f);
    }
  }
  return sum;
}

}  // namespace

struct LightTable::Impl {
  Impl(const Scene& s, const SurfaceTables& t, const Environment& environment);

  const Scene& scene;
  const SurfaceTables& tables;
  std::vector<MeshLamps> mesh_lamps;        // one a mesh with shining parts, more where instances are sheared
  std::vector<uint32_t> lamps_of_instance;  // index into mesh_lamps; kNoLamp = does not shine
  std::vector<uint32_t> first_lamp;         // by instance
  std::vector<Lamp> lamps;
  std::vector<uint32_t> shape;  // by lamp
  LightTree tree;

  const LampShape& ShapeOf(uint32_t lamp) const { return mesh_lamps[lamps_of_instance[lamps[lamp].instance]].shapes[shape[lamp]]; }
};

LightTable::Impl::Impl(const Scene& s, const SurfaceTables& t, const Environment& environment) : scene(s), tables(t) {
  std::vector<bool> shines(scene.meshes.size());
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    for (const MeshPart& part : scene.meshes[m].parts) shines[m] = shines[m] || Shines(scene.materials[part.material], environment);
  }

  // Groups of triangles are found once a mesh, and again for instances that shear it.
  std::map<MeshId, uint32_t> shared;
  lamps_of_instance.assign(scene.instances.size(), kNoLamp);
  first_lamp.assign(scene.instances.size(), 0);
  std::vector<LightBounds> bounds;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (!shines[instance.mesh] || instance.glow == Vec3f{}) continue;
    const Mesh& mesh = scene.meshes[instance.mesh];
    const bool similar = IsSimilarity(instance.X_WM.A);
    const auto known = similar ? shared.find(instance.mesh) : shared.end();
    if (known != shared.end()) {
      lamps_of_instance[i] = known->second;
    } else {
      lamps_of_instance[i] = static_cast<uint32_t>(mesh_lamps.size());
      mesh_lamps.push_back(FindLamps(scene, mesh, similar ? Mat3f() : instance.X_WM.A, environment));
      if (similar) shared[instance.mesh] = lamps_of_instance[i];
    }
    first_lamp[i] = static_cast<uint32_t>(lamps.size());
    const MeshLamps& found = mesh_lamps[lamps_of_instance[i]];
    for (uint32_t k = 0; k < found.shapes.size(); ++k) {
      const PlacedLamp placed = PlaceLamp(mesh, tables, tables.instances[i], instance.X_WM, tables.GlowOf(i), found.shapes[k]);
      lamps.push_back(placed.lamp);
      lamps.back().instance = i;
      shape.push_back(k);
      bounds.push_back({placed.box, Luminance(placed.lamp.power), placed.lamp.axis, placed.lamp.spread});
    }
  }
  tree = LightTree(bounds);
}

LightTable::LightTable(const Scene& scene, const SurfaceTables& tables, const Environment& environment)
    : impl_(std::make_unique<const Impl>(scene, tables, environment)) {}
LightTable::~LightTable() = default;

bool LightTable::empty() const { return impl_->lamps.empty(); }
size_t LightTable::size() const { return impl_->lamps.size(); }
std::span<const Lamp> LightTable::lamps() const { return impl_->lamps; }

LightSample LightTable::Sample(Vec3f p, Vec3f normal, Vec3f u) const { return PointOf(impl_->tree.Choose(p, normal, u.x), p, u.y, u.z); }

LightSample LightTable::PointOf(const LightTree::Choice& choice, Vec3f p, float u, float v) const {
  if (!(choice.probability > 0)) return {};

  // A triangle by area, with what is left of the random number of the choice; a point of it.
  const Lamp& lamp = impl_->lamps[choice.lamp];
  const Instance& instance = impl_->scene.instances[lamp.instance];
  const LampShape& shape = impl_->ShapeOf(choice.lamp);
  const auto at = std::upper_bound(shape.cumulative.begin(), shape.cumulative.end() - 1, choice.u);
  const uint32_t triangle = shape.triangles[static_cast<size_t>(at - shape.cumulative.begin())];
  const LampTriangle placed = PlaceTriangle(impl_->scene.meshes[instance.mesh], triangle, instance.X_WM);
  const float root = std::sqrt(u), b1 = root * (1 - v), b2 = root * v;
  LightSample sample;
  sample.p = placed.corner[0] * (1 - root) + placed.corner[1] * b1 + placed.corner[2] * b2;
  sample.normal = placed.normal;
  sample.pdf = choice.probability / lamp.area;
  sample.lamp = choice.lamp;

  // Radiance, as the shader sees it there.
  const TriangleRecord& record = impl_->tables.triangles[impl_->tables.instances[lamp.instance].first_triangle + triangle];
  const Material& material = impl_->scene.materials[record.material & ~kMirroredUv];
  const MaterialRecord& look = impl_->tables.materials[record.material & ~kMirroredUv];
  sample.radiance = material.emission * impl_->tables.GlowOf(lamp.instance);
  if (look.beam == kWindowBeam) {
    const uint32_t bits = record.pane ^ impl_->tables.instances[lamp.instance].hash;
    const float room = static_cast<float>((bits * 0x9e3779b1u) >> 8) * 0x1p-24f;  // HashLanes of lane_gather.h
    sample.radiance = scalar::window_light(room, record.area) * Luminance(sample.radiance);
  } else if (look.beam != 0) {
    const Vec3f way = Normalized(p - sample.p);
    sample.radiance = sample.radiance * scalar::beam_shape(Norm(lamp.beam), Dot(lamp.beam, way), way.z);
  }
  if (look.emission_texture != 0) {
    const float u_at = record.uv[0] * (1 - root) + record.uv[2] * b1 + record.uv[4] * b2;
    const float v_at = record.uv[1] * (1 - root) + record.uv[3] * b1 + record.uv[5] * b2;
    sample.radiance = sample.radiance * TexelsAt(impl_->tables.textures[look.emission_texture], u_at, v_at);
  }
  return sample;
}

const LightTree& LightTable::tree() const { return impl_->tree; }
std::span<const uint32_t> LightTable::TrianglesOf(uint32_t lamp) const { return impl_->ShapeOf(lamp).triangles; }
std::span<const float> LightTable::SharesOf(uint32_t lamp) const { return impl_->ShapeOf(lamp).cumulative; }

uint32_t LightTable::LampOf(uint32_t instance, uint32_t triangle) const {
  const uint32_t lamps = impl_->lamps_of_instance[instance];
  if (lamps == kNoLamp) return kNoLamp;
  const uint32_t shape = impl_->mesh_lamps[lamps].ShapeOf(triangle);
  return shape == kNoLamp ? kNoLamp : impl_->first_lamp[instance] + shape;
}

float LightTable::Pdf(Vec3f p, Vec3f normal, uint32_t instance, uint32_t triangle) const {
  const uint32_t lamp = LampOf(instance, triangle);
  return lamp == kNoLamp ? 0 : impl_->tree.Probability(p, normal, lamp) / impl_->lamps[lamp].area;
}

}  // namespace airsim360::internal

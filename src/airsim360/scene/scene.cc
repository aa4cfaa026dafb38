#include "airsim360/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/scene/road_network.h"
#include "airsim360/scene/scene_additions.h"

namespace airsim360 {
namespace {

bool IsFinite(Vec3f v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

[[noreturn]] void Fail(const std::string& where, const std::string& what) { throw InputError("scene " + where + ": " + what); }

void CheckTexture(const std::string& where, TextureId id, size_t count) {
  if (id != kNoTexture && (id < 0 || static_cast<size_t>(id) >= count)) {
    Fail(where, "texture index " + std::to_string(id) + " of " + std::to_string(count));
  }
}

void CheckMesh(const Mesh& mesh, size_t materials) {
  const std::string where = "mesh '" + mesh.name + "'";
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) Fail(where, "normals do not match positions");
  if (!mesh.uvs.empty() && mesh.uvs.size() != mesh.positions.size()) Fail(where, "uvs do not match positions");
  if (!mesh.colors.empty() && mesh.colors.size() != mesh.positions.size()) Fail(where, "colours do not match positions");
  for (Vec3f p : mesh.positions) {
    if (!IsFinite(p)) Fail(where, "a vertex is not finite");
  }
  const auto count = static_cast<uint32_t>(mesh.positions.size());
  for (Vec3u t : mesh.triangles) {
    if (std::max({t.x, t.y, t.z}) >= count) {
      Fail(where, "vertex index " + std::to_string(std::max({t.x, t.y, t.z})) + " of " + std::to_string(count));
    }
  }
  uint64_t next = 0;
  for (const MeshPart& part : mesh.parts) {
    if (part.first_triangle != next) Fail(where, "parts do not follow each other");
    next += part.triangle_count;
    if (part.material >= materials) {
      Fail(where, "material index " + std::to_string(part.material) + " of " + std::to_string(materials));
    }
  }
  if (next != mesh.triangles.size()) Fail(where, "parts do not cover all triangles");
}

template <class T>
void Fit(std::vector<T>& list, size_t capacity) {
  if (list.capacity() == capacity) return;
  std::vector<T> fitted;
  fitted.reserve(capacity);
  fitted.assign(list.begin(), list.end());
  list = std::move(fitted);
}

// What grew element by element holds up to twice its memory. Ray tracers read some bytes behind the last position.
void FitMesh(Mesh& mesh) {
  Fit(mesh.positions, mesh.positions.size() + 1);
  Fit(mesh.normals, mesh.normals.size());
  Fit(mesh.uvs, mesh.uvs.size());
  Fit(mesh.triangles, mesh.triangles.size());
  Fit(mesh.colors, mesh.colors.size());
}

// The outermost vertices of a mesh, one for each of 1,024 directions from its middle: enough to bound large
// meshes that are instanced often, to half a percent of their size.
std::vector<Vec3f> OuterVertices(const Mesh& mesh) {
  constexpr int kSide = 32;
  const Vec3f middle = mesh.Bounds().center();
  std::vector<std::pair<float, Vec3f>> farthest(kSide * kSide, {-1.0f, Vec3f{}});
  for (Vec3f p : mesh.positions) {
    const Vec3f d = p - middle;
    const float sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    if (sum <= 0) continue;
    // Octahedral cells of direction; the halves of z are told apart by mirroring x.
    const auto cell = [&](float x) { return std::min(kSide - 1, static_cast<int>((0.5f + 0.5f * x / sum) * kSide)); };
    const float x = d.z < 0 ? (d.x < 0 ? -1.0f : 1.0f) * (sum - std::abs(d.y)) : d.x;
    const float y = d.z < 0 ? (d.y < 0 ? -1.0f : 1.0f) * (sum - std::abs(d.x)) : d.y;
    auto& best = farthest[static_cast<size_t>(cell(y) * kSide + cell(x))];
    if (const float r = Dot(d, d); r > best.first) best = {r, p};
  }
  std::vector<Vec3f> outer;
  for (const auto& [r, p] : farthest)
    if (r > 0) outer.push_back(p);
  return outer;
}

// What bounds a large mesh that is instanced often. Upright instances, nearly all, are bounded exactly: by the convex
// hull of the mesh seen from above and its heights; tilted ones by their outer vertices, with a margin.
struct Outline {
  std::vector<Vec2f> hull;
  float low = 0, high = 0;
  std::vector<Vec3f> outer;
};

// Andrew's monotone chain.
std::vector<Vec2f> HullFromAbove(const Mesh& mesh) {
  std::vector<Vec2f> points;
  for (Vec3f p : mesh.positions) points.push_back({p.x, p.y});
  std::sort(points.begin(), points.end(), [](Vec2f a, Vec2f b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  const auto left = [](Vec2f a, Vec2f b, Vec2f p) {
    return (static_cast<double>(b.x) - a.x) * (static_cast<double>(p.y) - a.y) -
           (static_cast<double>(b.y) - a.y) * (static_cast<double>(p.x) - a.x);
  };
  std::vector<Vec2f> hull;
  const auto chain = [&](auto first, auto last) {
    const size_t start = hull.size();
    for (; first != last; ++first) {
      while (hull.size() >= start + 2 && left(hull[hull.size() - 2], hull.back(), *first) <= 0) hull.pop_back();
      hull.push_back(*first);
    }
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

// Meshes worth that: large ones without entities of their own parts, with many instances.
std::vector<Outline> OutlinesOf(const Scene& scene) {
  std::vector<int> uses(scene.meshes.size(), 0);
  for (const Instance& instance : scene.instances)
    if (instance.mesh < uses.size()) ++uses[instance.mesh];
  std::vector<Outline> outlines(scene.meshes.size());
  for (size_t i = 0; i < outlines.size(); ++i) {
    const Mesh& mesh = scene.meshes[i];
    const bool plain = std::all_of(mesh.parts.begin(), mesh.parts.end(), [](const MeshPart& part) { return part.entity == kNoEntity; });
    if (plain && uses[i] >= 16 && mesh.positions.size() > 1500) {
      const Box3f box = mesh.Bounds();
      outlines[i] = {HullFromAbove(mesh), box.min.z, box.max.z, OuterVertices(mesh)};
    }
  }
  return outlines;
}

Box3f BoundsFrom(const Instance& instance, const Outline& outline) {
  Box3f box;
  const Mat3f& A = instance.X_WM.A;
  if (A.row(0).z == 0 && A.row(1).z == 0 && A.row(2).x == 0 && A.row(2).y == 0) {
    for (Vec2f p : outline.hull)
      for (float z : {outline.low, outline.high}) box.Add(instance.X_WM * Vec3f{p.x, p.y, z});
    return box;
  }
  for (Vec3f p : outline.outer) box.Add(instance.X_WM * p);
  const Vec3f margin = box.size() * 0.005f;
  box.min = box.min - margin;
  box.max = box.max + margin;
  return box;
}

// Grows the bounds of the entities that an instance shows, and returns the bounds of the whole instance.
Box3f GrowEntityBounds(const Instance& instance, const Mesh& mesh, std::vector<Entity>& entities) {
  Box3f whole;
  std::vector<uint32_t> last_part(mesh.positions.size(), UINT32_MAX);  // vertex already added for this part
  for (size_t i = 0; i < mesh.parts.size(); ++i) {
    const MeshPart& part = mesh.parts[i];
    const EntityId id = part.entity != kNoEntity ? part.entity : instance.entity;
    if (part.triangle_count > 0 && (id == kNoEntity || id > entities.size())) {
      Fail("instance of mesh '" + mesh.name + "'", "entity " + std::to_string(id) + " of " + std::to_string(entities.size()));
    }
    Box3f box;
    for (uint32_t k = 0; k < part.triangle_count; ++k) {
      const Vec3u triangle = mesh.triangles[part.first_triangle + k];
      for (uint32_t vertex : {triangle.x, triangle.y, triangle.z}) {
        if (std::exchange(last_part[vertex], static_cast<uint32_t>(i)) != i) box.Add(instance.X_WM * mesh.positions[vertex]);
      }
    }
    if (part.triangle_count > 0) entities[id - 1].bounds.Add(box);
    whole.Add(box);
  }
  return whole;
}

}  // namespace

SceneCounts Scene::Count() const {
  SceneCounts counts;
  for (const Mesh& mesh : meshes) counts.unique_triangles += mesh.triangles.size();
  for (const Instance& instance : instances) counts.instanced_triangles += meshes[instance.mesh].triangles.size();
  counts.instances = instances.size();
  counts.entities = entities.size();
  return counts;
}

Box3f Mesh::Bounds() const {
  Box3f box;
  for (Vec3f p : positions) box.Add(p);
  return box;
}

Vec3f Mesh::MeanColor(uint32_t triangle) const {
  if (colors.empty()) return {1, 1, 1};
  const Vec3u t = triangles[triangle];
  return (LinearColor(colors[t.x]) + LinearColor(colors[t.y]) + LinearColor(colors[t.z])) / 3.0f;
}

SceneBuilder::SceneBuilder(std::string name) { scene_.name = std::move(name); }

TextureId SceneBuilder::AddTexture(Texture texture) {
  scene_.textures.push_back(std::move(texture));
  return static_cast<TextureId>(scene_.textures.size() - 1);
}

MaterialId SceneBuilder::AddMaterial(Material material) {
  scene_.materials.push_back(std::move(material));
  return static_cast<MaterialId>(scene_.materials.size() - 1);
}

MeshId SceneBuilder::AddMesh(Mesh mesh) {
  if (mesh.parts.empty()) mesh.parts.push_back({0, static_cast<uint32_t>(mesh.triangles.size()), 0, kNoEntity});
  scene_.meshes.push_back(std::move(mesh));
  return static_cast<MeshId>(scene_.meshes.size() - 1);
}

EntityId SceneBuilder::AddEntity(std::string name, CategoryId category) {
  // The first use of a name keeps it; later ones get the next free number.
  int& uses = name_uses_[name];
  std::string unique = name;
  while (++uses > 1 && name_uses_.contains(unique = name + " " + std::to_string(uses))) {
  }
  if (unique != name) name_uses_[unique] = 1;
  const auto id = static_cast<EntityId>(scene_.entities.size() + 1);
  scene_.entities.push_back({id, std::move(unique), category, {}});
  return id;
}

void SceneBuilder::AddInstance(Instance instance) { scene_.instances.push_back(instance); }

void SceneBuilder::AddSky() {
  if (scene_.sky_entity == kNoEntity) scene_.sky_entity = AddEntity("sky", scene_.tree.At("sky"));
}

void SceneBuilder::AddAttribution(std::string line) {
  auto& lines = scene_.attributions;
  if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(std::move(line));
}

void Scene::SettleCategories() {
  const std::map<CategoryId, CategoryId> changed = tree.SettleIds();
  for (Entity& entity : entities) {
    const auto found = changed.find(entity.category);
    if (found != changed.end()) entity.category = found->second;
  }
}

std::shared_ptr<const Scene> SceneBuilder::Build() {
  // Materials and meshes refer only to what exists.
  for (const Material& material : scene_.materials) {
    const std::string where = "material '" + material.name + "'";
    for (TextureId id :
         {material.base_color_texture, material.metallic_roughness_texture, material.normal_texture, material.emission_texture}) {
      CheckTexture(where, id, scene_.textures.size());
    }
  }
  if (scene_.materials.empty()) scene_.materials.emplace_back();
  for (const Mesh& mesh : scene_.meshes) CheckMesh(mesh, scene_.materials.size());
  for (const Entity& entity : scene_.entities) static_cast<void>(scene_.tree[entity.category]);
  if (scene_.roads) CheckRoads(*scene_.roads);

  // Instances: indices, entities of every part, bounds.
  const std::vector<Outline> outlines = OutlinesOf(scene_);
  for (const Instance& instance : scene_.instances) {
    if (instance.mesh >= scene_.meshes.size()) Fail("instance", "mesh index " + std::to_string(instance.mesh));
    if (!IsFinite(instance.X_WM.p) || !IsFinite(instance.X_WM.A.row(0)) || !IsFinite(instance.X_WM.A.row(1)) ||
        !IsFinite(instance.X_WM.A.row(2))) {
      Fail("instance of mesh '" + scene_.meshes[instance.mesh].name + "'", "transform is not finite");
    }
    const Outline& outline = outlines[instance.mesh];
    if (!outline.hull.empty() && instance.entity != kNoEntity && instance.entity <= scene_.entities.size()) {
      const Box3f box = BoundsFrom(instance, outline);
      scene_.entities[instance.entity - 1].bounds.Add(box);
      scene_.bounds.Add(box);
      continue;
    }
    scene_.bounds.Add(GrowEntityBounds(instance, scene_.meshes[instance.mesh], scene_.entities));
  }
  for (Mesh& mesh : scene_.meshes) FitMesh(mesh);
  scene_.SettleCategories();
  auto built = std::make_shared<Scene>(std::move(scene_));
  scene_ = Scene();
  name_uses_.clear();
  return built;
}

std::shared_ptr<const Scene> WithCacheKey(std::shared_ptr<const Scene> scene, std::string key) {
  const auto own = OwnScene(std::move(scene));
  own->cache_key = std::move(key);
  return own;
}

std::shared_ptr<const Scene> WithEnvironment(std::shared_ptr<const Scene> scene, Environment environment) {
  const auto own = OwnScene(std::move(scene));
  own->environment = std::move(environment);
  return own;
}

}  // namespace airsim360

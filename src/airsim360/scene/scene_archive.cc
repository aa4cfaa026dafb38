#include "airsim360/scene/scene_archive.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "airsim360/base/archive.h"
#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/scene/road_network.h"

namespace airsim360 {
namespace {

// Kept as their memory: no padding whose bytes would be anything.
static_assert(sizeof(Vec3f) == 12 && sizeof(Vec2f) == 8 && sizeof(Vec3u) == 12 && sizeof(Rgba8) == 4);
static_assert(sizeof(MeshPart) == 16 && sizeof(Instance) == 80 && sizeof(Box3f) == 24);
static_assert(sizeof(VertexColor) == 8 && sizeof(SignalPhase) == 16);
// A field added to these belongs into the lists below.
static_assert(sizeof(Material) == 152 && sizeof(Environment) == 176 && sizeof(Scene) == 568);

template <class Pixel>
void VisitImage(ArchiveWriter& archive, const Image<Pixel>& image) {
  archive(image.width(), image.height());
  archive.Raw(image.pixels());
}

template <class Pixel>
void VisitImage(ArchiveReader& archive, Image<Pixel>& image) {
  int width = 0, height = 0;
  archive(width, height);
  if (width < 0 || height < 0) throw InputError("archive holds a picture of negative size");
  archive.Expect(static_cast<uint64_t>(width) * static_cast<uint64_t>(height), sizeof(Pixel));
  image = Image<Pixel>(width, height);
  archive.Raw(image.pixels());
}

template <class Archive, class T>
void VisitTexture(Archive& archive, T& t) {
  archive(t.name, t.srgb, t.wrap_u, t.wrap_v);
  archive.Each(t.levels, [&](auto& level) { VisitImage(archive, level); });
}

template <class Archive, class T>
void VisitMaterial(Archive& archive, T& m) {
  archive(m.name, m.kind, m.alpha_mode, m.alpha_cutoff, m.base_color, m.base_alpha, m.metallic, m.roughness, m.emission, m.normal_scale,
          m.transmission, m.clear_coat, m.clear_coat_roughness, m.interior, m.lamp, m.beam, m.macro_variation, m.base_color_texture,
          m.metallic_roughness_texture, m.normal_texture, m.emission_texture, m.uv_scale, m.uv_offset, m.uv_rotation, m.ground,
          m.blend_tiles, m.units);
}

template <class Archive, class T>
void VisitMesh(Archive& archive, T& m) {
  archive(m.name, m.positions, m.normals, m.uvs, m.triangles, m.parts, m.colors);
}

void SkipMesh(ArchiveReader& archive) {
  archive.SkipList<char>();
  const auto skip = [&]<class T>(std::vector<T> Mesh::*) { archive.SkipList<T>(); };
  skip(&Mesh::positions), skip(&Mesh::normals), skip(&Mesh::uvs), skip(&Mesh::triangles), skip(&Mesh::parts), skip(&Mesh::colors);
}

// Ray tracers read some bytes behind the last position: without room there they would copy all of them.
void ReservePositions(ArchiveReader archive, Mesh& mesh) {
  size_t count = 0;
  archive.SkipList<char>();
  archive(count);
  archive.Expect(count, sizeof(Vec3f));
  mesh.positions.reserve(count + 1);
}

void VisitMeshes(ArchiveWriter& archive, const std::vector<Mesh>& meshes) {
  archive.Each(meshes, [&](const Mesh& mesh) { VisitMesh(archive, mesh); });
}

// Most of a town: where each begins is found first, then they are read side by side.
void VisitMeshes(ArchiveReader& archive, std::vector<Mesh>& meshes) {
  size_t count = 0;
  archive(count);
  archive.Expect(count, 1);
  std::vector<ArchiveReader> begins;
  for (size_t i = 0; i < count; ++i) {
    begins.push_back(archive);
    SkipMesh(archive);
  }
  meshes.resize(count);
  ParallelFor(static_cast<int64_t>(count), [&](int64_t i) {
    Mesh& mesh = meshes[static_cast<size_t>(i)];
    ArchiveReader& begin = begins[static_cast<size_t>(i)];
    ReservePositions(begin, mesh);
    VisitMesh(begin, mesh);
  });
}

template <class Archive, class T>
void VisitEntity(Archive& archive, T& e) {
  archive(e.id, e.name, e.category, e.bounds);
}

void VisitPicture(ArchiveWriter& archive, const Environment& e) {
  archive(e.hdri != nullptr);
  if (!e.hdri) return;
  archive(e.hdri->name);
  VisitImage(archive, e.hdri->pixels);
}

void VisitPicture(ArchiveReader& archive, Environment& e) {
  bool present = false;
  archive(present);
  if (!present) return;
  auto picture = std::make_shared<SkyPicture>();
  archive(picture->name);
  VisitImage(archive, picture->pixels);
  e.hdri = std::move(picture);
}

template <class Archive, class T>
void VisitEnvironment(Archive& archive, T& e) {
  for (const EnvironmentField& field : EnvironmentFields()) archive(e.*field.value);
  archive(e.lamps, e.cloud_type);
  VisitPicture(archive, e);
}

// In order of path, so that adding them again gives them the ids that they have (SemanticTree::SettleIds) and
// an ancestor comes first: Add would make it of the kind of its child.
std::vector<const Category*> CustomCategories(const SemanticTree& tree) {
  std::vector<const Category*> custom;
  for (const auto& [id, category] : tree.categories())
    if (id >= kFirstCustomId) custom.push_back(&category);
  std::ranges::sort(custom, {}, &Category::path);
  SemanticTree again;
  for (const Category* category : custom) {
    if (again.Add(category->path, category->thing) != category->id)
      throw RuntimeError("archive: the ids of the categories are not settled");
  }
  return custom;
}

// The built-in categories are in the program; custom ones come back by being added again.
void VisitTree(ArchiveWriter& archive, const SemanticTree& tree) {
  archive.Each(CustomCategories(tree), [&](const Category* category) { archive(category->path, category->thing); });
}

void VisitTree(ArchiveReader& archive, SemanticTree& tree) {
  std::vector<std::pair<std::string, bool>> custom;
  archive.Each(custom, [&](auto& category) { archive(category.first, category.second); });
  for (const auto& [path, thing] : custom) tree.Add(path, thing);
}

void VisitSpawn(ArchiveWriter& archive, const std::optional<Vec3f>& spawn) { archive(spawn.has_value(), spawn.value_or(Vec3f{})); }

void VisitSpawn(ArchiveReader& archive, std::optional<Vec3f>& spawn) {
  bool present = false;
  Vec3f p;
  archive(present, p);
  if (present) spawn = p;
}

template <class Archive, class T>
void VisitRoadNetwork(Archive& archive, T& roads) {
  archive.Each(roads.lanes, [&](auto& lane) {
    archive(lane.points, lane.width, lane.speed, lane.next, lane.left, lane.right, lane.junction, lane.signal, lane.priority, lane.bus,
            lane.cycle);
  });
  archive.Each(roads.junctions, [&](auto& junction) { archive(junction.center, junction.radius, junction.phases, junction.offset); });
}

void VisitRoads(ArchiveWriter& archive, const std::shared_ptr<const RoadNetwork>& roads) {
  archive(roads != nullptr);
  if (roads) VisitRoadNetwork(archive, *roads);
}

void VisitRoads(ArchiveReader& archive, std::shared_ptr<const RoadNetwork>& roads) {
  bool present = false;
  archive(present);
  if (!present) return;
  auto read = std::make_shared<RoadNetwork>();
  VisitRoadNetwork(archive, *read);
  roads = std::move(read);
}

template <class Archive, class T>
void VisitScene(Archive& archive, T& scene) {
  archive(scene.name);
  VisitTree(archive, scene.tree);
  archive.Each(scene.textures, [&](auto& texture) { VisitTexture(archive, texture); });
  archive.Each(scene.materials, [&](auto& material) { VisitMaterial(archive, material); });
  VisitMeshes(archive, scene.meshes);
  archive(scene.instances);
  archive.Each(scene.entities, [&](auto& entity) { VisitEntity(archive, entity); });
  archive(scene.sky_entity);
  VisitEnvironment(archive, scene.environment);
  archive(scene.interior_light, scene.bounds);
  VisitSpawn(archive, scene.spawn);
  archive.Each(scene.attributions, [&](auto& line) { archive(line); });
  archive(scene.spawn_yaw_deg);
}

// About the bytes of its archive: of what is large in it, and room for the rest.
size_t ArchiveSizeOf(const Scene& scene) {
  size_t bytes = size_t{1} << 20;
  for (const Texture& texture : scene.textures)
    for (const auto& level : texture.levels) bytes += level.pixels().size_bytes();
  const auto add = [&](const auto& list) { bytes += std::span(list).size_bytes(); };
  for (const Mesh& mesh : scene.meshes) {
    add(mesh.positions), add(mesh.normals), add(mesh.uvs), add(mesh.triangles), add(mesh.parts), add(mesh.colors);
    bytes += 100;
  }
  add(scene.instances);
  return bytes + 100 * scene.entities.size();
}

}  // namespace

Bytes ArchivePictured(const Scene& scene) {
  ArchiveWriter archive(ArchiveSizeOf(scene));
  VisitScene(archive, scene);
  return archive.Take();
}

Bytes ArchiveScene(const Scene& scene) {
  ArchiveWriter archive(ArchiveSizeOf(scene));
  VisitScene(archive, scene);
  VisitRoads(archive, scene.roads);
  return archive.Take();
}

std::optional<Scene> SceneFromArchive(std::span<const std::byte> bytes) {
  try {
    ArchiveReader archive(bytes);
    Scene scene;
    VisitScene(archive, scene);
    VisitRoads(archive, scene.roads);
    if (archive.done()) return scene;
  } catch (const InputError&) {  // rejected below
  }
  return std::nullopt;
}

void AddToKey(CacheKey& key, const Environment& environment) {
  ArchiveWriter archive;
  VisitEnvironment(archive, environment);
  key.Add(archive.bytes());
}

}  // namespace airsim360

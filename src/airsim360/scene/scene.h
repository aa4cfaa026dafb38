// The constant part of a world: meshes, materials, textures, instances, entities, lights. Built once, then
// immutable.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/math/box.h"
#include "airsim360/math/transform.h"
#include "airsim360/scene/environment.h"
#include "airsim360/scene/material.h"
#include "airsim360/scene/mesh.h"
#include "airsim360/scene/semantics.h"

namespace airsim360 {

struct RoadNetwork;  // scene/road_network.h

/// One thing (or one stuff region) that labels tell apart. Ids start at 1 and never change within a world and
/// seed.
struct Entity {
  EntityId id = kNoEntity;
  std::string name;  ///< unique within the scene
  CategoryId category = kVoid;
  Box3f bounds;  ///< in W; empty for the sky
};

/// A mesh placed in the world.
struct Instance {
  MeshId mesh = 0;
  AffineTransform X_WM;         ///< mesh frame to W
  EntityId entity = kNoEntity;  ///< for the parts that carry none of their own
  Vec3f tint{1, 1, 1};          ///< multiplies base colour (linear)
  Vec3f glow{1, 1, 1};          ///< multiplies emission (linear): colour and strength of its lamps, black = switched off
};

/// Triangles, instances and entities of a scene as counted by `airsim360 worlds` and `--json` outputs.
struct SceneCounts {
  uint64_t unique_triangles = 0;
  uint64_t instanced_triangles = 0;
  uint64_t instances = 0;
  uint64_t entities = 0;
};

/// Immutable after SceneBuilder::Build; share it as std::shared_ptr<const Scene>.
struct Scene {
  std::string name;
  SemanticTree tree;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Entity> entities;                   ///< entities[i].id == i + 1
  EntityId sky_entity = kNoEntity;                ///< what rays that hit nothing see; kNoEntity only in closed rooms
  Environment environment;                        ///< the world's own; renderers may be given another
  Vec3f interior_light{};                         ///< uniform ambient radiance of scenes without a sky (closed rooms)
  Box3f bounds;                                   ///< of all instances, in W
  std::optional<Vec3f> spawn;                     ///< a good first viewpoint
  std::vector<std::string> attributions;          ///< one line per third-party model used: title, author, licence
  float spawn_yaw_deg = 0;                        ///< where to look from `spawn`: 0 = +X, counter-clockwise
  std::string cache_key = {};                     ///< stands for all of the above but `environment` in keys of the disk cache;
                                                  ///< empty = what is computed of the scene is not kept
  std::shared_ptr<const RoadNetwork> roads = {};  ///< lanes that vehicles can drive on; null: none are known

  const Entity& entity(EntityId id) const { return entities[id - 1]; }
  /// SemanticTree::SettleIds, for the entities too. To be done before others see the scene.
  void SettleCategories();
  SceneCounts Count() const;
};

/// Collects the parts of a scene, checks them, and builds it. All Add functions return the id to refer to.
class SceneBuilder {
 public:
  explicit SceneBuilder(std::string name);

  SemanticTree& tree() { return scene_.tree; }
  Environment& environment() { return scene_.environment; }
  TextureId AddTexture(Texture texture);
  MaterialId AddMaterial(Material material);
  /// The mesh may be empty of parts: then `material` 0 covers all of it.
  MeshId AddMesh(Mesh mesh);
  /// Names are made unique by appending " 2", " 3", … to repeats.
  EntityId AddEntity(std::string name, CategoryId category);
  void AddInstance(Instance instance);
  /// Gives the scene a sky (an entity of category "sky").
  void AddSky();
  void SetInteriorLight(Vec3f radiance) { scene_.interior_light = radiance; }
  void SetSpawn(Vec3f p_W, float yaw_deg = 0) {
    scene_.spawn = p_W;
    scene_.spawn_yaw_deg = yaw_deg;
  }
  void AddAttribution(std::string line);
  void SetRoads(std::shared_ptr<const RoadNetwork> roads) { scene_.roads = std::move(roads); }

  const Mesh& mesh(MeshId id) const { return scene_.meshes[id]; }
  const Material& material(MaterialId id) const { return scene_.materials[id]; }

  /// Checks every index, fills bounds, settles the ids of custom categories (ids from tree() do not count any
  /// more) and returns the scene; the builder is empty afterwards. Throws
  /// InputError for an index out of range, a triangle without an entity, a vertex that is not finite, or
  /// parts that do not cover a mesh.
  std::shared_ptr<const Scene> Build();

 private:
  Scene scene_;
  std::map<std::string, int> name_uses_;
};

/// The same scene with a cache_key; in place where `scene` is the only reference, else a copy.
std::shared_ptr<const Scene> WithCacheKey(std::shared_ptr<const Scene> scene, std::string key);

/// The same scene under another sky; in place where `scene` is the only reference, else a copy.
std::shared_ptr<const Scene> WithEnvironment(std::shared_ptr<const Scene> scene, Environment environment);

}  // namespace airsim360

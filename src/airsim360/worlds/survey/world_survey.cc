#include "airsim360/worlds/survey/world_survey.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

namespace airsim360 {
namespace {

// The part of the ground that can be reached; names of what lies beyond it begin with "far".
Box3f InsideBox(const Scene& scene) {
  Box3f box;
  for (const Entity& entity : scene.entities) {
    if (scene.tree[entity.category].path != "ground/crosswalk" || entity.name.starts_with("far ") || entity.bounds.empty()) continue;
    box.Add(entity.bounds.min - Vec3f{20, 20, 20});
    box.Add(entity.bounds.max + Vec3f{20, 20, 400});
  }
  if (!box.empty()) return box;
  for (const Mesh& mesh : scene.meshes)
    if (mesh.name == "ground") box.Add(mesh.Bounds());
  return box.empty() ? scene.bounds : box;
}

float Longest(const Box3f& box) { return std::max(box.size().x, box.size().y); }

}  // namespace

WorldSurvey SurveyWorld(const Scene& scene) {
  WorldSurvey survey;
  survey.counts = scene.Count();
  const Box3f inside = InsideBox(scene);
  survey.ground_area_m2 = static_cast<double>(inside.size().x) * inside.size().y;
  const Vec3f middle = inside.center();
  std::set<std::string_view> species;
  std::vector<bool> is_tree(scene.entities.size() + 1, false);
  for (const Entity& entity : scene.entities) {
    const std::string_view path = scene.tree[entity.category].path;
    ++survey.categories[std::string(path)];
    if (entity.bounds.empty()) continue;
    const Vec3f c = entity.bounds.center();
    const bool in = c.x > inside.min.x && c.x < inside.max.x && c.y > inside.min.y && c.y < inside.max.y;
    if (path == "construction/building" || path == "construction/house") {
      survey.buildings_inside += in;
      survey.buildings_backdrop += !in && std::hypot(c.x - middle.x, c.y - middle.y) < 600;
    }
    if (path.starts_with("vegetation/tree")) {
      is_tree[entity.id] = true;
      species.insert(path);
    }
    if (!in) continue;
    survey.lamp_posts += path.starts_with("furniture/lighting/");
    survey.cars += path == "vehicle/car" || path == "vehicle/van";
    survey.manholes += entity.name.starts_with("manhole");
    survey.trees += is_tree[entity.id];
    if (path == "ground/road" && !entity.name.starts_with("junction")) survey.road_m += Longest(entity.bounds);
    if (entity.name.starts_with("pavement ")) survey.pavement_m += Longest(entity.bounds);
  }
  std::set<MeshId> meshes;
  for (const Instance& instance : scene.instances)
    if (instance.entity != kNoEntity && is_tree[instance.entity]) meshes.insert(instance.mesh);
  survey.tree_species = static_cast<int>(species.size());
  survey.tree_meshes = static_cast<int>(meshes.size());
  return survey;
}

}  // namespace airsim360

#include "airsim360/worlds/furnishings/placed_lamps.h"

#include <cstdio>
#include <numbers>
#include <set>

#include "airsim360/base/disk_cache.h"
#include "airsim360/base/error.h"
#include "airsim360/scene/scene_additions.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/kit/mesh_builder.h"

namespace airsim360 {
namespace {

constexpr const char* kCategory = "furniture/lighting/lamp";
constexpr int kRings = 10, kSides = 16;
constexpr double kAbove = 200;  // metres over the highest thing that a lamp may hang

Vec3f PlaceOf(const PlacedLamp& lamp) { return {static_cast<float>(lamp.x), static_cast<float>(lamp.y), static_cast<float>(lamp.z)}; }

void AddLamp(const PlacedLamp& lamp, std::set<std::string>& names, Scene& scene) {
  const auto radius = static_cast<float>(lamp.radius);
  const auto area = static_cast<float>(4 * std::numbers::pi * lamp.radius * lamp.radius);
  scene.materials.push_back(internal::LampSurface(static_cast<float>(lamp.lumens), area, static_cast<float>(lamp.kelvin),
                                                  lamp.always ? internal::Burns::kAlways : internal::Burns::kAtNight));
  MeshBuilder builder;
  builder.SetMaterial(static_cast<MaterialId>(scene.materials.size() - 1));
  builder.Sphere({}, {radius, radius, radius}, kRings, kSides);
  scene.meshes.push_back(builder.Finish("lamp"));
  std::string name = lamp.name;
  for (int number = 2; names.contains(name); ++number) name = lamp.name + " " + std::to_string(number);
  names.insert(name);
  Instance instance{.mesh = static_cast<MeshId>(scene.meshes.size() - 1), .X_WM = PlaceUpright(PlaceOf(lamp))};
  AddInstanceEntity(scene, name, scene.tree.Add(kCategory), instance);
  scene.bounds.Add(scene.entities.back().bounds);
}

std::string KeyWith(const std::string& key, std::span<const PlacedLamp> lamps) {
  CacheKey with("scene_lamps", 1);
  with.Add(key);
  for (const PlacedLamp& lamp : lamps)
    with.Add(lamp.name).Add(lamp.x).Add(lamp.y).Add(lamp.z).Add(lamp.lumens).Add(lamp.kelvin).Add(lamp.radius).Add(lamp.always);
  return with.Name();
}

}  // namespace

void CheckLamps(const Scene& scene, std::span<const PlacedLamp> lamps) {
  if (lamps.size() > kMostPlacedLamps)
    throw InputError("lamps: " + std::to_string(lamps.size()) + " are more than " + std::to_string(kMostPlacedLamps));
  const Box3f& b = scene.bounds;
  for (const PlacedLamp& lamp : lamps) {
    const Vec3f p = PlaceOf(lamp);
    if (p.x >= b.min.x && p.x <= b.max.x && p.y >= b.min.y && p.y <= b.max.y && p.z >= b.min.z && p.z <= b.max.z + kAbove) continue;
    char text[240];
    std::snprintf(text, sizeof text, "' at %.1f, %.1f, %.1f is outside of the world: x %.1f … %.1f, y %.1f … %.1f, z %.1f … %.1f", lamp.x,
                  lamp.y, lamp.z, double(b.min.x), double(b.max.x), double(b.min.y), double(b.max.y), double(b.min.z), b.max.z + kAbove);
    throw InputError("lamps: '" + lamp.name.substr(0, 60) + text);
  }
}

std::shared_ptr<const Scene> WithLamps(std::shared_ptr<const Scene> scene, std::span<const PlacedLamp> lamps) {
  if (lamps.empty()) return scene;
  CheckLamps(*scene, lamps);
  const std::shared_ptr<Scene> own = OwnScene(std::move(scene));
  std::set<std::string> names;
  for (const Entity& entity : own->entities) names.insert(entity.name);
  if (!own->cache_key.empty()) own->cache_key = KeyWith(own->cache_key, lamps);
  for (const PlacedLamp& lamp : lamps) AddLamp(lamp, names, *own);
  return own;
}

}  // namespace airsim360
